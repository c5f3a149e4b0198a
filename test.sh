#!/usr/bin/env bash
# Installs missing packages, builds the release program (build/release/fbs) and runs all tests. Then builds with the
# address and undefined-behaviour sanitizers and runs all but the slow tests again.
# Last line: N passed, N failed, N skipped, over both runs. Exit code 1 when a test failed.
set -euo pipefail
cd "$(dirname "$0")"
jobs=$(nproc)
status=0

scripts/install_packages.sh packages.txt web_packages.txt

# test_preset PRESET [ctest option ...]: builds, runs ctest, writes its counts to build/PRESET/tests.xml
test_preset() {
  local preset=$1
  shift
  echo "== $preset: build"
  cmake --preset "$preset" >/dev/null
  cmake --build --preset "$preset"
  echo "== $preset: tests"
  rm -f "build/$preset/tests.xml"
  ctest --preset "$preset" --parallel "$jobs" --no-tests=error --output-junit tests.xml "$@" || status=1
  [ -s "build/$preset/tests.xml" ] || { echo "$preset: ctest did not finish"; exit 1; }
}

# count NAME: the sum of this attribute over both reports
count() {
  local report sum=0
  for report in build/{release,asan}/tests.xml; do
    sum=$((sum + $(grep -oPm1 "\b$1=\"\K\d+" "$report")))
  done
  echo "$sum"
}

test_preset release
test_preset asan --label-exclude slow

failed=$(count failures)
skipped=$(($(count skipped) + $(count disabled)))
echo "$(($(count tests) - failed - skipped)) passed, $failed failed, $skipped skipped"
exit "$status"
