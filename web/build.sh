#!/usr/bin/env bash
# Builds the browser player: build.sh [FOLDER] makes FOLDER/package (default: build/web/package), as npm has packages.
# What it downloads and the libraries are kept in FOLDER: a second build is quick, and needs no network.
set -euo pipefail
cd "$(dirname "$0")/.."
out=$(mkdir -p "${1:-build/web}" && cd "${1:-build/web}" && pwd)
export NODE_PATH=${NODE_PATH:-/usr/share/nodejs}  # where Debian has acorn, which emscripten needs
if command -v ccache >/dev/null; then  # what was compiled once, in this clone or another, is not compiled again
  export EM_COMPILER_WRAPPER=ccache CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1
fi

# Vectors make no difference to the libraries: both modules have the same.
web/libraries/make.py "$out/libraries" --sources "$out/sources"

# build VARIANT FLAGS
build() {
  if [ ! "$out/$1/build.ninja" -nt "$out/libraries/complete" ]; then
    rm -rf "${out:?}/$1"
    emcmake cmake -S web -B "$out/$1" -G Ninja -DCMAKE_BUILD_TYPE=Release -DLIBRARIES="$out/libraries" \
      -DCMAKE_C_FLAGS="$2" -DCMAKE_CXX_FLAGS="$2" >"$out/$1.log" 2>&1 || { cat "$out/$1.log"; exit 1; }
  fi
  cmake --build "$out/$1"
}
build simd -msimd128
build plain ""

package=$out/package
rm -rf "$package"
mkdir -p "$package/src"
tsc -p web --noEmit false --removeComments --outDir "$out/scripts"  # comments take a quarter of the bytes
cp "$out"/scripts/src/*.js web/src/*.ts "$package/src/"
cp "$out/simd/fbs.wasm" "$package/src/fbs-simd.wasm"
cp "$out/plain/"{fbs,preview,opus,codec2}.wasm "$package/src/"  # one picture and sound have no use for vectors
chmod 644 "$package"/src/*.wasm
# The service worker knows the files, and another version by its hash.
(
  cd "$package/src"
  files=$(ls -- *.js *.wasm | grep -vx 'service_worker.js\|preview.wasm')
  version=$(cat -- *.js *.wasm | sha256sum | cut -c1-16)
  probe=$(sed -n '/VECTOR_PROBE = /{n; s/,$//p}' fbs_module.js)
  sed -i "s/@VERSION@/$version/; s/@FILES@/$(echo $files)/; s/@PROBE@/$probe/" service_worker.js
)
cp web/package.json web/README.md LICENSE "$package/"
# license NAME FILE...: of what is in the modules
license() {
  printf '==== %s\n\n' "$1"
  cat "${@:2}"
  printf '\n\n'
}
{
  echo "The modules of this package contain parts of these libraries. libcodec2 is in codec2.wasm alone."
  echo
  license "dav1d" "$out/sources/dav1d/COPYING"
  license "Draco" "$out/sources/draco/debian/copyright" /usr/share/common-licenses/Apache-2.0
  license "Opus" "$out/sources/opus/COPYING"
  license "Codec 2, GNU Lesser General Public License 2.1" "$out/sources/codec2/COPYING"
  for name in libhwy-dev libglm-dev emscripten; do
    license "$name" "/usr/share/doc/$name/copyright"
  done
} >"$package/LICENSE-THIRD-PARTY"
