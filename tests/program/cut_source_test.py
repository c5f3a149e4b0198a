"""Sources that are cut off or damaged: what there is is encoded, said so, and exit code 2."""
import json

from harness import FAILED, TALK_Y4M, ProgramTest, ffmpeg, flat_y4m


class CutSource(ProgramTest):
    def convert(self, name, *options):
        ffmpeg("-i", TALK_Y4M, "-strict", "-1", *options, self.folder / name)
        return (self.folder / name).read_bytes()

    def encode_part(self, name, data):
        """Encodes a source that is not whole; returns how many pictures the stream has."""
        self.write(name, data)
        done = self.fbs("encode", name, "out.fbs", "--quiet", "--effort", "0", "--patterns", "1")
        said = done.stderr.decode()
        self.assertEqual(done.returncode, FAILED, said)
        self.assertRegex(said, r"\Afbs: " + name + r": [^\n]+\n\Z")
        pictures = len(self.decoded("out.fbs").pictures)
        self.last_line = said
        return pictures

    def test_containers(self):
        for name, options in (("cut.mkv", ("-c:v", "libx264")), ("cut.webm", ("-c:v", "libvpx-vp9", "-deadline", "realtime")),
                              ("cut.mp4", ("-c:v", "libx264", "-movflags", "+faststart")), ("cut.flv", ("-c:v", "libx264")),
                              ("cut.avi", ("-c:v", "mjpeg", "-pix_fmt", "yuvj420p"))):
            with self.subTest(name):
                whole = self.convert(name, *options)
                pictures = self.encode_part(name, whole[:len(whole) * 6 // 10])
                self.assertIn(f"cut off or damaged; the {pictures} pictures before are encoded", self.last_line)
                self.assertIn(pictures, range(30, 100))

    def test_whole_containers_are_not_complained_about(self):
        for name, options in (("whole.mkv", ("-c:v", "libx264")), ("whole.mp4", ("-c:v", "libx264"))):
            self.convert(name, *options)
            done = self.fbs("encode", name, "out.fbs", "--quiet", "--effort", "0", "--patterns", "1")
            self.assertEqual((done.returncode, done.stderr), (0, b""))

    def test_mp4_without_its_index(self):
        whole = self.convert("cut.mp4", "-c:v", "libx264")
        self.write("cut.mp4", whole[:len(whole) * 6 // 10])
        self.fail_cleanly("encode", "cut.mp4", "out.fbs", says=["cut.mp4", "cut off before its index"])

    def test_y4m(self):
        self.assertEqual(self.encode_part("cut.y4m", TALK_Y4M.read_bytes()[:2_000_000]), 52)
        self.assertIn("ends inside picture 52; the 52 pictures before are encoded", self.last_line)

    def test_y4m_with_damage(self):
        data = TALK_Y4M.read_bytes()
        at = data.index(b"\n") + 1 + 40 * (6 + 176 * 144 * 3 // 2)
        self.assertEqual(self.encode_part("bad.y4m", data[:at] + b"NOISE\n" + data[at + 6:]), 40)
        self.assertIn("no FRAME before picture 40", self.last_line)

    def test_y4m_through_standard_input(self):
        done = self.fbs("encode", "-", "out.fbs", stdin=TALK_Y4M.read_bytes()[:500_000])
        self.assertEqual(done.returncode, FAILED)
        self.assertIn(b"fbs: standard input: ends inside picture 13; the 13 pictures before are encoded\n", done.stderr)
        self.assertEqual(len(self.decoded("out.fbs").pictures), 13)

    def test_cut_off_before_the_end_of_the_first_picture(self):
        self.write("cut.y4m", flat_y4m(128, 96, 1)[:-1])
        self.fail_cleanly("encode", "cut.y4m", "out.fbs", says=["cut.y4m", "ends inside picture 0"])

    def test_images(self):
        ffmpeg("-i", TALK_Y4M, "-frames:v", "6", self.folder / "%d.png")
        self.write("5.png", (self.folder / "5.png").read_bytes()[:3000])
        done = self.fbs("encode", "%d.png", "out.fbs")
        self.assertEqual(done.returncode, FAILED)
        self.assertIn(b"5.png", done.stderr)
        self.assertEqual(len(self.decoded("out.fbs").pictures), 4)

    def test_limit_before_the_cut_is_a_success(self):
        self.write("cut.y4m", TALK_Y4M.read_bytes()[:500_000])
        self.succeed("encode", "cut.y4m", "out.fbs", "--frames", 10)

    def test_evaluate_measures_what_can_be_read(self):
        self.write("cut.y4m", TALK_Y4M.read_bytes()[:500_000])
        self.fbs("encode", "cut.y4m", "out.fbs")
        for stream in ([], ["out.fbs"]):
            done = self.fbs("evaluate", "cut.y4m", *stream, "--json", "--quiet")
            self.assertEqual(done.returncode, FAILED)
            self.assertIn(b"ends inside picture 13; the 13 pictures before are measured", done.stderr)
            self.assertEqual(json.loads(done.stdout)["points"][0]["frames"], 13)
