#!/usr/bin/env bash
# Puts the demo and the avatar sample into a folder that a static host serves: make_site.sh FOLDER.
# The player is that of build/web/package; media are where make_media.py has put them, in FOLDER/media.
set -euo pipefail
[ $# -eq 1 ] || { sed -n '2,3s/^# //p' "$0" >&2; exit 1; }
here=$(cd "$(dirname "$0")" && pwd)
package=$here/../../build/web/package
[ -d "$package" ] || { echo "make_site.sh: web/build.sh has to be run first" >&2; exit 1; }
mkdir -p "$1/demo"
rm -rf "$1/package"
cp -r "$package" "$1/package"
cp "$here"/index.html "$here"/demo.css "$here"/demo.js "$1/demo/"

# The sample, where its three.js has been installed.
avatar=$here/../samples/avatar
three=${THREE:-$avatar/node_modules/three}
[ -d "$three" ] || { echo "make_site.sh: no three.js: the avatar sample is left out" >&2; exit 0; }
mkdir -p "$1/avatar"
cp "$avatar"/index.html "$avatar"/avatar.js "$1/avatar/"
for file in build/three.module.min.js build/three.core.min.js examples/jsm/loaders/GLTFLoader.js \
            examples/jsm/utils/BufferGeometryUtils.js; do
  mkdir -p "$1/three/$(dirname "$file")"
  cp "$three/$file" "$1/three/$file"
done
