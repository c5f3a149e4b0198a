#!/usr/bin/env bash
# install_packages.sh [LIST...]: installs those packages of the lists in this folder that are missing: packages.txt and
# program_packages.txt unless lists are given. When none is, it needs neither network nor root.
set -euo pipefail
cd "$(dirname "$0")"
[ $# -gt 0 ] || set -- packages.txt program_packages.txt

if ! command -v dpkg-query >/dev/null; then
  echo "not a Debian system: assuming that the equivalents of these lists in scripts/ are installed: $*" >&2
  exit 0
fi

missing=()
for package in $(sed 's/#.*//' "$@"); do
  [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "run as root: apt-get install ${missing[*]}" >&2; exit 1; }
  as_root=(sudo)
fi
echo "== installing ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get update -q
"${as_root[@]}" apt-get install -qy --no-install-recommends "${missing[@]}" </dev/null
