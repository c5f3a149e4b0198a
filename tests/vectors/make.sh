#!/bin/sh
# Rewrites all vectors with the current encoder: make.sh [BUILD], BUILD being a configured build folder.
# Use it only after a change of the format, and justify it in the commit.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
build=${1:-$here/../../build/release}
cmake --build "$build" --target make_vectors
rm -f "$here"/*.fbs
"$build/make_vectors" "$here"
du -bc "$here"/*.fbs | tail -1
