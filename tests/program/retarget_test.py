"""One face with the motion of another."""
import csv
import math
import os
import pathlib
import statistics
import subprocess
import sys

from harness import (FBS, KEYED_FBS, SOURCE, TALK_FBS, TALK_ONE_FBS, TALK_Y4M, TWO_SCENES_FBS, ProgramTest, flat_y4m,
                     packets, talker)
from speech import make_speech

TOUCHING = 0.01        # eye distances
INNER_LIPS = ((61, 67), (62, 66), (63, 65))


def correlation(a, b):
    return statistics.correlation(a, b)


class Head:
    """The table that export writes."""

    def __init__(self, path):
        with open(path, newline="") as table:
            self.rows = [{key: float(value or "nan") for key, value in row.items()} for row in csv.DictReader(table)]

    def column(self, name):
        return [row[name] for row in self.rows]

    def distance(self, a, b):
        """Between two landmarks in each picture, eye distances."""
        return [math.dist((row[f"x{a}"], row[f"y{a}"]), (row[f"x{b}"], row[f"y{b}"])) / row["scale"] for row in self.rows]


class Retarget(ProgramTest):
    def head(self, stream):
        self.succeed("export", stream, "head.csv")
        return Head(self.folder / "head.csv")

    def retarget(self, motion, face, *options):
        self.succeed("retarget", "--motion", motion, "--face", face, "out.fbs", *options)
        return self.head("out.fbs")

    def close_up(self):
        """Another talker: larger, of another size, who turns more."""
        talker(self.folder / "close.y4m", "--size", "192x160", "--frames", "40", "--eye-distance", "0.2", "--seed", "5",
               "--yaw", "20", "--fps", "25")
        self.succeed("encode", "close.y4m", "close.fbs", "--quiet")
        return self.folder / "close.fbs"

    def test_oneself_stays_the_same(self):
        before, after = self.head(TALK_FBS), self.retarget(TALK_FBS, TALK_FBS)
        for name in ("rx_deg", "ry_deg", "rz_deg", "tx_px", "ty_px"):
            worst = max(abs(a - b) for a, b in zip(before.column(name), after.column(name), strict=True))
            self.assertLess(worst, 0.5, name)
        self.assertGreater(correlation(before.distance(62, 66), after.distance(62, 66)), 0.97)
        self.assertGreater(correlation(before.distance(37, 41), after.distance(37, 41)), 0.97)

    def test_sound_is_that_of_the_motion(self):
        make_speech(self.folder / "motion.fbs", 3, self.folder)
        make_speech(self.folder / "face.fbs", 2, self.folder, seed=8)
        self.succeed("decode", "motion.fbs", "motion.wav", "--quiet")
        self.retarget("motion.fbs", "face.fbs")
        self.succeed("decode", "out.fbs", "out.wav", "--quiet")
        self.assertEqual((self.folder / "out.wav").read_bytes(), (self.folder / "motion.wav").read_bytes())
        self.retarget("motion.fbs", "face.fbs", "--no-sound")
        self.fail_cleanly("decode", "out.fbs", "none.wav", says=["has no sound"])
        # A face with a voice has none to give.
        self.retarget(TALK_ONE_FBS, "face.fbs")
        self.fail_cleanly("decode", "out.fbs", "none.wav", says=["has no sound"])

    def test_motion_of_another(self):
        face = self.close_up()
        moves, shown = self.head(TALK_FBS), self.retarget(TALK_FBS, face)
        own = self.head(face)
        self.assertEqual(len(shown.rows), 120)
        for name, change in (("ry_deg", 2), ("rz_deg", 1)):
            relative = [[v - column[0] for v in column] for column in (moves.column(name), shown.column(name))]
            self.assertGreater(max(map(abs, relative[0])), change)
            self.assertLess(max(abs(a - b) for a, b in zip(*relative)), 0.7, name)
        # Far from where the other is, and as much larger as the face is.
        self.assertAlmostEqual(shown.column("tx_px")[0], own.column("tx_px")[0], delta=2)
        self.assertAlmostEqual(shown.column("scale")[0], own.column("scale")[0], delta=1)
        self.assertGreater(correlation(moves.distance(62, 66), shown.distance(62, 66)), 0.95)
        self.assertGreater(correlation(moves.distance(37, 41), shown.distance(37, 41)), 0.95)

    def test_pictures_decode_with_the_times_of_the_motion(self):
        face = self.close_up()
        self.retarget(TALK_FBS, face)
        decoded = self.decoded("out.fbs")
        self.assertEqual(decoded.shape, (192, 160, 120, 30))
        # Somebody moves, where a first picture held would not.
        self.assertGreater(len(set(decoded.pictures)), 60)

    def test_a_shut_mouth_stays_shut(self):
        talker(self.folder / "mute.y4m", "--size", "176x144", "--frames", "40", "--motion", "turns", "--seed", "3")
        self.succeed("encode", "mute.y4m", "mute.fbs", "--quiet")
        shown = self.retarget("mute.fbs", self.close_up())
        for upper, lower in INNER_LIPS:
            self.assertLess(statistics.median(shown.distance(upper, lower)), TOUCHING, upper)

    def test_patterns_of_the_face_are_all_used(self):
        def patterns(stream):
            return [kind for kind, _, _ in packets(pathlib.Path(stream).read_bytes())].count(4)
        self.retarget(TALK_ONE_FBS, TALK_FBS)
        self.assertGreater(patterns(self.folder / "out.fbs"), 1)
        self.retarget(TALK_FBS, TALK_ONE_FBS)
        self.assertEqual(patterns(self.folder / "out.fbs"), 1)

    def test_scenes(self):
        self.assertEqual(len(self.retarget(KEYED_FBS, TALK_FBS).rows), 120)
        self.assertEqual(len(self.retarget(TWO_SCENES_FBS, TALK_FBS).rows), len(self.head(TWO_SCENES_FBS).rows))
        self.assertEqual(len(self.retarget(TALK_FBS, TWO_SCENES_FBS).rows), 120)

    def test_photograph(self):
        self.succeed("decode", TALK_FBS, "photo_%d.png", "--quiet")
        shown = self.retarget(KEYED_FBS, "photo_1.png", "--quality", "40")
        self.assertEqual(len(shown.rows), 120)
        self.assertGreater(correlation(self.head(KEYED_FBS).column("ry_deg"), shown.column("ry_deg")), 0.95)
        small = os.path.getsize(self.folder / "out.fbs")
        self.retarget(KEYED_FBS, "photo_1.png")
        self.assertGreater(os.path.getsize(self.folder / "out.fbs"), small)

    def finer(self):
        return subprocess.run([sys.executable, SOURCE / "samples/finer_head.py", self.folder / "fine.gltf"], check=True,
                              capture_output=True, text=True).stdout

    def test_another_wire_frame(self):
        self.assertIn("392 vertices", self.finer())
        plain = self.retarget(TALK_FBS, TALK_FBS)
        before = self.decoded("out.fbs")
        fine = self.retarget(TALK_FBS, TALK_FBS, "--wire-frame", "fine.gltf")
        after = self.decoded("out.fbs")
        self.assertIn("wire-frame", self.succeed("inspect", "out.fbs", "--packets").decode())
        # The same face, but rounder between the vertices of the generic head.
        self.assertGreater(after.luma_psnr(before), 35)
        self.assertNotEqual(after.pictures, before.pictures)
        for k in range(68):
            worst = max(math.dist((a[f"x{k}"], a[f"y{k}"]), (b[f"x{k}"], b[f"y{k}"])) / a["scale"]
                        for a, b in zip(plain.rows, fine.rows, strict=True))
            self.assertLess(worst, 0.05, k)
        self.succeed("export", "out.fbs", "face_%d.obj")
        model = next(self.folder.glob("face_*.obj")).read_text()
        self.assertEqual(sum(line.startswith("v ") for line in model.splitlines()), 392)

    def test_a_face_keeps_its_own_wire_frame(self):
        self.finer()
        self.succeed("retarget", "--motion", TALK_FBS, "--face", TALK_FBS, "--wire-frame", "fine.gltf", "fine.fbs")
        own = self.head("fine.fbs")
        again = self.retarget("fine.fbs", "fine.fbs")
        self.assertGreater(correlation(own.distance(62, 66), again.distance(62, 66)), 0.97)
        self.assertIn("wire-frame", self.succeed("inspect", "out.fbs", "--packets").decode())

    def test_bad_wire_frames(self):
        self.write("text.gltf", b"not glTF")
        self.write("empty.glb", b"")
        for name, says in (("missing.gltf", ("missing.gltf",)), ("text.gltf", ("text.gltf", "not glTF")),
                           ("empty.glb", ("empty.glb",)),
                           (SOURCE / "common/generic_head.gltf", ("generic_head.gltf", "extras.features"))):
            with self.subTest(name=name):
                self.fail_cleanly("retarget", "--motion", TALK_FBS, "--face", TALK_FBS, "--wire-frame", name, "out.fbs",
                                  says=says)
                self.assertFalse((self.folder / "out.fbs").exists())

    def test_motion_from_standard_input(self):
        self.succeed("retarget", "--motion", "-", "--face", TALK_FBS, "out.fbs", stdin=TALK_ONE_FBS.read_bytes())
        self.assertEqual(self.decoded("out.fbs").shape[2], 120)

    def test_bad_input(self):
        def refused(*arguments, says):
            self.fail_cleanly("retarget", *arguments, says=says)
        self.write("grey.y4m", flat_y4m(176, 144, 3))
        self.succeed("encode", "grey.y4m", "grey.fbs", "--allow-no-face", "--quiet")
        self.write("cut.fbs", TALK_FBS.read_bytes()[:-40])
        kept = {"grey.y4m", "grey.fbs", "cut.fbs"}
        for arguments, says in (
                (("--motion", "grey.fbs", "--face", TALK_FBS, "out.fbs"), ("grey.fbs", "no face")),
                (("--motion", TALK_FBS, "--face", "grey.fbs", "out.fbs"), ("grey.fbs", "no face")),
                (("--motion", TALK_FBS, "--face", "grey.y4m", "out.fbs"), ("grey.y4m", "no face")),
                (("--motion", "cut.fbs", "--face", TALK_FBS, "out.fbs"), ("cut.fbs",)),
                (("--motion", TALK_FBS, "--face", "cut.fbs", "out.fbs"), ("cut.fbs",)),
                (("--motion", TALK_FBS, "--face", "missing.fbs", "out.fbs"), ("missing.fbs",)),
                (("--motion", "missing.fbs", "--face", TALK_FBS, "out.fbs"), ("missing.fbs",)),
                (("--motion", TALK_Y4M, "--face", TALK_FBS, "out.fbs"), (TALK_Y4M.name,)),
                (("--motion", TALK_FBS, "--face", TALK_FBS, "out.y4m"), ("out.y4m",)),
                (("--motion", "grey.fbs", "--face", TALK_FBS, "grey.fbs"), ("grey.fbs",)),
                (("--motion", TALK_FBS, "--face", TALK_FBS, "out.fbs", "--quality", "30"), ("--quality", "stream"))):
            with self.subTest(arguments=arguments):
                refused(*arguments, says=says)
                self.assertEqual({str(name) for name in self.files()}, kept)
