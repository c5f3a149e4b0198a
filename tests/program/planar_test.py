"""Pictures without a face: they move, at any length and size, and say that they have no face."""
import json
import math

from harness import ProgramTest, read_y4m


def wall(x, y):
    return int(128 + 40 * math.sin(0.31 * x + 2 * math.sin(0.09 * y)) + 40 * math.cos(0.27 * y + 0.05 * x))


def moving_y4m(width, height, count, luma):
    """Bytes of a video; luma(x, y, t)."""
    chroma = bytes([128]) * (2 * ((width + 1) // 2) * ((height + 1) // 2))
    pictures = (bytes(luma(x, y, t) for y in range(height) for x in range(width)) for t in range(count))
    return b"YUV4MPEG2 W%d H%d F25:1 Ip C420jpeg\n" % (width, height) + b"".join(
        b"FRAME\n" + picture + chroma for picture in pictures)


class Planar(ProgramTest):
    def coded(self, *options):
        """Encodes in.y4m; returns the PSNR of its pictures and the output of inspect."""
        self.succeed("encode", "in.y4m", "out.fbs", "--allow-no-face", "--quiet", *options)
        psnr = self.decoded("out.fbs").luma_psnr(read_y4m(self.folder / "in.y4m"))
        return psnr, json.loads(self.succeed("inspect", "out.fbs", "--json"))

    def test_what_moves_is_shown(self):
        def square(x, y, t):
            return 220 if 2 * t <= x < 2 * t + 16 and 30 <= y < 46 else 60 + x // 2 + y // 3
        self.write("in.y4m", moving_y4m(112, 80, 45, square))
        psnr, reported = self.coded()
        self.assertGreater(psnr, 26)
        self.assertGreater(reported["pattern_count"], 5)
        self.assertFalse(reported["face"])
        self.assertLess(self.coded("--patterns", "1")[0], psnr - 4, "one is a still picture")

    def test_camera_moves(self):
        self.write("in.y4m", moving_y4m(112, 80, 45, lambda x, y, t: wall(x + 3 * t, y - t)))
        psnr, reported = self.coded()
        self.assertGreater(psnr, 27)
        self.assertFalse(reported["face"], "what moves the picture is no face")
        self.assertTrue(all(not scene["face"] for scene in reported["scenes"]))
        self.succeed("export", "out.fbs", "out.csv")
        rows = (self.folder / "out.csv").read_text().splitlines()
        self.assertEqual(len(rows), 46)
        self.assertIn("nan", rows[1])

    def test_odd_and_small_sizes(self):
        for width, height in ((64, 64), (97, 65)):
            self.write("in.y4m", moving_y4m(width, height, 20, lambda x, y, t: wall(x + 2 * t, y)))
            for options in (("--quality", "0"), ("--quality", "100"), ("--patterns", "64"), ("--key-interval", "0.3")):
                self.assertGreater(self.coded(*options)[0], 18, (width, height, options))

    def test_bitrate(self):
        self.write("in.y4m", moving_y4m(112, 80, 60, lambda x, y, t: wall(x, y) // 2 + (100 if 2 * t <= x < 2 * t + 9 else 0)))
        _, reported = self.coded("--bitrate", "10")
        self.assertAlmostEqual(reported["bytes"]["total"] * 8e-3 / 2.4, 10, delta=2.5)
