"""The analysis of a video as a table, without a stream."""
import csv
import io
import json
import math
import unittest

from harness import TALK_FBS, TALK_TRUTH, TALK_Y4M, ProgramTest, flat_y4m


def rows_of(text):
    return list(csv.DictReader(io.StringIO(text)))


class Track(ProgramTest):
    def test_table_is_that_of_export(self):
        tracked = rows_of(self.succeed("track", TALK_Y4M, "-", "--quiet").decode())
        exported = rows_of(self.succeed("export", TALK_FBS, "-").decode())
        self.assertEqual(list(tracked[0]), list(exported[0]))
        self.assertEqual(len(tracked), len(exported))
        self.assertEqual([r["timestamp"] for r in tracked], [r["timestamp"] for r in exported])
        off = [abs(float(t[name]) - float(e[name])) for t, e in zip(tracked, exported) for name in ("x30", "y30", "x8", "y8")]
        self.assertLess(sum(off) / len(off), 1)

    def test_finds_the_landmarks(self):
        truth = rows_of(TALK_TRUTH.read_text())
        tracked = rows_of(self.succeed("track", TALK_Y4M, "-", "--quiet").decode())
        off = [math.hypot(float(r[f"x{k}"]) - float(t[f"x{k}"]), float(r[f"y{k}"]) - float(t[f"y{k}"]))
               for r, t in zip(tracked, truth) for k in range(17, 68)]
        self.assertLess(sum(off) / len(off), 0.08 * float(tracked[0]["scale"]))
        self.assertTrue(all(r["success"] == "1" and float(r["confidence"]) > 0.3 for r in tracked))

    def test_part_of_a_video(self):
        self.assertEqual(len(rows_of(self.succeed("track", TALK_Y4M, "-", "--frames", 7).decode())), 7)
        self.assertEqual(len(rows_of(self.succeed("track", TALK_Y4M, "-", "--duration", 0.5).decode())), 15)

    def test_json(self):
        self.succeed("track", TALK_Y4M, "out.json", "--frames", 3, "--quiet")
        read = json.loads((self.folder / "out.json").read_text())
        self.assertEqual([f["frame"] for f in read["frames"]], [0, 1, 2])
        self.assertEqual(self.succeed("track", TALK_Y4M, "-", "--format", "json", "--frames", 3),
                         (self.folder / "out.json").read_bytes())

    def test_pictures_before_a_face_have_none(self):
        head, _, talk = TALK_Y4M.read_bytes().partition(b"\n")
        grey = flat_y4m(176, 144, 7).partition(b"\n")[2]
        rows = rows_of(self.succeed("track", "-", "-", "--frames", 20, stdin=head + b"\n" + grey + talk).decode())
        self.assertEqual((rows[0]["x30"], rows[0]["success"]), ("nan", "0"))
        self.assertEqual(rows[19]["success"], "1")

    def test_bad_input(self):
        self.write("grey.y4m", flat_y4m(128, 96, 5))
        self.fail_cleanly("track", "absent.mkv", "out.csv", says=["absent.mkv", "No such file"])
        self.fail_cleanly("track", "grey.y4m", "out.csv", says=["grey.y4m", "no face"])
        self.fail_cleanly("track", TALK_Y4M, "out.docx", says=["out.docx", ".csv"])
        self.fail_cleanly("track", TALK_Y4M, "out.glb", says=["out.glb", ".csv"])
        self.fail_cleanly("track", TALK_Y4M, "out.csv", "--format", "json", says=["--format json"])
        self.fail_cleanly("track", TALK_Y4M, "out.csv", "--face", 5, "--frames", 3, says=["face 5"])
        self.write("talk.csv", TALK_Y4M.read_bytes())
        self.fail_cleanly("track", "talk.csv", "talk.csv", says=["the same file"])


if __name__ == "__main__":
    unittest.main()
