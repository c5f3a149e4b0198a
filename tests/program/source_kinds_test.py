"""Sources other than plain 8-bit 4:2:0 at a constant rate: coded, with their timestamps."""
from harness import TALK_Y4M, ProgramTest, Y4m, ffmpeg, ffprobe, flat_y4m, read_y4m


class SourceKinds(ProgramTest):
    def setUp(self):
        super().setUp()
        self.short = self.folder / "short.y4m"
        ffmpeg("-i", TALK_Y4M, "-frames:v", "20", self.short)

    def comes_back(self, source, at_least=28):
        """Encodes and decodes `source`; the pictures must be close to those of short.y4m."""
        self.succeed("encode", source, "out.fbs")
        out, plain = self.decoded("out.fbs"), read_y4m(self.short)
        self.assertEqual(out.shape, plain.shape)
        self.assertGreater(out.luma_psnr(plain), at_least)
        return out

    def convert(self, name, *options):
        ffmpeg("-i", self.short, *options, "-strict", "-1", self.folder / name)
        return name

    def test_y4m_422(self):
        self.comes_back(self.convert("in.y4m", "-pix_fmt", "yuv422p"))

    def test_y4m_444(self):
        self.comes_back(self.convert("in.y4m", "-pix_fmt", "yuv444p"))

    def test_y4m_10_bit(self):
        self.comes_back(self.convert("in.y4m", "-pix_fmt", "yuv420p10le"))

    def test_y4m_422_12_bit(self):
        self.comes_back(self.convert("in.y4m", "-pix_fmt", "yuv422p12le"))

    def test_y4m_grey(self):
        out = self.comes_back(self.convert("in.y4m", "-pix_fmt", "gray"))
        chroma = out.pictures[0][176 * 144:]
        self.assertLess(max(abs(c - 128) for c in chroma), 12)

    def test_mkv_422(self):
        self.comes_back(self.convert("in.mkv", "-c:v", "ffv1", "-pix_fmt", "yuv422p"))

    def test_mkv_10_bit(self):
        self.comes_back(self.convert("in.mkv", "-c:v", "ffv1", "-pix_fmt", "yuv420p10le"))

    def test_mkv_grey(self):
        self.comes_back(self.convert("in.mkv", "-c:v", "ffv1", "-pix_fmt", "gray"))

    def test_mkv_rgb(self):
        self.comes_back(self.convert("in.mkv", "-c:v", "ffv1", "-pix_fmt", "bgr0"))

    def test_mp4_h264(self):
        self.comes_back(self.convert("in.mp4", "-c:v", "libx264", "-crf", "12", "-pix_fmt", "yuv420p"))

    def test_avi_mjpeg(self):
        self.comes_back(self.convert("in.avi", "-c:v", "mjpeg", "-q:v", "2", "-pix_fmt", "yuvj420p"), 26)

    def test_webm_vp9(self):
        self.comes_back(self.convert("in.webm", "-c:v", "libvpx-vp9", "-crf", "15", "-b:v", "0", "-deadline", "realtime"))

    def test_rotated_mp4(self):
        for degrees, turn in (("90", "clock"), ("270", "cclock"), ("180", "clock,transpose=clock")):
            with self.subTest(degrees):
                ffmpeg("-i", self.short, "-vf", "transpose=" + turn, "-c:v", "libx264", "-crf", "12", self.folder / "lying.mp4")
                ffmpeg("-i", self.folder / "lying.mp4", "-c", "copy", "-metadata:s:v", "rotate=" + degrees,
                       self.folder / "in.mp4")
                ffmpeg("-i", self.folder / "in.mp4", self.folder / "upright.y4m")  # rotates as the file requires
                upright = read_y4m(self.folder / "upright.y4m")
                self.assertGreater(upright.luma_psnr(read_y4m(self.short)), 28, "the test's own video is wrong")
                self.comes_back("in.mp4")

    def test_face_that_lies_is_said_and_turned(self):
        for degrees, turn, how in ((90, "cclock", "lies on its side"), (270, "clock", "lies on its side"),
                                   (180, "clock,transpose=clock", "is upside down")):
            with self.subTest(degrees):
                self.convert("in.mkv", "-c:v", "ffv1", "-vf", "transpose=" + turn)
                said = f"fbs: a face {how}; --rotate {degrees} puts it upright\n".encode()
                self.assertIn(said, self.fbs("encode", "in.mkv", "no.fbs", "--allow-no-face").stderr)
                self.fail_cleanly("encode", "in.mkv", "no.fbs", "--quiet", says=[f"turned clockwise by {degrees} degrees"])
                turned = self.fbs("encode", "in.mkv", "out.fbs", "--rotate", degrees)
                self.assertNotIn(b"upright", turned.stderr)
                self.succeed("encode", self.short, "plain.fbs")
                self.assertEqual((self.folder / "out.fbs").read_bytes(), (self.folder / "plain.fbs").read_bytes())
        self.assertIn(said, self.fbs("track", "in.mkv", "no.csv").stderr)
        self.succeed("evaluate", "in.mkv", "out.fbs", "--rotate", degrees)

    def test_video_without_a_face_does_not_lie(self):
        self.write("grey.y4m", flat_y4m(176, 144, 70, lambda x, y: x * y // 16))
        self.assertNotIn(b"upright", self.fbs("encode", "grey.y4m", "out.fbs", "--allow-no-face").stderr)

    def test_variable_rate_keeps_its_timestamps(self):
        ffmpeg("-i", TALK_Y4M, "-vf", "select='not(eq(mod(n,7),2)+between(n,40,55))'", "-fps_mode", "vfr",
               "-c:v", "ffv1", self.folder / "in.mkv")
        self.succeed("encode", "in.mkv", "out.fbs")
        self.succeed("decode", "out.fbs", "out.mkv")
        source, decoded = self.times("in.mkv"), self.times("out.mkv")
        self.assertEqual(len(decoded), len(source))
        self.assertGreater(len({round(b - a, 3) for a, b in zip(source, source[1:])}), 3, "the test's own video is regular")
        for a, b in zip(source, decoded):
            self.assertAlmostEqual(a - source[0], b - decoded[0], delta=0.0015)

    def test_picture_that_stays_for_minutes_is_shown_again(self):
        ffmpeg("-i", TALK_Y4M, "-frames:v", "4", "-vf", "setpts='if(lt(N,2),N*0.1,N*70+0.5)/TB'", "-fps_mode", "vfr",
               "-c:v", "ffv1", self.folder / "in.mkv")
        self.succeed("encode", "in.mkv", "out.fbs", "--overlay", "see.mkv")
        self.succeed("decode", "out.fbs", "out.mkv")
        for name in ("out.mkv", "see.mkv"):
            for time, expected in zip(self.times(name), (0, 0.1, 60.1, 120.1, 140.5, 200.5, 210.5), strict=True):
                self.assertAlmostEqual(time, expected, delta=0.0015)

    def test_overlay_of_variable_rate_keeps_the_speed(self):
        ffmpeg("-i", TALK_Y4M, "-vf", "select='not(between(n,40,45))'", "-fps_mode", "vfr", "-c:v", "ffv1",
               self.folder / "held.mkv")
        self.succeed("encode", "held.mkv", "out.fbs", "--patterns", 1, "--overlay", "see.y4m")
        self.assertEqual(len(read_y4m(self.folder / "see.y4m").pictures), 120)

    def test_variable_rate_becomes_constant_in_y4m(self):
        ffmpeg("-i", TALK_Y4M, "-vf", "select='not(between(n,40,45))'", "-fps_mode", "vfr", "-c:v", "ffv1",
               self.folder / "in.mkv")  # less than a tenth is missing, so that the rate stays 30
        self.succeed("encode", "in.mkv", "out.fbs")
        held = self.fbs("decode", "out.fbs", "held.y4m")
        self.assertEqual((held.returncode, held.stderr),
                         (0, b"fbs: held.y4m: variable frame rate made constant; pictures repeated: 6, dropped: 0\n"))
        once = self.fbs("decode", "out.fbs", "-", "--vfr")
        self.assertIn(b"fbs: standard output: variable frame rate, each picture written once; the speed is lost", once.stderr)
        held, once = read_y4m(self.folder / "held.y4m"), Y4m(once.stdout)
        self.assertEqual(once.shape, (176, 144, 114, 30.0))
        self.assertEqual(held.pictures, once.pictures[:39] + 7 * once.pictures[39:40] + once.pictures[40:])
        self.succeed("decode", "out.fbs", "out_%03d.png")
        self.assertEqual(len(list(self.folder.glob("*.png"))), 114)

    def test_variable_rate_keeps_its_length_in_y4m(self):
        ffmpeg("-i", TALK_Y4M, "-vf", "select='not(eq(mod(n,7),2)+between(n,40,55))'", "-fps_mode", "vfr",
               "-c:v", "ffv1", self.folder / "in.mkv")
        self.succeed("encode", "in.mkv", "out.fbs")
        times, out = self.times("in.mkv"), self.decoded("out.fbs")
        self.assertAlmostEqual(len(out.pictures) / out.rate, times[-1] - times[0], delta=2 / out.rate)

    def times(self, name):
        packets = ffprobe(self.folder / name, "packet=pts_time")["packets"]
        return sorted(float(packet["pts_time"]) for packet in packets)

    def test_pixel_aspect_is_kept(self):
        self.convert("in.mkv", "-c:v", "ffv1", "-vf", "setsar=128/117:max=1000")
        self.succeed("encode", "in.mkv", "out.fbs")
        self.assertIn(b" A128:117 ", self.succeed("decode", "out.fbs", "-").partition(b"\n")[0])
        self.succeed("decode", "out.fbs", "out.mkv")
        stream = ffprobe(self.folder / "out.mkv", "stream=sample_aspect_ratio")["streams"][0]
        self.assertEqual(stream["sample_aspect_ratio"], "128:117")

    def test_full_range_is_kept(self):
        self.convert("in.mkv", "-c:v", "ffv1", "-vf", "scale=in_range=tv:out_range=pc", "-pix_fmt", "yuv420p", "-color_range", "pc")
        self.succeed("encode", "in.mkv", "out.fbs")
        self.assertIn(b"XCOLORRANGE=FULL", self.succeed("decode", "out.fbs", "-").partition(b"\n")[0])

    def test_damaged_packets_are_passed_over(self):
        self.convert("in.mkv", "-c:v", "ffv1", "-g", "1", "-slicecrc", "1")
        self.assertEqual(Y4m(self.short.read_bytes()).shape, (176, 144, 20, 30.0))
        data = bytearray((self.folder / "in.mkv").read_bytes())
        data[len(data) // 2] ^= 0xFF
        self.write("bad.mkv", bytes(data))
        done = self.fbs("encode", "bad.mkv", "out.fbs")
        self.assertIn(done.returncode, (0, 2), done.stderr)
