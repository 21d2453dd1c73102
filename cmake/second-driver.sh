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

program=second-driver
package=mesa-vulkan-drivers
# shellcheck source=cmake/unpacked-packages.sh
. "$(dirname "$0")/unpacked-packages.sh"

# The version of the system's own driver, 0 where there is none.
system_version() {
  installed=$(dpkg-query -W -f='${db:Status-Status} ${Version}' "$package" 2>/dev/null) ||
    installed=
  case $installed in "installed "*) echo "${installed#installed }" ;; *) echo 0 ;; esac
}

require_newer() {
  dpkg --compare-versions "$1" gt "$(system_version)" ||
    none "the system's own Mesa, $(system_version), is not older than $suite's $1"
}

# Makes the folder $part/kept: lavapipe, those of its libraries that came along, the ICD file, and
# the version.
fetch_driver() {
  write_apt_settings
  update_lists
  version=$(candidate "$package")
  [ -n "$version" ] || none "$suite has no $package"
  require_newer "$version"
  download "$package"
  check_signed
  mkdir "$part/root" "$part/kept"
  for archive in "$part"/cache/archives/*.deb; do dpkg-deb -x "$archive" "$part/root"; done
  lavapipe=$(find "$part/root" -name libvulkan_lvp.so | head -n 1)
  [ -n "$lavapipe" ] || none "$package $version holds no lavapipe"
  cd "$(dirname "$lavapipe")"
  LD_LIBRARY_PATH=. ldd ./libvulkan_lvp.so >"$part/libraries"
  missing=$(awk '/not found/ { print $1 }' "$part/libraries" | tr '\n' ' ')
  [ -z "$missing" ] || none "$package $version needs what this system lacks: $missing"
  for library in libvulkan_lvp.so $(awk '$3 ~ /^\.\// { print $1 }' "$part/libraries"); do
    cp "$library" "$part/kept"
  done
  cd "$part/kept"
  cat >icd.json <<END
{"file_format_version": "1.0.0",
 "ICD": {"library_path": "./libvulkan_lvp.so", "api_version": "1.3.0"}}
END
  echo "$version" >version
}

case ${1:-} in
  --check | --prepare) ;;
  '' | -*)
    say "usage: sh cmake/second-driver.sh COMMAND... | --prepare | --check"
    exit 2
    ;;
esac
cache=${FACET_SECOND_DRIVER:-${XDG_CACHE_HOME:-${HOME:-/nonexistent}/.cache}/facet/second-driver}
variable=FACET_SECOND_DRIVER
open_cache
suite=$codename-backports

if [ "$1" = --check ]; then
  is_whole || none "not prepared; sh cmake/second-driver.sh --prepare fetches it"
else
  prepare fetch_driver
fi
version=$(cat "$kept/version")
require_newer "$version"
case $1 in
  --check | --prepare) echo "$package $version in $kept" ;;
  *)
    export VK_DRIVER_FILES="$kept/icd.json" VK_ICD_FILENAMES="$kept/icd.json"
    export LD_LIBRARY_PATH="$kept${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
    exec "$@"
    ;;
esac
