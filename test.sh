#!/usr/bin/env bash
# test.sh [--all | KIND...]: installs missing packages, builds the release program (build/release/fbs) and tests it.
#   without arguments   unit tests, vectors, the second decoder, layering, bad input and the program's main paths: minutes
#   --all               every kind, quick tests first
#   KIND...             unit vectors second_decoder layering exact program fuzz truth gstreamer python web tidy; and asan,
#                       unit tests, damaged streams and bad input again, with the address and undefined-behaviour sanitizers
# Last line: N passed, N failed, N skipped. Exit code 1 when a test failed.
set -euo pipefail
cd "$(dirname "$0")"
jobs=$(nproc)
status=0 reports=()

lists=(packages.txt program_packages.txt test_packages.txt) targets=(fbs_quick)
for kind in "$@"; do
  case $kind in
    unit|vectors|second_decoder|layering) ;;
    exact|program|fuzz|truth|gstreamer|python|tidy|asan) lists+=(all_packages.txt) targets=(all) ;;
    web) lists+=(all_packages.txt web_packages.txt) targets=(all) ;;
    --all) lists+=(all_packages.txt web_packages.txt) targets=(all fbs_tools) ;;
    *) sed -n '2,/^# Last/s/^# //p' "$0" >&2; exit 2 ;;
  esac
done
scripts/install_packages.sh "${lists[@]}"

# build PRESET TARGET...
build() {
  echo "== $1: build"
  cmake --preset "$1" >/dev/null
  cmake --build --preset "$1" --target "${@:2}"
}

# run PRESET NAME [ctest option ...]: runs tests, and writes their counts to build/PRESET/NAME.xml
run() {
  local preset=$1 report=build/$1/$2.xml
  echo "== $preset: $2"
  rm -f "$report"
  ctest --preset "$preset" --parallel "$jobs" --no-tests=error --output-junit "$2.xml" "${@:3}" || status=1
  [ -s "$report" ] || { echo "$preset: ctest did not finish"; exit 1; }
  reports+=("$report")
}

# count NAME: the sum of this attribute over all reports
count() {
  local report sum=0
  for report in "${reports[@]}"; do
    sum=$((sum + $(grep -oPm1 "\b$1=\"\K\d+" "$report")))
  done
  echo "$sum"
}

under_sanitizers() {
  build asan fbs_sanitized
  run asan tests --label-regex sanitized --label-exclude slow
}

case "$*" in
  "")
    build release fbs_quick
    run release quick --label-regex quick
    ;;
  *--all*)
    build release "${targets[@]}"
    run release quick --label-regex quick
    run release others --label-exclude quick --fixture-exclude-setup program_material
    under_sanitizers
    ;;
  asan) under_sanitizers ;;
  *)
    build release "${targets[@]}"
    run release kinds --tests-regex "^($(IFS='|'; echo "$*"))(\.|$)"
    [[ " $* " != *" asan "* ]] || under_sanitizers
    ;;
esac

failed=$(count failures)
skipped=$(($(count skipped) + $(count disabled)))
echo "$(($(count tests) - failed - skipped)) passed, $failed failed, $skipped skipped"
exit "$status"
