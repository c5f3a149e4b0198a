"""A program that stands for fbs: quick, and what it does is decided by the first word of a clip."""

import json
import pathlib

import pytest

SCRIPT = r"""#!/bin/sh
# fbs VERB FILE ...; the first line of a clip says what becomes of it: ok, broken, killer, slow, hang.
echo "$@" >> "$FAKE_LOG"
fail() { echo "fbs: $1" >&2; exit 1; }
case $1 in
--version) echo "fbs 9.9" ;;
encode)
  read -r what < "$2"
  case $what in
  broken) fail "$2: not a video" ;;
  killer) kill -9 $PPID; sleep 10 ;;
  slow) sleep 0.4 ;;
  hang) sleep 60 ;;
  esac
  echo "$5" > "$3" ;;  # encode CLIP STREAM --quality Q
inspect) cat "$FAKE_ANSWERS/inspect.json" ;;
decode) ;;
export) cp "$FAKE_ANSWERS/export.csv" "$3" ;;
evaluate)
  table=
  for word; do [ "$previous" = --csv ] && table=$word; previous=$word; done
  [ -z "$table" ] || cp "$FAKE_ANSWERS/pictures.csv" "$table"
  case "$*" in
  *--peers*) cat "$FAKE_ANSWERS/peer.json" ;;
  *) sed "s/QUALITY/$(cat "$3")/g" "$FAKE_ANSWERS/evaluate.json" ;;
  esac ;;
esac
"""

PARTS = {"total": 1000, "startup": 500, "geometry": 100, "patterns": 700, "motion": 150, "sound": 0}


def _point(codec, name, kbps, psnr, parts):
    return {
        "point": name, "codec": codec, "frames": 10, "seconds": 0.4, "kbps": kbps, "bytes": parts,
        "psnr_face": psnr, "psnr_frame": psnr, "psnr_u_face": 40, "psnr_v_face": 40, "psnr_u_frame": 40, "psnr_v_frame": 40,
        "ssim_face": 0.9, "ssim_frame": 0.9, "ms_ssim_face": 0.9, "ms_ssim_frame": 0.9,
    }  # fmt: skip


def write_fake(folder: pathlib.Path) -> pathlib.Path:
    """Write the program and its answers; give its path."""
    region = {"from": "a mesh", "frames": 9}
    # kbps and psnr_face are the quality itself.
    report = json.dumps({"points": [_point("fbs", "x", "QUALITY", "QUALITY", PARTS)], "region": region})
    (folder / "evaluate.json").write_text(report.replace('"QUALITY"', "QUALITY"))
    peers = [_point("AV1", f"AV1 crf {crf}", 100 - crf, 90 - crf, {"total": 2000}) for crf in (63, 57, 51, 45, 39)]
    (folder / "peer.json").write_text(json.dumps({"points": [], "peers": peers, "region": region}))
    stream = {"width": 64, "height": 48, "fps": 25.0, "pattern_count": 2, "scenes": [{}, {}]}
    (folder / "inspect.json").write_text(json.dumps(stream))
    (folder / "export.csv").write_text(
        "frame,rx_deg,ry_deg,tx_px,ty_px,x36,y36,x45,y45,timestamp,success\n"
        "0,1,-10,30,20,20,20,40,20,0.00,1\n1,1,0,34,23,20,20,40,20,0.04,1\n2,1,10,38,26,20,20,40,20,0.08,1\n"
    )
    (folder / "pictures.csv").write_text(
        "picture,psnr_y,face_psnr_y,face_samples\n0,30,31,300\n1,29,,0\n2,20,22,324\n3,31,32,300\n"
    )
    program = folder / "fbs"
    program.write_text(SCRIPT)
    program.chmod(0o755)
    return program


class Calls:
    """What the fake program has been asked to do."""

    def __init__(self, path: pathlib.Path):
        self.path = path

    def lines(self, verb=""):
        lines = self.path.read_text().splitlines() if self.path.exists() else []
        return [line for line in lines if line.startswith(verb)]

    def clear(self):
        self.path.write_text("")


def make_clips(folder: pathlib.Path, **clips: str) -> pathlib.Path:
    """Clips by name, each with the word that decides what becomes of it."""
    folder.mkdir(exist_ok=True)
    for name, what in clips.items():
        (folder / f"{name}.y4m").write_text(what + "\n")
    return folder


@pytest.fixture(scope="module")
def fake(tmp_path_factory):
    """The fake program in FBS_PROGRAM, for processes that are started from now on; gives what is called."""
    folder = tmp_path_factory.mktemp("fake")
    calls = Calls(folder / "calls.log")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("FBS_PROGRAM", str(write_fake(folder)))
        patch.setenv("FAKE_LOG", str(calls.path))
        patch.setenv("FAKE_ANSWERS", str(folder))
        yield calls
