"""The output of inspect, export and evaluate."""
import csv
import json
import math
import os

from harness import FAILED, LITTLE_LOST, TALK_FBS, TALK_TRUTH, TALK_Y4M, ProgramTest, talker

PARTS = ("geometry", "patterns", "motion", "index", "other")
STATE = ("pose", "light", "mouth interior", "body", "ground", "mouth", "brows", "upper lids", "lower lids", "gaze")
POSE = ["frame", "rx_deg", "ry_deg", "rz_deg", "tx_px", "ty_px", "scale"]
POINTS = [axis + str(k) for k in range(68) for axis in "xy"]


def rows(path):
    with open(path, newline="") as table:
        reader = csv.DictReader(table)
        return reader.fieldnames, [{key: float(value) for key, value in row.items()} for row in reader]


class Measure(ProgramTest):
    def test_inspect_parts_sum_to_the_file(self):
        reported = json.loads(self.succeed("inspect", TALK_FBS, "--json"))
        size = os.path.getsize(TALK_FBS)
        self.assertEqual(sum(reported["bytes"][part] for part in PARTS), size)
        self.assertEqual(reported["bytes"]["total"], size)
        self.assertTrue(0 < reported["bytes"]["startup"] < size)
        self.assertEqual((reported["width"], reported["height"], reported["frames"], reported["fps"]), (176, 144, 120, 30))

    def test_inspect_motion_by_part_sums_to_the_motion(self):
        reported = json.loads(self.succeed("inspect", TALK_FBS, "--json"))
        self.assertEqual(set(reported["motion"]), {*STATE, "durations", "blend", "packets"})
        # Each is rounded to a byte.
        self.assertAlmostEqual(sum(reported["motion"].values()), reported["bytes"]["motion"], delta=len(reported["motion"]) / 2)
        self.assertTrue(all(size >= 0 for size in reported["motion"].values()), reported["motion"])
        self.assertGreater(reported["motion"]["pose"], 50)
        self.assertGreater(reported["motion"]["mouth"], 50)
        self.assertEqual(reported["motion"]["durations"], 0, "a constant frame rate")

    def test_startup_is_what_the_first_picture_needs(self):
        stream = TALK_FBS.read_bytes()
        startup = json.loads(self.succeed("inspect", TALK_FBS, "--json"))["bytes"]["startup"]
        self.write("enough.fbs", stream[:startup])
        self.write("short.fbs", stream[:startup - 1])
        self.assertEqual(self.fbs("decode", "enough.fbs", "null:", "--keep-going").returncode, LITTLE_LOST)
        self.assertEqual(self.fbs("decode", "short.fbs", "null:", "--keep-going").returncode, FAILED)

    def test_inspect_reads_a_pipe(self):
        self.assertEqual(self.succeed("inspect", "-", "--json", stdin=TALK_FBS.read_bytes()),
                         self.succeed("inspect", TALK_FBS, "--json"))

    def test_inspect_as_text_names_every_part(self):
        text = self.succeed("inspect", TALK_FBS).decode()
        for word in (*PARTS, "total", "176 x 144", "120 pictures"):
            self.assertEqual(word in text, word != "index", word)  # a key of the JSON only

    def test_export_has_a_row_for_each_picture(self):
        self.succeed("export", TALK_FBS, "out.csv")
        header, table = rows(self.folder / "out.csv")
        self.assertEqual(header[:len(POSE + POINTS)], POSE + POINTS)
        self.assertEqual([row["frame"] for row in table], list(range(120)))
        for row in table:
            self.assertTrue(all(math.isfinite(row[name]) for name in POSE))
            self.assertGreaterEqual(sum(math.isfinite(row[name]) for name in POINTS), 2 * 51)

    def test_export_finds_the_talkers_points(self):
        self.succeed("export", TALK_FBS, "out.csv")
        _, table = rows(self.folder / "out.csv")
        _, truth = rows(TALK_TRUTH)
        inner = range(17, 68)  # without the jaw, which is hidden at times
        error = count = 0
        for row, true in zip(table, truth, strict=True):
            for k in inner:
                if math.isfinite(row[f"x{k}"]):
                    error += math.hypot(row[f"x{k}"] - true[f"x{k}"], row[f"y{k}"] - true[f"y{k}"])
                    count += 1
        eye_distance = 0.15 * 144
        self.assertLess(error / count, 0.15 * eye_distance)

    def test_export_follows_the_talkers_pose(self):
        self.succeed("export", TALK_FBS, "out.csv")
        _, table = rows(self.folder / "out.csv")
        _, truth = rows(TALK_TRUTH)
        for angle, degrees in (("rx_deg", 4), ("ry_deg", 4), ("rz_deg", 2)):
            begin, begin_true = table[0][angle], truth[0][angle]
            off = [(row[angle] - begin) - (true[angle] - begin_true) for row, true in zip(table, truth, strict=True)]
            self.assertLess(math.sqrt(sum(v * v for v in off) / len(off)), degrees, angle)

    def test_evaluate_a_stream(self):
        reported = json.loads(self.succeed("evaluate", TALK_Y4M, TALK_FBS, "--json"))
        (point,) = reported["points"]
        size = os.path.getsize(TALK_FBS)
        self.assertEqual((point["frames"], point["bytes"]["total"]), (120, size))
        self.assertAlmostEqual(point["kbps"], size * 8 / 4 / 1000, places=6)
        for key in ("psnr_face", "psnr_frame"):
            self.assertTrue(20 < point[key] < 60, key)
        for key in ("ssim_face", "ssim_frame"):
            self.assertTrue(0.5 < point[key] <= 1, key)

    def test_evaluate_without_stream_encodes(self):
        with_stream, without = (json.loads(self.succeed("evaluate", TALK_Y4M, *stream, "--json"))["points"][0]
                                for stream in ((TALK_FBS,), ("--quality", "50")))
        for key in ("frames", "kbps", "bytes", "psnr_face", "psnr_frame"):
            self.assertEqual(with_stream[key], without[key], key)

    def test_evaluate_encodes_at_five_qualities_by_default(self):
        talker(self.folder / "short.y4m", "--size", "128x96", "--frames", "6")
        points = json.loads(self.succeed("evaluate", "short.y4m", "--json"))["points"]
        self.assertEqual([point["point"] for point in points], [f"quality {n}" for n in (20, 35, 50, 65, 80)])

    def test_quality_buys_pictures(self):
        points = json.loads(self.succeed("evaluate", TALK_Y4M, "--quality", "10", "50", "90", "--json"))["points"]
        self.assertEqual(len(points), 3)
        for key in ("kbps", "psnr_frame", "psnr_face"):
            values = [point[key] for point in points]
            self.assertEqual(values, sorted(set(values)), key)

    def test_evaluate_as_text_has_a_line_for_each_quality(self):
        lines = self.succeed("evaluate", TALK_Y4M, "--quality", "30", "60").decode().splitlines()
        self.assertEqual(len([line for line in lines if line.startswith("quality ")]), 2)
        self.assertIn("kbit/s", lines[0])
