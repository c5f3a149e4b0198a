"""The mouth moves because of its contours: without them, one pattern does not follow the speaker."""
import csv

from harness import ProgramTest, read_y4m, talker


class Snakes(ProgramTest):
    def test_mouth_needs_them(self):
        talker(self.folder / "talk.y4m", "--size", "176x144", "--frames", "60", "--motion", "talk",
               "--truth", self.folder / "talk.csv")
        self.succeed("encode", "talk.y4m", "with.fbs", "--patterns", "1")
        self.succeed("encode", "talk.y4m", "without.fbs", "--patterns", "1", "--no-expression")
        source, with_snakes, without = read_y4m(self.folder / "talk.y4m"), self.decoded("with.fbs"), self.decoded("without.fbs")
        mouth = self.mouth()
        self.assertNotEqual(with_snakes.pictures, without.pictures)
        self.assertGreater(with_snakes.luma_psnr(source, mouth), without.luma_psnr(source, mouth) + 1)

    def mouth(self):
        """The bounding box of the lips of all pictures, from the talker's truth."""
        with open(self.folder / "talk.csv", newline="") as table:
            rows = list(csv.DictReader(table))
        xs, ys = ([float(row[axis + str(k)]) for row in rows for k in range(48, 68)] for axis in "xy")
        return int(min(xs)), int(min(ys)), int(max(xs)) + 1, int(max(ys)) + 1
