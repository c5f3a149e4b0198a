"""Landmarks of another tracker are one more start for the fit of each picture."""
import csv
import re

from harness import CLOSE_TRUTH, CLOSE_Y4M, TALK_TRUTH, TALK_Y4M, ProgramTest

USED = re.compile(r"landmarks used in (\d+) of (\d+) pictures that have them")


class Landmarks(ProgramTest):
    def encode(self, *options):
        """The summary of an encoding, on standard error."""
        done = self.fbs("encode", CLOSE_Y4M, "out.fbs", "--patterns", "1", "--frames", "60", *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stderr.decode()

    def face_psnr(self, summary):
        return float(re.search(r"PSNR face (\S+) dB", summary)[1])

    def table(self, change):
        """The truth as a table `change`s it: of a row as a dictionary, or None for no such row."""
        with open(CLOSE_TRUTH, newline="") as source, open(self.folder / "table.csv", "w", newline="") as out:
            rows = csv.DictReader(source)
            names = ["frame"] + [axis + str(k) for k in range(68) for axis in "xy"]
            writer = csv.DictWriter(out, names, extrasaction="ignore")
            writer.writeheader()
            for row in map(change, rows):
                if row:
                    writer.writerow(row)
        return "table.csv"

    def test_true_landmarks_are_used_and_do_no_harm(self):
        plain, helped = self.encode(), self.encode("--landmarks", CLOSE_TRUTH)
        self.assertIsNone(USED.search(plain))
        used, given = map(int, USED.search(helped).groups())
        self.assertEqual(given, 59, "all but the first, from which the tracker's own error is learned")
        self.assertGreater(used, 10)
        self.assertGreater(self.face_psnr(helped), self.face_psnr(plain) - 0.1)

    def test_wrong_landmarks_are_not_used(self):
        def gaping(row):
            """In every other picture the lower lip is 25 pixels too low."""
            for k in (*range(55, 60), *range(65, 68)):
                row[f"y{k}"] = str(float(row[f"y{k}"]) + 25 * (int(row["frame"]) % 2))
            return row
        plain, misled = self.encode(), self.encode("--landmarks", self.table(gaping))
        used, given = map(int, USED.search(misled).groups())
        self.assertEqual(given, 59)
        self.assertLess(used, 45)
        self.assertGreater(self.face_psnr(misled), self.face_psnr(plain) - 0.2)

    def test_pictures_without_landmarks(self):
        summary = self.encode("--landmarks", self.table(lambda row: row if int(row["frame"]) % 3 == 0 else None))
        self.assertEqual(int(USED.search(summary)[2]), 19)

    def test_own_export_can_be_read(self):
        self.encode()
        self.succeed("export", "out.fbs", "own.csv")
        self.assertIn("pictures that have them", self.encode("--landmarks", "own.csv"))

    def test_refusals(self):
        def refused(text, *says):
            self.write("bad.csv", text)
            self.fail_cleanly("encode", TALK_Y4M, "out.fbs", "--landmarks", "bad.csv", says=("bad.csv", *says))
        good = TALK_TRUTH.read_bytes()
        head = good.partition(b"\n")[0]
        refused(b"", "empty")
        refused(b"\x00\xff\xfe" * 50, "line 1", "x0")
        refused(head + b"\n1,2\n", "line 2", "2 fields")
        refused(head.replace(b"x66", b"z66") + b"\n", "x66")
        refused(head + b"\n", "no row")
        refused(good + good.splitlines()[1] + b"\n", "line 122", "line 2")
        self.fail_cleanly("encode", TALK_Y4M, "out.fbs", "--landmarks", "none.csv", says=("none.csv", "cannot read"))
        self.fail_cleanly("encode", "camera:0", "out.fbs", "--landmarks", TALK_TRUTH, says=("--landmarks", "camera"))

    def test_the_table_is_not_overwritten(self):
        self.write("table.fbs", CLOSE_TRUTH.read_bytes())
        self.fail_cleanly("encode", CLOSE_Y4M, "table.fbs", "--landmarks", "table.fbs", says=("--landmarks",))
