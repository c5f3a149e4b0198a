"""Each optional part of the encoder improves the pictures; without it the stream still decodes."""
import json

from clips import first_pictures
from harness import CLOSE_Y4M, ProgramTest


class Worth(ProgramTest):
    def psnr(self, source, *options):
        self.succeed("encode", source, "out.fbs", *options)
        self.succeed("decode", "out.fbs", "null:")
        return json.loads(self.succeed("evaluate", source, "out.fbs", "--json"))["points"][0]

    def test_refinement(self):
        # With one pattern: more of them make up for a state that is off, at a rate.
        without = self.psnr(CLOSE_Y4M, "--patterns", "1", "--track-only")
        self.assertLess(without["psnr_face"], self.psnr(CLOSE_Y4M, "--patterns", "1")["psnr_face"] - 1.5)

    def test_surround_that_moves(self):
        # A camera in a car: the ground moves.
        source = first_pictures(self, "carphone_qcif", 90)
        self.assertLess(self.psnr(source, "--still-surround")["psnr_frame"], self.psnr(source)["psnr_frame"] - 0.3)

    def test_surround_of_the_talker(self):
        still, moving = self.psnr(CLOSE_Y4M, "--still-surround"), self.psnr(CLOSE_Y4M)
        self.assertLess(still["psnr_frame"], moving["psnr_frame"])
