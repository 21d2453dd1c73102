#!/bin/sh
# The documentation as a site, by Debian's mkdocs: build/site/index.html, or another folder.
#     sh cmake/site.sh [FOLDER]
# Needs the package mkdocs. Exits with 77 where it is not installed.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
command -v mkdocs >/dev/null || {
  echo "site: install mkdocs" >&2
  exit 77
}
folder=${1:-$root/build/site}
mkdir -p "$folder"
# mkdocs empties it.
if [ -n "$(ls -A "$folder")" ] && [ ! -f "$folder/sitemap.xml" ]; then
  echo "site: $folder holds something else: name an empty folder" >&2
  exit 2
fi
site=$(cd "$folder" && pwd)
pages=$(mktemp -d)
trap 'rm -rf "$pages"' EXIT
# Two pages of the site stand at the root of the sources, where hosts look for them.
cp -r "$root/docs" "$root/mkdocs.yml" "$pages"
sed 's#(docs/#(../#g' "$root/CONTRIBUTING.md" >"$pages/docs/develop/contributing.md"
sed 's#(docs/#(../#g' "$root/CHANGELOG.md" >"$pages/docs/develop/changes.md"
find "$pages/docs" -name '*.md' -exec sed -i \
  -e 's#(../../CONTRIBUTING.md)#(../develop/contributing.md)#g' \
  -e 's#(../../CHANGELOG.md)#(../develop/changes.md)#g' {} +
cd "$pages"
mkdocs build --strict --clean --site-dir "$site"
echo "site: $site/index.html"
