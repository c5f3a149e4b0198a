"""The programs of samples/ do what they show."""
import csv
import io
import json
import subprocess

from harness import BUILD, MAX_SECONDS, TALK_FBS, ProgramTest, Y4m, ffmpeg, read_y4m, talker

PICTURES = 120  # of TALK_FBS
PIXELS = 176 * 144


class Samples(ProgramTest):
    def sample(self, name, *arguments, stdin=b""):
        return subprocess.run([BUILD / name, *arguments], cwd=self.folder, check=True, capture_output=True, input=stdin,
                              timeout=MAX_SECONDS).stdout.decode()

    def rgb(self, images):
        """Bytes of all pictures of a sequence of PNG files."""
        ffmpeg("-i", self.folder / images, "-f", "rawvideo", "-pix_fmt", "rgb24", self.folder / "out.rgb")
        return (self.folder / "out.rgb").read_bytes()

    def test_decode_to_png_writes_what_fbs_writes(self):
        self.sample("decode_to_png", TALK_FBS, ".")
        self.succeed("decode", TALK_FBS, "fbs_%d.png")
        ours, theirs = self.rgb("%d.png"), self.rgb("fbs_%d.png")
        self.assertEqual(len(ours), 3 * PIXELS * PICTURES)
        self.assertLessEqual(max(abs(a - b) for a, b in zip(ours, theirs, strict=True)), 1)

    def test_print_landmarks_prints_what_fbs_exports(self):
        printed = self.sample("print_landmarks", TALK_FBS).split("picture ")[1:]
        self.succeed("export", TALK_FBS, "out.csv")
        rows = list(csv.DictReader(io.StringIO((self.folder / "out.csv").read_text())))
        self.assertEqual((len(printed), len(rows)), (PICTURES, PICTURES))
        for text, row in zip(printed, rows):
            head, *points = text.splitlines()
            words = head.split()
            for angle, column in (("pitch", "rx_deg"), ("yaw", "ry_deg"), ("roll", "rz_deg")):
                self.assertAlmostEqual(float(words[words.index(angle) + 1]), float(row[column]), delta=0.051)
            self.assertEqual(len(points), 68)
            for k, point in enumerate(points):
                for value, column in zip(point.split(), (f"x{k}", f"y{k}")):
                    self.assertAlmostEqual(float(value), float(row[column]), delta=0.0051)

    def test_feed_in_pieces_shows_the_same_whatever_their_size(self):
        printed = {self.sample("feed_in_pieces", TALK_FBS, str(size)) for size in (1, 7, 4096, 1 << 20)}
        self.assertEqual(len(printed), 1, printed)
        self.assertTrue(printed.pop().startswith(f"{PICTURES} pictures, 0 of them held"))

    def test_round_trip_shows_the_video_again(self):
        talker(self.folder / "in.y4m", "--size", "176x144", "--frames", "40")
        source = read_y4m(self.folder / "in.y4m")
        done = subprocess.run([BUILD / "round_trip", "176", "144", "30"], check=True, capture_output=True,
                              input=b"".join(source.pictures), timeout=MAX_SECONDS)
        self.assertLess(int(done.stderr.split()[0]), 4000)
        size = len(source.pictures[0])
        shown = Y4m(source.header + b"".join(b"FRAME\n" + done.stdout[at:at + size]
                                             for at in range(0, len(done.stdout), size)))
        self.assertEqual(len(shown.pictures), 40)
        self.assertGreater(shown.luma_psnr(source), 28)

    def test_encode_frames_encodes_all_of_them(self):
        talker(self.folder / "frames.y4m", "--size", "176x144", "--frames", "75")
        raw = b"".join(read_y4m(self.folder / "frames.y4m").pictures)
        self.sample("encode_frames", "176", "144", "25", "frames.fbs", stdin=raw)
        reported = json.loads(self.succeed("evaluate", "frames.y4m", "frames.fbs", "--json"))["points"][0]
        self.assertEqual(reported["frames"], 75)
        self.assertGreater(reported["psnr_face"], 28)

    def lossy_call(self, source, *arguments):
        """What the call prints: the rows of its seconds by column, and the one of all."""
        columns, *rows = (line.split() for line in self.sample("lossy_call", "176", "144", "15", *arguments, stdin=source).splitlines())
        *seconds, total = (dict(zip(columns[1:], map(float, row[1:]))) for row in rows)
        return seconds, total

    def test_lossy_call_repairs_what_is_lost(self):
        source = b""
        for seed, frames in ((1, 150), (3, 30)):  # another person comes when the link has become narrow
            talker(self.folder / "talk.y4m", "--size", "176x144", "--fps", "15", "--frames", str(frames), "--seed", str(seed))
            source += b"".join(read_y4m(self.folder / "talk.y4m").pictures)
        seconds, whole = self.lossy_call(source, "0")
        for second in seconds[:7]:  # the link is wide
            self.assertEqual((second["lost"], second["late"], second["flawed"]), (0, 0, 0))
        self.assertEqual(whole["scenes"], 0)
        self.assertGreater(whole["shown"], 170)
        self.assertLess(whole["lost"], 15, "what the queue cannot hold when the link becomes narrow")
        self.assertLess(whole["flawed"], 70)

        seconds, total = self.lossy_call(source, "10")
        self.assertGreater(total["lost"], 5)
        self.assertGreater(total["resent"], 5)
        self.assertEqual((total["shown"], total["scenes"]), (180, 0))
        self.assertLess(total["flawed"], 60)
        self.assertLess(total["late"], 5)
        self.assertLess(seconds[-1]["coded"], 6, "the rate follows the link")
        self.assertEqual((seconds, total), self.lossy_call(source, "10", "1", "2"), "other threads change nothing")

        _, bad = self.lossy_call(source, "60")
        self.assertGreater(bad["scenes"], 0)
        self.assertGreater(bad["shown"], 20)
