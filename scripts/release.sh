#!/usr/bin/env bash
# release.sh [FOLDER]: makes what is published of a version, of the commit that is checked out: source archive, Debian packages,
# the package for npm, wheels of Python, and their checksums. FOLDER (default: build/fbs-VERSION) is made anew. Takes minutes.
# What it makes is tried by tests/packages/try_packages.sh FOLDER.
set -euo pipefail
cd "$(dirname "$0")/.."
version=$(sed -nE 's/^#define FBS_VERSION_(MAJOR|MINOR|PATCH) //p' include/fbs/fbs.h | paste -sd .)
out=${1:-build/fbs-$version}

[ -z "$(git status --porcelain)" ] || { echo "there are changes that no commit has" >&2; exit 1; }
grep -q "\"version\": \"$version\"" web/package.json || { echo "web/package.json is not of version $version" >&2; exit 1; }
grep -q "^## \[$version\] - 20" CHANGELOG.md || echo "CHANGELOG.md has no date for version $version yet" >&2
[ -n "${DEBFULLNAME:-}" ] && [ -n "${DEBEMAIL:-}" ] ||
  echo "DEBFULLNAME and DEBEMAIL are not set: the Debian packages name no maintainer whom mail reaches" >&2
command -v npm >/dev/null || { echo "npm is missing: it comes with Node.js, or as Debian's package" >&2; exit 1; }
scripts/install_packages.sh packages.txt program_packages.txt all_packages.txt web_packages.txt release_packages.txt
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)  # the date of all that is packed
export SOURCE_DATE_EPOCH
rm -rf "$out"
mkdir -p "$out"
out=$(cd "$out" && pwd)

git archive --prefix="fbs-$version/" HEAD | gzip -9n >"$out/fbs-$version.tar.gz"

rm -rf build/debian/packages
cmake --workflow --preset debian
mv build/debian/packages/*.deb "$out"
lintian --fail-on error --suppress-tags initial-upload-closes-no-bugs "$out"/*.deb

web/build.sh
npm pack --silent --pack-destination "$out" ./build/web/package

python/wheels/build.sh "$out"

cd "$out"
sha256sum -- * >SHA256SUMS
ls -l
