# Packages of Debian's archive, downloaded and checked for use beside the system's own. Other
# scripts read this one; they set
#     program   their name, for messages
#     cache     the folder to keep things in, and
#     variable  the one of the environment that names another
#     suite     where the packages come from: $codename, or $codename-backports
# and, by open_cache, get
#     kept      the folder that holds what was made of the packages
#     part      the folder to work in until it does
# What is downloaded comes through apt from the mirror it is configured with, needs no root, leaves
# the system's packages as they are, and lies in $part/cache/archives afterwards.

keyring=/usr/share/keyrings/debian-archive-keyring.gpg

say() { echo "$program: $*" >&2; }
# Ends the script with the code of what cannot be had here, and why.
none() {
  say "$*"
  exit 77
}

# Sets $codename to the release's, as "bookworm", and $kept and $part; requires the tools needed.
open_cache() {
  for tool in apt-get dpkg dpkg-deb flock sha256sum ldd; do
    command -v "$tool" >/dev/null ||
      none "$tool is missing: only Debian's archive is known as a source"
  done
  # shellcheck source=/dev/null
  codename=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
  [ -n "$codename" ] || none "/etc/os-release names no release of Debian"
  case $cache in /*) ;; *) cache=$PWD/$cache ;; esac
  kept=$cache/$codename-$(dpkg --print-architecture)
  part=$kept.part
}

# Whether $kept is there and undamaged.
is_whole() { (cd "$kept" && sha256sum --strict --check sums) >/dev/null 2>&1; }

# Has the function "$1" make $part/kept, unless another call has made it meanwhile. Nothing counts
# before the last line: an interrupted call leaves nothing, and the next one begins anew.
fetch() {
  if is_whole; then return; fi
  rm -rf "$part"
  mkdir "$part"
  trap 'rm -rf "$part"' EXIT
  trap 'exit 130' INT TERM HUP
  "$1"
  (cd "$part/kept" && find . -type f -exec sha256sum -- '{}' + >"$part/sums")
  mv "$part/sums" "$part/kept"
  rm -rf "$kept"
  mv "$part/kept" "$kept"
}

# Makes $kept by the function "$1" where it is not there.
prepare() {
  if is_whole; then return; fi
  mkdir -p "$cache" 2>/dev/null || true
  [ -w "$cache" ] || none "cannot write to $cache; $variable names another folder"
  # One call at a time; the lock goes with its holder, however that ends.
  (
    flock 9
    fetch "$1"
  ) 9>"$cache/lock"
}

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
APT::Default-Release "$suite";
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

# Gets the lists of the first mirror that has the suite.
update_lists() {
  options=
  if [ -f "$keyring" ]; then options="[signed-by=$keyring] "; fi
  for mirror in $(mirrors); do
    printf 'deb %s%s %s main\n' "$options" "$mirror" "$codename" >"$part/sources"
    if [ "$suite" != "$codename" ]; then
      printf 'deb %s%s %s main\n' "$options" "$mirror" "$suite" >>"$part/sources"
    fi
    if own_apt_get update --error-on=any; then return; fi
    say "$(complaint)"
  done
  none "no mirror that apt is configured with gave the lists of $suite:" \
    "is there a network, and does the mirror have them?"
}

# The version of a package that the suite has, once there are lists; empty: none.
candidate() {
  apt-cache -c "$part/apt.conf" policy "$1" |
    awk '$1 == "Candidate:" && $2 != "(none)" { print $2 }'
}

# Downloads packages, installed here or not, and those of their dependencies that this system lacks
# or has too old.
download() {
  say "downloading $*"
  own_apt_get install --reinstall --download-only --no-install-recommends "$@" ||
    none "cannot download $*: $(complaint)"
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
    apt-cache -c "$part/apt.conf" show "$(dpkg-deb -f "$archive" Package)" |
      grep -qx "SHA256: $hash" ||
      none "$(basename "$archive") has not the hash that the archive has signed"
  done
  say "the downloads have the hashes that the archive has signed"
}
