#!/bin/sh
# Everything from a fresh Debian 12 or 13, or Ubuntu 24.04, to an image, to the test results, or to
# Debian packages:
#     sh cmake/bootstrap.sh render [SCENE.xml [options of facet render]]
#     sh cmake/bootstrap.sh test [options of ctest; without any, all tests but the slow ones]
#     sh cmake/bootstrap.sh packages
# Installs the packages that are missing (apt, as root or through sudo), builds build/release, and
# runs. Works from any folder: images are written to the folder it is called from, or to out/ of the
# sources where that is one of theirs. A second run takes seconds.
set -eu

packages="g++ cmake ninja-build libvulkan-dev glslang-tools spirv-tools spirv-headers libglm-dev
  libboost-dev libmpfr-dev libtinyobjloader-dev libopenexr-dev libpng-dev libjpeg-dev zlib1g-dev
  libpugixml-dev libcli11-dev nlohmann-json3-dev libfmt-dev"
driver_packages="mesa-vulkan-drivers" # not needed for building
package_packages="git dpkg-dev file"
test_packages="libgtest-dev vulkan-validationlayers aspell aspell-en mkdocs"
# Of these a test that lacks them is skipped: Ubuntu has no browser as a package.
optional_packages="chromium" # looks at the pages that facet writes

say() { echo "bootstrap: $*" >&2; }
fail() {
  say "$*"
  exit 2
}

usage() {
  fail "usage: sh cmake/bootstrap.sh render [SCENE.xml [options]] | test [ctest options] | packages"
}

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
  # Who sits at a terminal is asked for the password.
  if [ -t 0 ]; then sudo -v || true; fi
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
    fail "this is neither Debian nor Ubuntu (no apt-get): install the equivalents of $* yourself;" \
      "docs/guide/quick-start.md says how to build without this script"
  missing=$(missing_packages "$@")
  [ -n "$missing" ] || return 0
  find_root
  say "installing: $missing"
  log=$(mktemp)
  [ -n "${updated:-}" ] || run_apt update
  updated=1
  # shellcheck disable=SC2086
  run_apt install --no-install-recommends $missing
  rm -f "$log"
}

# Those among "$@" that the system's archive has.
available_packages() {
  for package in "$@"; do
    apt-cache show --no-all-versions "$package" 2>/dev/null | grep -q '^Filename:' &&
      printf '%s ' "$package"
  done
  return 0
}

build() {
  if [ ! -f "$root/build/release/build.ninja" ] || [ -n "${configure:-}" ]; then
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

# Images go to out/ where the current folder is one of the sources', unless "$@" says where.
output_options() {
  for option in "$@"; do
    case $option in
      -o | -o?* | --output | --output=* | --pixel | --pixel=*) return ;;
    esac
  done
  case $(pwd -P)/ in
    "$root"/*)
      mkdir -p "$root/out"
      printf '%s' "$root/out/"
      ;;
  esac
}

# The picture of the README, as soon as the library is built, by the first of the examples; the rest
# of the program is built while the user looks at it.
first_picture() {
  build example_render facet_scenes
  wait "$driver"
  folder=$(output_options)
  scene=$root/scenes/still_life/still_life.xml
  say "rendering $scene"
  "$root/build/release/examples/render" "$scene" \
    "${folder}still_life.exr" "${folder}still_life.png" || fail "rendering failed"
  say "wrote ${folder}still_life.exr and ${folder}still_life.png"
  say "now building the rest of the program: compare, parity, tradeoff, ..."
  build facet
  say "done: $root/build/release/host/facet; next: sh cmake/bootstrap.sh render SCENE.xml," \
    "or the first ten minutes in docs/guide/quick-start.md"
}

render() {
  build facet facet_scenes
  wait "$driver"
  folder=$(output_options "$@")
  [ -z "$folder" ] || set -- "$@" -o "$folder"
  exec "$root/build/release/host/facet" render "$@"
}

root=$(cd "$(dirname "$0")/.." && pwd -P)
[ $# -ge 1 ] || usage
command=$1
shift
case $command in
  render)
    # shellcheck disable=SC2086
    install_packages $packages
    # The driver is installed while the compiler runs, when nobody can be asked for a password.
    # shellcheck disable=SC2086
    missing=$(missing_packages $driver_packages)
    [ -z "$missing" ] || find_root
    # shellcheck disable=SC2086
    (install_packages $driver_packages) &
    driver=$!
    # Whatever becomes of the build, dpkg is not left at work.
    trap 'wait "$driver" || true' EXIT
    trap 'exit 130' INT
    trap 'exit 143' TERM
    if [ $# -gt 0 ]; then
      render "$@"
    elif [ -x "$root/build/release/host/facet" ]; then
      render "$root/scenes/still_life/still_life.xml"
    else
      first_picture
    fi
    ;;
  test)
    # shellcheck disable=SC2086
    install_packages $packages $driver_packages $test_packages
    # shellcheck disable=SC2086,SC2046
    install_packages $(available_packages $optional_packages)
    # A build for rendering alone has no tests.
    configure=1
    build all
    # Here, since tests download nothing.
    sh "$root/cmake/second-driver.sh" --prepare >&2 ||
      say "the test that compares two drivers will be skipped"
    sh "$root/farm/slurm/private-cluster.sh" --prepare >&2 ||
      say "the test of array jobs will be skipped"
    cd "$root/build/release"
    [ $# -gt 0 ] || set -- -LE slow
    # Some wait for others: for Slurm, or for a render that they have started.
    CTEST_PARALLEL_LEVEL=${CTEST_PARALLEL_LEVEL:-$(($(nproc) + 1))}
    export CTEST_PARALLEL_LEVEL
    exec ctest --output-on-failure "$@"
    ;;
  packages)
    # shellcheck disable=SC2086
    install_packages $packages $package_packages
    exec sh "$root/cmake/release.sh" packages
    ;;
  *) usage ;;
esac
