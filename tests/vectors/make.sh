#!/bin/sh
# make.sh [BUILD]: remakes all vectors with the current encoder. BUILD is a configured build folder, default build/release.
# Only for changes of the format; the commit says why.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
build=${1:-$here/../../build/release}
cmake --build "$build" --target make_vectors
rm -f "$here"/*.fbs
"$build/make_vectors" "$here"
du -bc "$here"/*.fbs | tail -1
