"""Several patterns: made, listed, decoded piece by piece, and worth their bytes."""
import json
import subprocess
import sys

from harness import (BLEND, FBS, MAX_SECONDS, PATTERN, TALK_FBS, TALK_ONE_FBS, TALK_Y4M, ProgramTest, flat_y4m,
                     packets, read_y4m, talker)

PICTURE_BYTES = 176 * 144 * 3 // 2
MAX_PATTERNS = 64      # that a decoder keeps

# Runs a program from a small process: the peak of a new process is never below that of the one that starts it.
_RUN_AND_TELL_PEAK = """
import os, sys
_, status, usage = os.wait4(os.spawnv(os.P_NOWAIT, sys.argv[1], sys.argv[1:]), 0)
print(usage.ru_maxrss)
sys.exit(os.waitstatus_to_exitcode(status))
"""


class Patterns(ProgramTest):
    def inspected(self, stream="out.fbs"):
        return json.loads(self.succeed("inspect", stream, "--json"))

    def encode(self, source, *options):
        """Encodes `source` into out.fbs; returns the output of inspect."""
        self.succeed("encode", source, "out.fbs", "--quiet", *options)
        return self.inspected()

    def kinds(self, stream="out.fbs"):
        return [kind for kind, _, _ in packets((self.folder / stream).read_bytes())]

    def test_as_many_as_asked_for(self):
        reported = self.encode(TALK_Y4M, "--patterns", "4")
        self.assertEqual(reported["pattern_count"], 4)
        self.assertEqual(self.kinds().count(PATTERN), 4)
        self.assertGreater(self.kinds().count(BLEND), 1)

    def test_one_is_not_blended(self):
        self.assertEqual(self.inspected(TALK_ONE_FBS)["pattern_count"], 1)
        self.assertEqual(self.kinds(TALK_ONE_FBS).count(PATTERN), 1)
        self.assertNotIn(BLEND, self.kinds(TALK_ONE_FBS))

    def test_several_by_default(self):
        self.assertGreater(self.inspected(TALK_FBS)["pattern_count"], 2)

    def check_list(self, reported):
        listed = reported["patterns"]
        self.assertEqual(len(listed), reported["pattern_count"])
        self.assertEqual(sum(pattern["bytes"] for pattern in listed), reported["bytes"]["patterns"])
        pictures = [pattern["picture"] for pattern in listed]
        self.assertEqual((pictures[0], len(set(pictures))), (0, len(pictures)))
        self.assertLess(max(pictures), reported["frames"])
        for pattern in listed:
            self.assertAlmostEqual(pattern["seconds"], pattern["picture"] / reported["fps"], places=6)
        self.assertEqual(len(listed[0]["share"]), 7)
        for region in listed[0]["share"]:
            self.assertAlmostEqual(sum(pattern["share"][region] for pattern in listed), 1, places=6, msg=region)

    def test_listed_with_time_bytes_and_shares(self):
        self.check_list(self.inspected(TALK_ONE_FBS))
        reported = self.inspected(TALK_FBS)
        self.check_list(reported)
        text = self.succeed("inspect", TALK_FBS).decode()
        for pattern in reported["patterns"]:
            self.assertRegex(text, rf"(?m)^ +picture {pattern['picture']} +{pattern['bytes']} bytes +{pattern['seconds']:.2f} s$")
            self.assertTrue(all(0 <= share < 1 for share in pattern["share"].values()), pattern)
            self.assertGreater(max(pattern["share"].values()), 0.02, "sent for nothing")

    def test_reduced_size_is_listed(self):
        reported = self.encode(TALK_Y4M, "--patterns", "3", "--reduced-patterns")
        self.assertEqual([pattern["reduced"] for pattern in reported["patterns"]], 3 * [True])
        self.assertEqual(self.succeed("inspect", "out.fbs").count(b", reduced size\n"), 3)
        self.assertFalse(any(pattern["reduced"] for pattern in self.inspected(TALK_FBS)["patterns"]))

    def test_stream_in_small_pieces(self):
        decoder = subprocess.Popen([FBS, "decode", "-", "-", "--quiet"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        stream = TALK_FBS.read_bytes()
        for at in range(0, len(stream), 7):
            decoder.stdin.write(stream[at:at + 7])
            decoder.stdin.flush()
        out, _ = decoder.communicate(timeout=MAX_SECONDS)
        self.assertEqual(decoder.returncode, 0)
        self.assertEqual(out, self.succeed("decode", TALK_FBS, "-"))

    def test_more_give_better_pictures(self):
        talker(self.folder / "turning.y4m", "--size", "176x144", "--frames", "100", "--fps", "10", "--motion", "long",
               "--eye-distance", "0.2", "--yaw", "20", "--pitch", "12", "--light", "0.1")
        points = {}
        for count in ("1", "3", None):
            self.encode("turning.y4m", *(("--patterns", count) if count else ()))
            points[count] = json.loads(self.succeed("evaluate", "turning.y4m", "out.fbs", "--json"))["points"][0]
        self.assertGreater(points[None]["psnr_frame"], points["1"]["psnr_frame"] + 1)
        for key in ("psnr_face", "psnr_frame"):
            self.assertGreater(points[None][key], points["3"][key] + 0.5, key)
            self.assertGreater(points[None][key], points["1"][key], key)

    def peak_bytes(self, *arguments):
        """Memory that fbs takes, which must succeed."""
        out = subprocess.run([sys.executable, "-c", _RUN_AND_TELL_PEAK, FBS, *map(str, arguments)], cwd=self.folder,
                             check=True, capture_output=True, timeout=MAX_SECONDS).stdout
        return 1024 * int(out)

    def loop(self, name, loops, rate):
        """Writes the talker, again and again and slower, without holding it all in memory."""
        head, _, pictures = TALK_Y4M.read_bytes().partition(b"\n")
        with open(self.folder / name, "wb") as file:
            file.write(head.replace(b"F30:1", b"F%d:1" % rate) + b"\n")
            for _ in range(loops):
                file.write(pictures)

    def test_long_video_in_bounded_memory(self):
        """Two and a half segments. Few patterns, so that what grows is pictures."""
        loops = 9
        self.loop("short.y4m", 1, rate=10)
        self.loop("long.y4m", loops, rate=10)
        options = "--quiet", "--effort", "0", "--patterns", "4"
        short = self.peak_bytes("encode", "short.y4m", "short.fbs", *options)
        long = self.peak_bytes("encode", "long.y4m", "out.fbs", *options)
        self.assertLess(long - short, loops * 120 * PICTURE_BYTES / 2, "pictures pile up")
        short = self.peak_bytes("decode", "short.fbs", "null:", "--quiet")
        self.assertLess(self.peak_bytes("decode", "out.fbs", "null:", "--quiet") - short, 10e6)

    def test_patterns_take_the_slots_of_others(self):
        """In segments after the first."""
        self.loop("long.y4m", 3, rate=5)
        reported = self.encode("long.y4m", "--effort", "0")
        self.assertEqual(reported["frames"], 360)
        self.assertGreater(reported["pattern_count"], MAX_PATTERNS)
        self.check_list(reported)

    def test_solving_for_patterns_in_bounded_memory(self):
        """Ten seconds of larger pictures are more than the solver's memory holds."""
        talker(self.folder / "large.y4m", "--size", "352x288", "--frames", "300")
        self.assertLess(self.peak_bytes("encode", "large.y4m", "out.fbs", "--quiet"), 550e6)

    def test_face_that_comes_late(self):
        flat = flat_y4m(176, 144, 15).replace(b"F25:1", b"F30:1")
        self.write("late.y4m", flat + TALK_Y4M.read_bytes().partition(b"\n")[2])
        reported = self.encode("late.y4m", "--patterns", "4")
        self.assertEqual(reported["frames"], 135)
        pictures = [pattern["picture"] for pattern in reported["patterns"]]
        self.assertEqual((pictures[0], len(pictures)), (0, 7), "three of what is still, and those of the talker")
        self.assertIn(15, pictures)
        self.assertLess(max(pictures), 135)
        out = self.decoded("out.fbs")
        self.assertEqual(len(out.pictures), 135)
        self.assertGreater(out.luma_psnr(read_y4m(self.folder / "late.y4m")), 25)

    def test_no_face(self):
        self.write("ramp.y4m", flat_y4m(128, 96, 7, lambda x, y: x + y))
        reported = self.encode("ramp.y4m", "--allow-no-face", "--patterns", "4")
        self.assertEqual((reported["pattern_count"], reported["frames"], reported["face"]), (3, 7, False))

    def test_fewer_pictures_than_patterns(self):
        for count in (1, 2, 3):
            talker(self.folder / "few.y4m", "--size", "176x144", "--frames", str(count))
            reported = self.encode("few.y4m", "--patterns", "8")
            self.assertEqual(reported["pattern_count"], count)
            out = self.decoded("out.fbs")
            self.assertEqual(out.shape, (176, 144, count, 30.0))
            self.assertGreater(out.luma_psnr(read_y4m(self.folder / "few.y4m")), 28)

    def test_odd_size(self):
        talker(self.folder / "odd.y4m", "--size", "175x143", "--frames", "30")
        for options in ((), ("--reduced-patterns",)):
            reported = self.encode("odd.y4m", "--patterns", "3", *options)
            self.assertEqual(reported["pattern_count"], 3)
            out = self.decoded("out.fbs")
            self.assertEqual(out.shape, (175, 143, 30, 30.0))
            self.assertGreater(out.luma_psnr(read_y4m(self.folder / "odd.y4m")), 26 if options else 28)
