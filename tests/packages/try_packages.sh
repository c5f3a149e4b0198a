#!/usr/bin/env bash
# Installs the Debian packages in a bare Debian 12, uses, upgrades and purges them: try_packages.sh [PACKAGES [FOLDER]], as root.
#   PACKAGES  their folder (default: build/debian/packages)
#   FOLDER    keeps the bare system, downloads and pictures of the screen (default: build/debian/chroot)
# A line for each thing tried; exit code 1 when one failed, whose output is in FOLDER/log. Needs debootstrap, the network and
# the tests' vectors. Nothing outside FOLDER changes: what is installed lies over the bare system, in memory of this run.
set -euo pipefail
source=$(cd "$(dirname "$0")/../.." && pwd)
packages=$(realpath "${1:-$source/build/debian/packages}") folder=${2:-$source/build/debian/chroot}
mirror=${MIRROR:-http://deb.debian.org/debian}

if [ "${FBS_IN_NAMESPACE-}" != 1 ]; then  # mounts and processes of this run end with it
  FBS_IN_NAMESPACE=1 exec unshare --mount --pid --fork "$0" "$packages" "$folder"
fi
mkdir -p "$folder"/{archives/partial,top}
folder=$(realpath "$folder") root=$folder/root
[ -e "$folder/bare/etc/debian_version" ] || debootstrap --variant=minbase bookworm "$folder/bare" "$mirror" >"$folder/debootstrap.log"
mkdir -p "$root"
mount -t tmpfs -o size=8g tmpfs "$folder/top"
mkdir "$folder/top"/{upper,work}
mount -t overlay overlay -o "lowerdir=$folder/bare,upperdir=$folder/top/upper,workdir=$folder/top/work" "$root"
mkdir -p "$root"/{packages,newer,src,shots}
mount -t proc proc "$root/proc"
mount --bind /dev "$root/dev"
mount --bind "$folder/archives" "$root/var/cache/apt/archives"
mount --bind "$source" "$root/src"
cp "$packages"/*.deb "$root/packages/"
cp /etc/resolv.conf "$root/etc/" 2>/dev/null || true
exec 3>"$folder/log"
failed=0

# inside COMMAND: in the chroot, as root; user COMMAND: as somebody in /home/somebody
inside() {
  chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive bash -euo pipefail -c "$1"
}
user() {
  inside "cd /home/somebody; exec setpriv --reuid somebody --regid somebody --clear-groups env HOME=/home/somebody bash -euo pipefail -c '${1//\'/\'\\\'\'}'"
}
# try WHAT COMMAND...: a line of the table. What the command prints last stands in it.
try() {
  echo "=== $*" >&3
  local said result=ok
  said=$("${@:2}" 2>&1) || { result=FAILED failed=1; }
  echo "$said" >&3
  printf '%-6s  %-58s %s\n' "$result" "$1" "$(tail -n 1 <<<"$said" | cut -c -90)"
}
fetch() { inside "apt-get install -qq -y --no-install-recommends $*" >&3 2>&1; }
# installed NAME...: installs these packages; prints how many others come along, and what all that takes
installed() {
  inside "cd /packages; dpkg-query -Wf '\${Package}\n' | sort >/tmp/before
          apt-get install -qq -y --no-install-recommends $(printf './%s_*.deb ' "$@") >/tmp/apt 2>&1 || { cat /tmp/apt; exit 1; }
          dpkg-query -Wf '\${Package}\n' | sort | comm -13 /tmp/before - >/tmp/new; sed -i '/fbs/d' /tmp/new
          size=0; for kb in \$(dpkg-query -Wf '\${Installed-Size}\n' $* \$(cat /tmp/new)); do size=\$((size + kb)); done
          echo \$(wc -l </tmp/new) others, \$((size / 1024)) MB in all: \$(cat /tmp/new)"
}

inside "apt-get update -qq; useradd -m somebody" >&3 2>&1
cp "$source"/tests/vectors/talk.fbs "$root/home/somebody/"
inside 'chown -R somebody: /home/somebody; chmod 1777 /tmp /shots'
version=$(dpkg-deb -f "$packages"/fbs_*.deb Version)
soversion=$(cut -d . -f 1,2 <<<"$version")

# A decoder alone, then everything.
try "install libfbs" installed "libfbs$soversion"
try "install the program" installed fbs
try "no GStreamer, X server or OpenImageIO with it" inside "dpkg-query -Wf '\${Package}\n' | grep -E 'gstreamer|xserver|openimageio' && exit 1; echo none"
fetch man-db bash-completion xdg-utils desktop-file-utils shared-mime-info libfile-mimeinfo-perl libglib2.0-bin \
  xvfb xdotool imagemagick file
try "version" user "fbs --version"
try "decode to MP4, encode that, measure" user "fbs decode talk.fbs talk.mp4 --quiet; fbs encode talk.mp4 again.fbs --quiet;
  fbs evaluate talk.mp4 again.fbs | tail -n 1"
user "fbs decode talk.fbs talk.y4m --quiet; { head -n 1 talk.y4m; for i in \$(seq 15); do tail -n +2 talk.y4m; done; } >long.y4m
  fbs encode long.y4m long.fbs --quiet" >&3 2>&1
try "Matroska, model of the head, retarget" user "fbs remux talk.fbs talk.mkv; fbs export talk.fbs head.glb;
  fbs retarget --motion talk.fbs --face talk.fbs face.fbs --quiet; ls -s talk.mkv head.glb face.fbs | tr '\n' ' '"
try "a camera says which package it needs" user "{ fbs encode camera:0 me.fbs || true; } 2>&1 | grep -o '[(].*fbs-extra.*'"
try "man page, completion" user "man fbs-encode | head -n 1; source /usr/share/bash-completion/bash_completion;
  _completion_loader fbs || true; complete -p fbs"

# What a desktop does.
try "type by name" user "xdg-mime query filetype talk.fbs | grep -x video/x-fbs"
try "type by its first bytes" user "cp talk.fbs talk; xdg-mime query filetype talk | grep -x video/x-fbs"
try "the type's application" user "xdg-mime query default video/x-fbs | grep -x fbs.desktop"
try "desktop file is valid" inside "desktop-file-validate /usr/share/applications/fbs.desktop; echo valid"
try "thumbnail by the line of fbs.thumbnailer" user "line=\$(sed -n 's/^Exec=//p' /usr/share/thumbnailers/fbs.thumbnailer)
  line=\${line/\%i/\$PWD/talk.fbs} line=\${line/\%o//shots/thumbnail} line=\${line/\%s/128}; \$line; file /shots/thumbnail"
for desktop in GNOME ''; do
  try "a double click plays (xdg-open, XDG_CURRENT_DESKTOP=$desktop)" user "export DISPLAY=:7 XDG_CURRENT_DESKTOP=$desktop SDL_AUDIODRIVER=dummy
    Xvfb :7 -screen 0 640x480x24 -nolisten tcp & trap \"kill \$!\" EXIT; sleep 2
    xdg-open long.fbs 2>/dev/null & for i in \$(seq 60); do xdotool search --onlyvisible --name long.fbs && break; sleep .5; done
    for i in \$(seq 30); do  # a window that is there may still be empty
      import -window root /shots/1$desktop.png; sleep .3; import -window root /shots/2$desktop.png
      test \$(identify -format %k /shots/1$desktop.png) -le 1000 || cmp -s /shots/1$desktop.png /shots/2$desktop.png || break
      test \$i -lt 30
    done
    xdotool search --onlyvisible --name long.fbs; echo a window whose picture changes"
done
try "image files without fbs-extra" user "{ fbs decode talk.fbs p%02d.png || true; } 2>&1 | grep -o '[(].*fbs-extra.*'"
try "install fbs-extra" installed fbs-extra
try "image files with it" user "fbs decode talk.fbs p%02d.png --quiet; fbs encode p%02d.png images.fbs --quiet; ls p*.png | wc -l"

# Other programs.
fetch gcc g++ cmake make pkg-config libc6-dev libstb-dev
try "install libfbs-dev" installed libfbs-dev "libfbs$soversion" "libfbs-sound$soversion" "libfbs-encoder$soversion"
try "samples by pkg-config" user "cc /src/samples/print_landmarks.c -o landmarks \$(pkg-config --cflags --libs fbs)
  cc /src/samples/feed_in_pieces.c -o pieces \$(pkg-config --cflags --libs fbs)
  cc /src/samples/encode_frames.c -o frames \$(pkg-config --cflags --libs fbs-encoder)
  cc /src/samples/decode_to_png.c -o png \$(pkg-config --cflags --libs fbs stb) -lm
  ./landmarks talk.fbs | tail -n 1; ./pieces talk.fbs 7"
cat > "$root/home/somebody/CMakeLists.txt" <<'PROJECT'
cmake_minimum_required(VERSION 3.25)
project(user LANGUAGES C CXX)
find_package(fbs REQUIRED COMPONENTS encoder sound)
foreach(kind fbs fbs_static)
  add_executable(pieces_${kind} /src/samples/feed_in_pieces.c)
  target_link_libraries(pieces_${kind} PRIVATE fbs::${kind})
endforeach()
add_executable(frames /src/samples/encode_frames.c)
target_link_libraries(frames PRIVATE fbs::encoder fbs::sound)
PROJECT
try "samples by CMake, shared and static" user "cmake -S . -B build >log; cmake --build build >>log; ldd build/pieces_fbs_static | grep libfbs && exit 1
  cmp <(build/pieces_fbs talk.fbs 7) <(build/pieces_fbs_static talk.fbs 7); build/pieces_fbs_static talk.fbs 7"
fetch gstreamer1.0-tools
try "install gstreamer1.0-fbs" installed gstreamer1.0-fbs "libfbs$soversion" "libfbs-encoder$soversion"
try "gst-inspect-1.0 fbsdec" user "gst-inspect-1.0 fbsdec | grep Long-name"
try "a pipeline decodes, a sample encodes that" user "gst-launch-1.0 -q filesrc location=talk.fbs ! fbsparse ! fbsdec ! filesink location=raw
  build/frames 128 96 25 sample.fbs < raw; fbs inspect sample.fbs | head -n 1"
try "install python3-fbs" installed python3-fbs fbs "libfbs$soversion" "libfbs-encoder$soversion"
try "python3 -c 'import fbs'" user "python3 -c 'import fbs; d = fbs.Decoder(\"talk.fbs\"); print(next(d).rgb().shape, d.states.landmarks.shape)'"
try "Python runs the program" user "python3 -c 'import fbs; fbs.encode(\"talk.mp4\", \"py.fbs\"); print(len(fbs.inspect(\"py.fbs\")))'"

# Upgrade to packages that differ in the version alone, then purge.
for package in "$packages"/*.deb; do
  dpkg-deb -R "$package" "$folder/top/newer"
  sed -i "s/$version/$version+newer/g" "$folder/top/newer/DEBIAN/control"
  dpkg-deb --root-owner-group -b "$folder/top/newer" "$root/newer" >&3
  rm -r "$folder/top/newer"
done
try "upgrade all" inside "apt-get install -qq -y ./newer/*.deb >/tmp/apt 2>&1 || { cat /tmp/apt; exit 1; }
  dpkg-query -Wf '\${Package} \${Version} \${db:Status-Status}\n' '*fbs*' | tee /tmp/now | grep -c '+newer installed'; test \$(wc -l < /tmp/now) = $(ls "$packages"/*.deb | wc -l)"
try "it still works" user "fbs decode talk.fbs null: --quiet; python3 -c 'import fbs'; gst-inspect-1.0 fbsdec >/dev/null; build/pieces_fbs talk.fbs 7"
try "purge all" inside "apt-get purge -qq -y \$(dpkg-query -Wf '\${Package} ' '*fbs*') >/tmp/apt 2>&1 || { cat /tmp/apt; exit 1; }
  dpkg-query -Wf '\${Package}\n' '*fbs*' 2>/dev/null | grep . && exit 1; echo none is known any more"
try "nothing is left" inside "find /usr /etc /var /opt -xdev -name '*fbs*' ! -path '/var/cache/apt/*' | grep . && exit 1
  grep -rl x-fbs /usr/share/mime /usr/share/applications && exit 1; ldconfig -p | grep fbs && exit 1; echo no file, no type, no library"
try "no type any more" user "now=\$(xdg-mime query filetype talk.fbs); echo \$now; test \$now != video/x-fbs"
rm -rf "$folder/shots"
cp -r "$root/shots" "$folder/"
exit "$failed"
