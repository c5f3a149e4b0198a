"""A second of black in real clips: the face is found again within half a second. The reference is
the pose tracked without the black. Skipped where ../shared/clips is missing; FBS_SHARED names another folder."""
import pathlib
import statistics
import sys
import unittest

from clips import CLIPS, REASON_TO_SKIP
from edited_pictures import black, y4m_bytes
from harness import ProgramTest, ffmpeg, read_y4m

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "truth"))
import truth  # noqa: E402

LOST, BACK, PICTURES = 71, 100, 130
WITHIN = 15       # pictures
PERCENT = 15.0    # of the eye distance: the same face, if not yet the same state
SAME_CLIPS = ("akiyo_cif", "carphone_qcif", "claire_qcif", "foreman_cif", "woman_expressions_512")


class LostOnClips(ProgramTest):
    def followed(self, width, height, pictures):
        self.write("in.y4m", y4m_bytes(width, height, pictures))
        self.succeed("encode", "in.y4m", "out.fbs", "--quiet")
        self.succeed("export", "out.fbs", "out.csv")
        return truth.read(self.folder / "out.csv")

    def clip(self, name):
        if not (CLIPS / (name + ".mkv")).exists():
            raise unittest.SkipTest(f"no {CLIPS / name}.mkv: {REASON_TO_SKIP}")
        ffmpeg("-i", CLIPS / (name + ".mkv"), "-frames:v", str(PICTURES), "-pix_fmt", "yuv420p", self.folder / "clip.y4m")
        clip = read_y4m(self.folder / "clip.y4m")
        plain = self.followed(clip.width, clip.height, clip.pictures)
        pictures = list(clip.pictures)
        pictures[LOST:BACK] = [black(pictures[0], clip.width, clip.height)] * (BACK - LOST)
        found = self.followed(clip.width, clip.height, pictures)
        off = [statistics.fmean(100 * truth.distance(p, q) / there.scale for p, q in zip(here.points, there.points))
               for here, there in zip(found, plain, strict=True)]
        print("from the return on:", *(f"{v:.0f}" for v in off[BACK:]))
        late = [i - BACK for i in range(BACK + WITHIN, PICTURES) if not off[i] <= PERCENT]
        self.assertEqual(late, [], "pictures after the return in which the face is in the wrong place")


for name in SAME_CLIPS:
    setattr(LostOnClips, "test_" + name, lambda self, name=name: self.clip(name))
