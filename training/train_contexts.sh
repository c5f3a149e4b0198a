#!/bin/sh
# Encodes clips with the built program and learns bitstream/entropy/trained_contexts.cpp: train_contexts.sh BUILD VIDEO...
set -eu
build=$1
shift
streams=$(mktemp -d)
trap 'rm -rf "$streams"' EXIT
cmake --build "$build" --target fbs train_contexts
for video; do
  name=$streams/$(basename "${video%.*}")
  for options in "--quality 20" "--quality 70" "--quality 50 --live" "--quality 40 --live --resilience packet"; do
    # shellcheck disable=SC2086  # several options
    "$build/fbs" encode "$video" "$name.$(echo $options | tr -d ' -').fbs" $options --allow-no-face --no-sound --quiet
  done
done
"$build/train_contexts" "$(dirname "$0")/../bitstream/entropy/trained_contexts.cpp" "$streams"/*.fbs
