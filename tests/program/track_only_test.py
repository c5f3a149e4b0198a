"""The paper's own path: contours alone move the face, and nothing is fitted to what is decoded."""
import csv
import json

from harness import CLOSE_Y4M, TALK_TRUTH, TALK_Y4M, ProgramTest


class TrackOnly(ProgramTest):
    def openings(self, table):
        """Height of the mouth between the inner lips in each picture."""
        with open(table, newline="") as rows:
            return [float(row["y66"]) - float(row["y62"]) for row in csv.DictReader(rows)]

    def correlation(self, a, b):
        mean_a, mean_b = sum(a) / len(a), sum(b) / len(b)
        deviations = [(x - mean_a, y - mean_b) for x, y in zip(a, b, strict=True)]
        return (sum(x * y for x, y in deviations)
                / (sum(x * x for x, _ in deviations) * sum(y * y for _, y in deviations)) ** 0.5)

    def test_contours_alone_open_the_mouth(self):
        self.succeed("encode", TALK_Y4M, "tracked.fbs", "--patterns", "1", "--track-only", "--quiet")
        self.succeed("encode", TALK_Y4M, "fitted.fbs", "--patterns", "1", "--quiet")
        self.assertNotEqual((self.folder / "tracked.fbs").read_bytes(), (self.folder / "fitted.fbs").read_bytes())
        self.succeed("export", "tracked.fbs", "tracked.csv")
        tracked, true = self.openings(self.folder / "tracked.csv"), self.openings(TALK_TRUTH)
        self.assertGreater(max(tracked) - min(tracked), 0.4 * (max(true) - min(true)))
        self.assertGreater(self.correlation(tracked, true), 0.7)

    def test_light_and_gaze_are_not_sent(self):
        for name, options in (("tracked.fbs", ("--track-only",)), ("fitted.fbs", ())):
            self.succeed("encode", CLOSE_Y4M, name, "--frames", "40", "--quiet", *options)
        tracked, fitted = (json.loads(self.succeed("inspect", name, "--json")) for name in ("tracked.fbs", "fitted.fbs"))
        self.assertLess(tracked["bytes"]["motion"], fitted["bytes"]["motion"])

    def test_there_is_no_fit_to_start_from_landmarks(self):
        self.fail_cleanly("encode", TALK_Y4M, "out.fbs", "--track-only", "--landmarks", TALK_TRUTH,
                          says=("--track-only", "--landmarks"))
