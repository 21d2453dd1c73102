#!/bin/sh
# Runs a command on a second Vulkan driver beside the system's, lavapipe of the newer Mesa in
# Debian's backports:
#     sh cmake/second-driver.sh COMMAND...      # fetches the driver if need be
#     sh cmake/second-driver.sh --prepare       # only fetches it
#     sh cmake/second-driver.sh --check         # says whether it is there; fetches nothing
# The packages come through apt from the mirror it is configured with and are unpacked into
# $FACET_SECOND_DRIVER (default: facet/second-driver in the user's cache folder). The system's
# packages stay as they are; root is not needed. What is downloaded has to have the hashes that the
# archive has signed; where the keys to check that are missing, a line says so.
# Exit codes: 77 where there is no second driver, with a line that says why; 2 wrong usage; else 0,
# or what COMMAND returns.
set -eu

package=mesa-vulkan-drivers
keyring=/usr/share/keyrings/debian-archive-keyring.gpg

say() { echo "second-driver: $*" >&2; }
none() {
  say "$*"
  exit 77
}

# The version of the system's own driver, 0 where there is none.
system_version() {
  installed=$(dpkg-query -W -f='${db:Status-Status} ${Version}' "$package" 2>/dev/null) ||
    installed=
  case $installed in "installed "*) echo "${installed#installed }" ;; *) echo 0 ;; esac
}

require_newer() {
  dpkg --compare-versions "$1" gt "$(system_version)" ||
    none "the system's own Mesa, $(system_version), is not older than $codename-backports' $1"
}

# Whether $driver is there and undamaged.
is_whole() { (cd "$driver" && sha256sum --strict --check sums) >/dev/null 2>&1; }

# Mirrors of this release that apt is configured with, in either format of its sources.
mirrors() {
  # shellcheck disable=SC2016
  apt-get --no-release-info indextargets --format '$(RELEASE) $(COMPONENT) $(REPO_URI)' \
    'Created-By: Packages' |
    awk -v codename="$codename" '
      ($1 == codename || $1 ~ /^(old)*stable$/) && $2 == "main" && !seen[$3]++ { print $3 }'
}

# apt's settings beyond the system's: lists and archives of our own, no sources but $part/sources,
# nothing that needs root.
write_apt_settings() {
  mkdir -p "$part/lists/partial" "$part/cache/archives/partial"
  cat >"$part/apt.conf" <<END
Dir::Etc::SourceList "$part/sources";
Dir::Etc::SourceParts "/dev/null";
Dir::Etc::Preferences "/dev/null";
Dir::Etc::PreferencesParts "/dev/null";
Dir::State::Lists "$part/lists";
Dir::Cache "$part/cache";
APT::Default-Release "$codename-backports";
APT::Sandbox::User "root";
APT::Get::AllowUnauthenticated "false";
Acquire::GzipIndexes "false";
Acquire::AllowInsecureRepositories "false";
Acquire::AllowWeakRepositories "false";
Acquire::AllowDowngradeToInsecureRepositories "false";
Debug::NoLocking "true";
Acquire::Retries "2";
Acquire::http::Timeout "20";
Acquire::https::Timeout "20";
END
}

own_apt_get() { apt-get -c "$part/apt.conf" -q -y "$@" >"$part/log" 2>&1 </dev/null; }

# The first thing that apt complained about.
complaint() { sed -n 's/^[EW]: //p' "$part/log" | head -n 1; }

# Gets the lists of the first mirror that has backports.
update_lists() {
  options=
  if [ -f "$keyring" ]; then options="[signed-by=$keyring] "; fi
  for mirror in $(mirrors); do
    printf 'deb %s%s %s main\n' "$options" "$mirror" "$codename" \
      "$options" "$mirror" "$codename-backports" >"$part/sources"
    if own_apt_get update --error-on=any; then return; fi
    say "$(complaint)"
  done
  none "no mirror that apt is configured with gave the lists of $codename-backports:" \
    "is there a network, and are there backports?"
}

# Downloads the package and those of its dependencies that this system lacks or has too old.
download() {
  write_apt_settings
  update_lists
  version=$(apt-cache -c "$part/apt.conf" policy "$package" |
    awk '$1 == "Candidate:" && $2 != "(none)" { print $2 }')
  [ -n "$version" ] || none "$codename-backports has no $package"
  require_newer "$version"
  say "downloading $package $version"
  own_apt_get install --download-only --no-install-recommends "$package" ||
    none "cannot download $package $version: $(complaint)"
}

# Whether the archive has signed the lists, and the packages are those of the lists. apt has looked
# at both already, but by settings and keys of the system's, which may be lax.
check_signed() {
  if [ ! -f "$keyring" ] || ! command -v gpgv >/dev/null; then
    say "cannot check the archive's signature (gpgv and $keyring are needed): as safe as apt" \
      "is here"
    return
  fi
  for release in "$part"/lists/*InRelease; do
    # What stands outside of the signed text counts for nothing.
    gpgv --keyring "$keyring" --output "$release.signed" "$release" >"$part/log" 2>&1 ||
      none "the archive's lists are not signed by a key of $keyring: $(tail -n 1 "$part/log")"
  done
  for index in "$part"/lists/*_Packages; do
    hash=$(sha256sum "$index" | cut -d ' ' -f 1)
    grep -q "^ $hash " "$part"/lists/*InRelease.signed ||
      none "$(basename "$index") has not the hash that the archive has signed"
  done
  for archive in "$part"/cache/archives/*.deb; do
    hash=$(sha256sum "$archive" | cut -d ' ' -f 1)
    name=$(dpkg-deb -f "$archive" Package)
    apt-cache -c "$part/apt.conf" show "$name" | grep -qx "SHA256: $hash" ||
      none "$(basename "$archive") has not the hash that the archive has signed"
  done
  say "the downloads have the hashes that the archive has signed"
}

# Turns the downloaded packages into the folder $part/driver: lavapipe and those of its libraries
# that came along, the ICD file, the version, and the checksums of all.
unpack() {
  mkdir "$part/root" "$part/driver"
  for archive in "$part"/cache/archives/*.deb; do dpkg-deb -x "$archive" "$part/root"; done
  lavapipe=$(find "$part/root" -name libvulkan_lvp.so | head -n 1)
  [ -n "$lavapipe" ] || none "$package $version holds no lavapipe"
  cd "$(dirname "$lavapipe")"
  LD_LIBRARY_PATH=. ldd ./libvulkan_lvp.so >"$part/libraries"
  missing=$(awk '/not found/ { print $1 }' "$part/libraries" | tr '\n' ' ')
  [ -z "$missing" ] || none "$package $version needs what this system lacks: $missing"
  for library in libvulkan_lvp.so $(awk '$3 ~ /^\.\// { print $1 }' "$part/libraries"); do
    cp "$library" "$part/driver"
  done
  cd "$part/driver"
  cat >icd.json <<END
{"file_format_version": "1.0.0",
 "ICD": {"library_path": "./libvulkan_lvp.so", "api_version": "1.3.0"}}
END
  echo "$version" >version
  sha256sum -- * >../sums
  mv ../sums .
}

# Fetches the driver unless another call has done so meanwhile. Nothing counts before the last line:
# an interrupted call leaves no driver, and the next one begins anew.
fetch() {
  if is_whole; then return; fi
  rm -rf "$part"
  mkdir "$part"
  trap 'rm -rf "$part"' EXIT
  trap 'exit 130' INT TERM HUP
  download
  check_signed
  unpack
  rm -rf "$driver"
  mv "$part/driver" "$driver"
}

prepare() {
  if is_whole; then return; fi
  mkdir -p "$cache" 2>/dev/null || true
  [ -w "$cache" ] || none "cannot write to $cache; FACET_SECOND_DRIVER names another folder"
  # One call at a time; the lock goes with its holder, however that ends.
  (
    flock 9
    fetch
  ) 9>"$cache/lock"
}

case ${1:-} in
  --check | --prepare) ;;
  '' | -*)
    say "usage: sh cmake/second-driver.sh COMMAND... | --prepare | --check"
    exit 2
    ;;
esac
for tool in apt-get dpkg dpkg-deb flock sha256sum ldd; do
  command -v "$tool" >/dev/null ||
    none "$tool is missing: only Debian's backports are known as a source"
done
# shellcheck source=/dev/null
codename=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
[ -n "$codename" ] || none "/etc/os-release names no release of Debian"
cache=${FACET_SECOND_DRIVER:-${XDG_CACHE_HOME:-${HOME:-/nonexistent}/.cache}/facet/second-driver}
case $cache in /*) ;; *) cache=$PWD/$cache ;; esac
driver=$cache/$codename-$(dpkg --print-architecture)
part=$driver.part

if [ "$1" = --check ]; then
  is_whole || none "not prepared; sh cmake/second-driver.sh --prepare fetches it"
else
  prepare
fi
version=$(cat "$driver/version")
require_newer "$version"
case $1 in
  --check | --prepare) echo "$package $version in $driver" ;;
  *)
    export VK_DRIVER_FILES="$driver/icd.json" VK_ICD_FILENAMES="$driver/icd.json"
    export LD_LIBRARY_PATH="$driver${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
    exec "$@"
    ;;
esac
