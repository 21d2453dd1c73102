#!/bin/sh
# Makes a release:
#     sh cmake/release.sh check       what is missing for one; exits 1 where anything is
#     sh cmake/release.sh packages    tarball, Debian packages and checksums, in build/packages
#     sh cmake/release.sh tag         check, packages, and the tag
# Two runs for one commit make the same bytes, wherever the sources lie. Needs what
# cmake/bootstrap.sh installs for it.
set -eu

say() { echo "release: $*" >&2; }
fail() {
  say "$*"
  exit 2
}

check() {
  missing=0
  lacks() {
    say "$*"
    missing=1
  }
  [ -z "$(git status --porcelain)" ] || lacks "the tree has changes that are not committed"
  grep -Eq "^## $version \([0-9]{4}-[0-9]{2}-[0-9]{2}\)$" CHANGELOG.md ||
    lacks "CHANGELOG.md has no heading '## $version (YYYY-MM-DD)'"
  git rev-parse -q --verify "refs/tags/v$version" >/dev/null && lacks "v$version is tagged already"
  [ "$missing" = 0 ] || exit 1
  say "nothing is missing for $version"
}

packages() {
  for needed in dpkg-shlibdeps:dpkg-dev file:file git:git; do
    command -v "${needed%:*}" >/dev/null || fail "install ${needed#*:}"
  done
  # Dates inside are that of the commit, and paths are those of the tarball.
  SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
  export SOURCE_DATE_EPOCH TZ=UTC LC_ALL=C
  unset CFLAGS CXXFLAGS CPPFLAGS LDFLAGS CC CXX CMAKE_PREFIX_PATH
  umask 022
  to=$root/build/packages
  rm -rf "$to"
  mkdir -p "$to/work"
  git -c tar.umask=0022 archive --format=tar --prefix="facet-$version/" -o "$to/facet-$version.tar" HEAD
  gzip -9n "$to/facet-$version.tar"
  tar -xzf "$to/facet-$version.tar.gz" -C "$to/work"
  (
    cd "$to/work"
    cmake -S "facet-$version" -B build -G Ninja -DCMAKE_BUILD_TYPE=Release -DFACET_TESTS=OFF \
      -DCMAKE_INSTALL_PREFIX=/usr -DCMAKE_DISABLE_FIND_PACKAGE_embree=ON >configure.log ||
      fail "configuring failed: $to/work/configure.log"
    cmake --build build
    cpack --config build/CPackConfig.cmake -B packages >cpack.log || fail "cpack failed: $to/work/cpack.log"
  ) >&2
  mv "$to"/work/packages/*.deb "$to"
  rm -rf "$to/work"
  (cd "$to" && sha256sum -- *.tar.gz *.deb >SHA256SUMS)
  say "in $to:"
  ls "$to" >&2
}

root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"
version=$(sed -n 's/^project(facet VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
case ${1:-} in
  check) check ;;
  packages) packages ;;
  tag)
    check
    packages
    git tag -a "v$version" -m "facet $version"
    say "v$version is tagged here; push it, and publish build/packages"
    ;;
  *) fail "usage: sh cmake/release.sh check | packages | tag" ;;
esac
