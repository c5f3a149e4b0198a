"""The real clips and the requirements on each: clip_floors.txt."""
import dataclasses
import json
import pathlib
import unittest

from harness import SHARED, ffmpeg, read_y4m

CLIPS = SHARED / "clips"
FLOORS_FILE = pathlib.Path(__file__).parent / "clip_floors.txt"
REASON_TO_SKIP = "the clips are not part of the repository; FBS_SHARED=FOLDER names the folder that holds clips/"


@dataclasses.dataclass
class Row:
    clip: str
    frames: int           # number of pictures to encode
    face_db: float        # minimum luma PSNR in the decoded mesh
    frame_db: float       # minimum over the whole picture
    startup_bytes: int    # maximum, like all that follow
    motion_kbps: float
    total_kbps: float

    @staticmethod
    def heading():
        return f"{'# clip':24} {'frames':>6} {'face dB':>8} {'frame dB':>9} {'startup B':>10} {'motion kbit/s':>14} {'total kbit/s':>13}"

    def __str__(self):
        return (f"{self.clip:24} {self.frames:6} {self.face_db:8.2f} {self.frame_db:9.2f} {self.startup_bytes:10}"
                f" {self.motion_kbps:14.2f} {self.total_kbps:13.2f}")


def read_floors():
    def row(line):
        values = line.split()
        return Row(*(field.type(value) for field, value in zip(dataclasses.fields(Row), values, strict=True)))
    return [row(line) for line in FLOORS_FILE.read_text().splitlines() if line and not line.startswith("#")]


FLOORS = read_floors()


def first_pictures(test, clip, frames):
    """Makes a Y4M file of the first `frames` pictures of `clip` in the folder of `test`, which is skipped where the clip
    is missing. Returns its path."""
    path, out = CLIPS / (clip + ".mkv"), test.folder / "in.y4m"
    if not path.exists():
        raise unittest.SkipTest(f"no {path}: {REASON_TO_SKIP}")
    ffmpeg("-i", path, "-frames:v", str(frames), "-pix_fmt", "yuv420p", out)
    return out


def measure(test, clip, frames):
    """Encodes and decodes the first `frames` pictures of `clip` at the default quality, in the folder of `test`, a
    ProgramTest, which fails unless the same number of pictures, of the same size and rate, comes back. Returns a Row."""
    source = read_y4m(first_pictures(test, clip, frames)).shape
    test.succeed("encode", "in.y4m", "out.fbs")
    test.succeed("decode", "out.fbs", "out.y4m")
    test.assertEqual(read_y4m(test.folder / "out.y4m").shape, source)
    point = json.loads(test.succeed("evaluate", "in.y4m", "out.fbs", "--json"))["points"][0]
    size = point["bytes"]
    return Row(clip, source[2], round(point["psnr_face"], 2), round(point["psnr_frame"], 2), size["startup"],
               round(size["motion"] * 8e-3 / point["seconds"], 2), round(point["kbps"], 2))
