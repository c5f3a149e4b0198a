"""HDR, wide colours and transparency, made from an SDR origin: streams look as the origin's does, and fbs says so."""
import functools
import json
import subprocess
import unittest

from harness import FBS, TALK_Y4M, ProgramTest, ffmpeg

ORIGIN = "zscale=min=709:tin=709:pin=709:rin=tv"
HDR = "{}:t=linear:npl=203,format=gbrpf32le,zscale=npl=203:t={}:p=2020:m=2020_ncl:r=tv"  # white is 203 cd/m2
WIDE = "-color_primaries", "bt2020", "-colorspace", "bt2020nc", "-color_trc"
P3 = "-color_primaries", "smpte432", "-colorspace", "bt709", "-color_trc", "bt709"


def lab(y, u, v):
    """CIE 1976 of limited-range BT.709, of a white of D65."""
    y, u, v = (y - 16) / 219, (u - 128) / 224, (v - 128) / 224
    rgb = (min(max(c, 0), 1) ** 2.2 for c in (y + 1.5748 * v, y - 0.1873 * u - 0.4681 * v, y + 1.8556 * u))
    r, g, b = rgb
    x, y, z = (c ** (1 / 3) if c > 0.008856 else 7.787 * c + 16 / 116
               for c in (0.4339 * r + 0.3762 * g + 0.1899 * b, 0.2127 * r + 0.7152 * g + 0.0722 * b,
                         0.0178 * r + 0.1095 * g + 0.8727 * b))
    return 116 * y - 16, 500 * (x - y), 200 * (y - z)


def delta_e(a, b):
    """Mean CIE76 difference of the first pictures of two Y4M files of 176x144, at every fourth sample."""
    def samples(picture):
        for y in range(0, 144, 2):
            for x in range(0, 176, 2):
                chroma = 176 * 144 + y // 2 * 88 + x // 2
                yield lab(picture[y * 176 + x], picture[chroma], picture[chroma + 88 * 72])
    distances = [sum((p - q) ** 2 for p, q in zip(c, d)) ** 0.5 for c, d in zip(samples(a.pictures[0]), samples(b.pictures[0]))]
    return sum(distances) / len(distances)


@functools.cache
def has_zscale():
    filters = subprocess.run(["ffmpeg", "-hide_banner", "-filters"], capture_output=True, text=True).stdout
    return " zscale " in filters


class Colours(ProgramTest):
    def setUp(self):
        super().setUp()
        if not has_zscale():
            raise unittest.SkipTest("this ffmpeg has no zscale")
        ffmpeg("-i", TALK_Y4M, "-frames:v", "3", "-vf", "scale=in_color_matrix=bt601:out_color_matrix=bt709", "-c:v", "ffv1",
               "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709", "-color_range", "tv",
               self.folder / "sdr.mkv")

    def encode(self, name, says):
        """@return the decoded pictures"""
        done = self.fbs("encode", name, "out.fbs", "--patterns", 1, "--quality", 100)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"fbs: {name}: {says}\n", done.stderr.decode())
        self.assertEqual(self.fbs("encode", name, "quiet.fbs", "--quiet", "--patterns", 1, "--quality", 100).stderr, b"")
        return self.decoded("out.fbs")

    def comes_back(self, name, says, filters, *options):
        """A clip of other colours looks as the origin does, and is evaluated so."""
        ffmpeg("-i", self.folder / "sdr.mkv", "-vf", filters, "-c:v", "ffv1", "-color_range", "tv", *options, self.folder / name)
        self.succeed("encode", "sdr.mkv", "sdr.fbs", "--patterns", 1, "--quality", 100)
        origin, out = self.decoded("sdr.fbs"), self.encode(name, says)
        self.assertIn(b"XMATRIX=BT709", out.header)
        ffmpeg("-i", self.folder / name, "-vf", "setparams=color_primaries=bt709:color_trc=bt709:colorspace=bt709", "-c:v", "ffv1",
               self.folder / "mistaken.mkv")
        self.succeed("encode", "mistaken.mkv", "mistaken.fbs", "--patterns", 1, "--quality", 100)
        difference = delta_e(origin, out)  # most of it from coding
        self.assertLess(difference, 2.8)
        self.assertGreater(delta_e(origin, self.decoded("mistaken.fbs")), difference + 0.6)
        self.assertIn(says, self.fbs("evaluate", name, "out.fbs", "--json").stderr.decode())
        psnr = self.psnr(name, "out.fbs")
        self.assertAlmostEqual(psnr, self.psnr("sdr.mkv", "sdr.fbs"), delta=1.5)

    def psnr(self, source, stream):
        return json.loads(self.succeed("evaluate", source, stream, "--json"))["points"][0]["psnr_frame"]

    def test_pq(self):
        self.comes_back("pq.mkv", "HDR (PQ) tone-mapped to BT.709",
                        HDR.format(ORIGIN, "smpte2084") + ",format=yuv420p10le", *WIDE, "smpte2084")

    def test_hlg(self):
        self.comes_back("hlg.mkv", "HDR (HLG) tone-mapped to BT.709",
                        HDR.format(ORIGIN, "arib-std-b67") + ",format=yuv422p10le", *WIDE, "arib-std-b67")

    def test_bt2020(self):
        self.comes_back("wide.mkv", "BT.2020 converted to BT.709",
                        ORIGIN + ":p=2020:m=2020_ncl:t=2020_10,format=yuv420p10le", *WIDE, "bt2020-10")

    def test_display_p3(self):
        self.comes_back("p3.mkv", "Display P3 converted to BT.709", ORIGIN + ":p=smpte432,format=yuv444p10le", *P3)

    def test_odd_sides(self):
        ffmpeg("-i", self.folder / "sdr.mkv", "-vf", ORIGIN + ":p=smpte432,format=yuv444p,crop=175:143:exact=1", "-c:v", "ffv1",
               "-color_range", "tv", *P3, self.folder / "odd.mkv")
        self.assertEqual(self.encode("odd.mkv", "Display P3 converted to BT.709").shape[:2], (175, 143))

    def test_bright_parts_of_hdr_keep_their_shades(self):
        """A ramp from black to 1000 cd/m2 over the picture's width rises to its end."""
        ramp = "nullsrc=s=176x144:r=25,format=gbrpf32le,geq=r='X/175*4.926':g='X/175*4.926':b='X/175*4.926'"
        ffmpeg("-f", "lavfi", "-i", ramp, "-frames:v", "1", "-vf",
               "setparams=color_primaries=bt709:color_trc=linear:colorspace=gbr,"
               "zscale=npl=203:t=smpte2084:p=2020:m=2020_ncl:r=tv,format=yuv420p10le", "-c:v", "ffv1", "-color_range", "tv", *WIDE,
               "smpte2084", self.folder / "ramp.mkv")
        self.succeed("encode", "ramp.mkv", "ramp.fbs", "--allow-no-face", "--quality", 100)
        row = self.decoded("ramp.fbs").pictures[0][72 * 176:73 * 176]
        self.assertLess(row[36], 230)  # 203 cd/m2, SDR's white
        self.assertGreater(row[80], row[36] + 2)
        self.assertGreater(row[170], row[80] + 2)

    def test_transparent_parts_are_black(self):
        cut = "format=gbrap,geq=r='r(X,Y)':g='g(X,Y)':b='b(X,Y)':a='if(lt(X,32),0,255)',format=bgra"
        ffmpeg("-i", self.folder / "sdr.mkv", "-vf", cut, "-c:v", "ffv1", self.folder / "cut_out.mkv")
        ffmpeg("-i", self.folder / "cut_out.mkv", self.folder / "cut_%d.png")
        for name in ("cut_out.mkv", "cut_%d.png"):
            out = self.encode(name, "transparent parts are shown over black")
            self.assertLess(max(out.pictures[0][y * 176 + x] for y in range(8, 136) for x in range(4, 24)), 40, name)

    def test_opaque_alpha_says_nothing(self):
        ffmpeg("-i", self.folder / "sdr.mkv", "-vf", "format=rgba", "-c:v", "ffv1", self.folder / "opaque.mkv")
        ffmpeg("-i", self.folder / "sdr.mkv", "-vf", "format=bgr0", "-c:v", "ffv1", self.folder / "plain.mkv")
        self.assertNotIn(b"transparent", self.fbs("encode", "opaque.mkv", "opaque.fbs").stderr)
        self.succeed("encode", "plain.mkv", "plain.fbs")
        self.assertEqual((self.folder / "opaque.fbs").read_bytes(), (self.folder / "plain.fbs").read_bytes())
