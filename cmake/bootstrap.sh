#!/bin/sh
# Everything from a fresh Debian 12 to an image, or to the test results:
#     sh cmake/bootstrap.sh render [SCENE.xml [options of facet render]]
#     sh cmake/bootstrap.sh test [options of ctest; without any, all tests but the slow ones]
# Installs the Debian packages that are missing (apt, as root or through sudo), builds build/release,
# and runs. Works from any folder: images are written to the folder it is called from. A second run
# takes seconds.
set -eu

packages="g++ cmake ninja-build libvulkan-dev mesa-vulkan-drivers glslang-tools spirv-tools
  spirv-headers libglm-dev libboost-dev libtinyobjloader-dev libopenexr-dev libpng-dev libjpeg-dev zlib1g-dev
  libpugixml-dev libcli11-dev nlohmann-json3-dev libfmt-dev libgtest-dev vulkan-validationlayers"
test_packages="chromium" # looks at the pages that facet writes

say() { echo "bootstrap: $*" >&2; }
fail() {
  say "$*"
  exit 2
}

usage() { fail "usage: sh cmake/bootstrap.sh render [SCENE.xml [options]] | test [ctest options]"; }

# The names among "$@" whose packages are not installed.
missing_packages() {
  for package in "$@"; do
    status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
    [ "$status" = installed ] || printf '%s ' "$package"
  done
}

# Sets $as_root to what runs a command as root, or says what to do.
find_root() {
  as_root=
  [ "$(id -u)" = 0 ] && return
  command -v sudo >/dev/null || fail "packages are missing, and there is neither root nor sudo;" \
    "as root: apt-get install $missing"
  sudo -n true 2>/dev/null || fail "packages are missing, and sudo wants a password;" \
    "as root: apt-get install $missing"
  as_root=sudo
}

# apt's output goes to a log that is shown only on failure.
run_apt() {
  $as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y "$@" >"$log" 2>&1 </dev/null || {
    tail -n 20 "$log" >&2
    rm -f "$log"
    fail "apt-get $1 failed (its last lines are above); is there a network," \
      "and does /etc/apt name a Debian mirror?"
  }
}

install_packages() {
  command -v dpkg-query >/dev/null && command -v apt-get >/dev/null ||
    fail "this is no Debian (no apt-get): install the equivalents of $* yourself;" \
      "README.md says how to build without this script"
  missing=$(missing_packages "$@")
  [ -n "$missing" ] || return 0
  find_root
  say "installing: $missing"
  log=$(mktemp)
  run_apt update
  # shellcheck disable=SC2086
  run_apt install --no-install-recommends $missing
  rm -f "$log"
}

build() {
  if [ ! -f "$root/build/release/build.ninja" ]; then
    say "configuring build/release"
    mkdir -p "$root/build"
    (cd "$root" && cmake --preset release >build/configure.log 2>&1) || {
      tail -n 30 "$root/build/configure.log" >&2
      fail "configuring failed (its last lines are above)"
    }
  fi
  say "building (the first time takes a few minutes)"
  cmake --build "$root/build/release" --target "$@" >&2 || fail "building failed"
}

root=$(cd "$(dirname "$0")/.." && pwd)
[ $# -ge 1 ] || usage
command=$1
shift
case $command in
  render)
    # shellcheck disable=SC2086
    install_packages $packages
    build facet facet_scenes
    if [ $# -eq 0 ]; then set -- "$root/scenes/cbox/cbox_conductors_mis.xml"; fi
    exec "$root/build/release/host/facet" render "$@"
    ;;
  test)
    # shellcheck disable=SC2086
    install_packages $packages $test_packages
    build all
    # Here, since tests download nothing.
    sh "$root/cmake/second-driver.sh" --prepare >&2 ||
      say "the test that compares two drivers will be skipped"
    sh "$root/farm/slurm/private-cluster.sh" --prepare >&2 ||
      say "the test of array jobs will be skipped"
    cd "$root/build/release"
    [ $# -gt 0 ] || set -- -LE slow
    # Tests wait for their driver half of the time.
    CTEST_PARALLEL_LEVEL=${CTEST_PARALLEL_LEVEL:-$(nproc)}
    export CTEST_PARALLEL_LEVEL
    exec ctest --output-on-failure "$@"
    ;;
  *) usage ;;
esac
