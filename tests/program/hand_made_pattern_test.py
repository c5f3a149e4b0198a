"""encode --pattern: an image in the place of the first picture."""
import unittest

from harness import TALK_FBS, TALK_ONE_FBS, TALK_Y4M, Y4m, ProgramTest, ffmpeg, read_y4m

FRAMES = 30
BOX = (4, 8, 28, 24)  # left, top, right, bottom: ground beside the head


class HandMadePattern(ProgramTest):
    def picture(self, name, *filters):
        """The first picture of the talker as an image."""
        ffmpeg("-i", TALK_Y4M, "-frames:v", "1", "-vf", ",".join(filters) or "null", self.folder / name)

    def encoded(self, pattern):
        """The pictures of a stream made with it."""
        self.succeed("encode", TALK_Y4M, "out.fbs", "--patterns", 1, "--pattern", pattern, "--frames", FRAMES, "--quality", 80,
                     "--quiet")
        return Y4m(self.succeed("decode", "out.fbs", "-", "--quiet"))

    @staticmethod
    def mean_luma(video, picture):
        left, top, right, bottom = BOX
        luma = video.pictures[picture]
        rows = [luma[y * video.width + left:y * video.width + right] for y in range(top, bottom)]
        return sum(map(sum, rows)) / sum(map(len, rows))

    def test_is_what_the_stream_shows(self):
        self.picture("painted.png", "drawbox=x=0:y=0:w=36:h=32:color=white:t=fill")
        video = self.encoded("painted.png")
        for picture in (0, FRAMES - 1):
            self.assertGreater(self.mean_luma(video, picture), 225)
        self.assertLess(self.mean_luma(read_y4m(TALK_Y4M), 0), 200)

    def test_moves_as_the_video_does(self):
        self.picture("same.png")
        face = (60, 30, 116, 120)
        source = read_y4m(TALK_Y4M)
        source.pictures = source.pictures[:FRAMES]
        own = Y4m(self.succeed("decode", TALK_ONE_FBS, "-", "--quiet"))
        own.pictures = own.pictures[:FRAMES]
        self.assertGreater(self.encoded("same.png").luma_psnr(source, face), own.luma_psnr(source, face) - 1)

    def test_linear_light_gets_the_curve_of_srgb(self):
        grey = ("format=gbrpf32", "geq=r=0.5:g=0.5:b=0.5")
        try:
            self.picture("grey.exr", *grey)
        except Exception:
            self.skipTest("ffmpeg writes no OpenEXR")
        self.picture("grey.png", "format=gray", "geq=lum=188")  # the level of half the light
        linear, srgb = self.encoded("grey.exr"), self.encoded("grey.png")
        self.assertAlmostEqual(self.mean_luma(linear, 0), 16 + 188 * 219 / 255, delta=2)
        self.assertAlmostEqual(self.mean_luma(linear, 0), self.mean_luma(srgb, 0), delta=1)

    def test_bad_input(self):
        encode = ("encode", TALK_Y4M, "out.fbs", "--frames", 5, "--quiet")
        self.picture("small.png", "scale=88:72")
        self.picture("right.png")
        self.write("text.png", b"not an image\n" * 10)
        self.fail_cleanly(*encode, "--patterns", 1, "--pattern", "small.png", says=["small.png", "88x72", "176x144"])
        self.fail_cleanly(*encode, "--patterns", 1, "--pattern", "absent.exr", says=["absent.exr"])
        self.fail_cleanly(*encode, "--patterns", 1, "--pattern", "text.png", says=["text.png"])
        self.fail_cleanly(*encode, "--pattern", "right.png", says=["--pattern", "--patterns 1"])
        self.write("stream.fbs", TALK_FBS.read_bytes())
        self.fail_cleanly("encode", TALK_Y4M, "stream.fbs", "--patterns", 1, "--pattern", "stream.fbs", says=["the same file"])


if __name__ == "__main__":
    unittest.main()
