#!/usr/bin/env bash
# demo.sh [VIDEO]: encodes VIDEO, or a rendered talker, with fbs and with AV1, and writes a picture and a video of both
# beside the source to out/. AV1 gets at least the bitrate of fbs and, where it can go so low, at most three times as
# much; it may reduce the picture size for that.
set -euo pipefail
video=${1:+$(realpath "$1")}
cd "$(dirname "$0")"
mkdir -p out

scripts/install_packages.sh packages.txt
cmake --preset release >/dev/null
cmake --build --preset release --target fbs talker
fbs=build/release/fbs

if [ -z "$video" ]; then
  video=out/talker.y4m
  [ "$video" -nt build/release/talker ] || { echo "== rendering a talker"; build/release/talker "$video"; }
fi

echo "== fbs"
$fbs encode "$video" out/fbs.fbs
$fbs decode out/fbs.fbs out/fbs.mp4
$fbs evaluate "$video" out/fbs.fbs
$fbs export out/fbs.fbs out/fbs.csv

# By the indentation: parts of parts may have the same name.
from_stream() { $fbs inspect out/fbs.fbs --json | sed -n "s/^ \{1,2\}\"$1\": \([0-9.]*\).*/\1/p"; }
width=$(from_stream width) height=$(from_stream height) rate=$(from_stream fps) pictures=$(from_stream frames)
kbps_of() { awk "BEGIN { printf \"%.1f\", $1 * 8e-3 / $(from_stream seconds) }"; }
is() { awk "BEGIN { exit !($1) }"; }
# Without the voice: AV1 has none.
fbs_kbps=$(kbps_of "$(($(from_stream total) - $(from_stream sound)))")

echo "== AV1"
encode_av1() {  # DIVISOR CRF: width and height are divided by DIVISOR; sets av1_kbps
  ffmpeg -v error -nostdin -y -i "$video" -an -vf "scale=max(64\,trunc(iw/$1/2)*2):max(64\,trunc(ih/$1/2)*2)" \
    -pix_fmt yuv420p -c:v libsvtav1 -preset 4 -g 9999 -crf "$2" out/av1.mkv 2>/dev/null
  av1_kbps=$(kbps_of "$(ffprobe -v error -show_entries packet=size -of csv=p=0 out/av1.mkv | awk '{ s += $1 } END { print s }')")
  echo "size 1/$1, crf $2: $av1_kbps kbit/s"
}
crf=63
for divisor in 1 2 4; do
  encode_av1 $divisor $crf
  if is "$av1_kbps <= 3 * $fbs_kbps"; then break; fi
done
while is "$av1_kbps < $fbs_kbps && $crf > 7"; do encode_av1 $divisor $((crf -= 8)); done

# Pictures as Y4M, and their luma PSNR against the source. Face: the bounding box of brows, eyes, nose and mouth (landmarks
# 17 to 67) over all pictures.
fbs_pictures() { $fbs decode out/fbs.fbs - --quiet; }
av1_pictures() { ffmpeg -v error -nostdin -i out/av1.mkv -vf "scale=$width:$height" -f yuv4mpegpipe - 2>/dev/null; }
face=$(awk -F, -v w="$width" -v h="$height" 'NR == 1 { l = w; t = h; next }
  { for (i = 42; i <= 142; i += 2) if ($i != "nan") {
      if ($i < l) l = $i; if ($i > r) r = $i; if ($(i+1) < t) t = $(i+1); if ($(i+1) > b) b = $(i+1) } }
  END { l = l < 0 ? 0 : int(l); t = t < 0 ? 0 : int(t); r = r > w ? w : int(r); b = b > h ? h : int(b)
        print "crop=" r - l ":" b - t ":" l ":" t ":exact=1" }' out/fbs.csv)
psnr() {  # PICTURES FILTER
  ffmpeg -hide_banner -nostdin -r "$rate" -i "$video" -r "$rate" -f yuv4mpegpipe -i <("$1") -lavfi \
    "[0]format=yuv420p,$2[a];[1]format=yuv420p,$2[b];[a][b]psnr=shortest=1" -f null - 2>&1 |
    sed -n 's/.*PSNR y:\([0-9]*\.[0-9]\).*/\1/p'
}
fbs_face=$(psnr fbs_pictures "$face") fbs_frame=$(psnr fbs_pictures null)
av1_face=$(psnr av1_pictures "$face") av1_frame=$(psnr av1_pictures null)

echo "== comparison"
panel() {  # TEXT: a filter for a picture 480 pixels high above three lines of text
  printf "scale=-2:480:flags=lanczos,format=yuv420p,setsar=1,pad=iw:ih+96,drawtext=fontsize=22:fontcolor=white"
  printf ":fontfile=/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf:x=10:y=488:line_spacing=6:text='%s'" "$1"
}
ffmpeg -v error -nostdin -y -r "$rate" -i "$video" -r "$rate" -f yuv4mpegpipe -i <(fbs_pictures) \
  -r "$rate" -f yuv4mpegpipe -i <(av1_pictures) -filter_complex "
  [0]$(panel "source  $width x $height")[s];
  [1]$(panel "fbs  $fbs_kbps kbit/s
face $fbs_face dB
frame $fbs_frame dB")[f];
  [2]$(panel "AV1  $av1_kbps kbit/s
face $av1_face dB
frame $av1_frame dB")[a];
  [s][f][a]hstack=3:shortest=1,split[video][pictures];
  [pictures]select=eq(n\,$((pictures / 2)))[picture]" \
  -map "[video]" -c:v libx264 -crf 16 out/comparison.mp4 -map "[picture]" -frames:v 1 out/comparison.png

printf '\n%-5s %8s %16s %17s\n' "" kbit/s "face PSNR-Y, dB" "frame PSNR-Y, dB"
printf '%-5s %8s %16s %17s\n' fbs "$fbs_kbps" "$fbs_face" "$fbs_frame" AV1 "$av1_kbps" "$av1_face" "$av1_frame"
printf '%s\n' "" "out/comparison.png  source, fbs, AV1: picture $((pictures / 2))" "out/comparison.mp4  the same as a video" \
  "out/fbs.fbs         the stream" "out/fbs.mp4         the decoded stream"
