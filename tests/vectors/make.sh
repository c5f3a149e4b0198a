#!/bin/sh
# Writes all vectors anew with the present encoder: make.sh [BUILD], BUILD being a configured build folder.
# For after a change of the format; say in the commit why the old ones may go.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
build=${1:-$here/../../build/release}
cmake --build "$build" --target make_vectors
rm -f "$here"/*.fbs
"$build/make_vectors" "$here"
du -bc "$here"/*.fbs | tail -1
