"""A target bitrate is met, or the program says that it is not reachable."""
import json
import re

from clips import first_pictures
from harness import CLOSE_Y4M, TALK_Y4M, ProgramTest, ffmpeg

WITHIN = 0.1  # of a rate
NOT_REACHABLE = "kbit/s not reachable, got "


class Rate(ProgramTest):
    def encode(self, source, *options):
        """Encodes; returns the output of inspect and the messages of encode."""
        done = self.fbs("encode", source, "out.fbs", "--quiet", *options)
        error = done.stderr.decode()
        self.assertEqual(done.returncode, 0, error)
        return json.loads(self.succeed("inspect", "out.fbs", "--json")), error

    def rate(self, reported):
        return reported["bytes"]["total"] * 8e-3 / reported["seconds"]

    def motion_rate(self, reported):
        """What --motion-bitrate sets: the motion packets without the blend packets between them."""
        return (reported["bytes"]["motion"] - reported["motion"]["blend"]) * 8e-3 / reported["seconds"]

    def total(self, source, kbps):
        """The rate is met, or the program says that it is not, with the rate it got."""
        reported, said = self.encode(source, "--bitrate", kbps)
        self.assertGreater(reported["seconds"], 4.99)
        rate = self.rate(reported)
        if said:
            self.assertRegex(said, r"\Afbs: out\.fbs: [^\n]+\n\Z")
            self.assertIn(f"target {kbps:.2f} {NOT_REACHABLE}", said)
            self.assertAlmostEqual(float(re.search(r"got ([0-9.]+)", said)[1]), rate, delta=0.011)
        self.assertEqual(bool(said), abs(rate / kbps - 1) > WITHIN, f"{rate} kbit/s. {said}")
        return rate, said

    def test_total_that_is_reachable(self):
        rates = []
        for kbps in (3, 6):
            rate, said = self.total(CLOSE_Y4M, kbps)
            self.assertEqual(said, "", f"{rate} kbit/s")
            rates.append(rate)
        self.assertLess(rates[0], rates[1])

    def test_total_that_is_not_reachable(self):
        rate, said = self.total(CLOSE_Y4M, 0.2)
        self.assertGreater(rate, 0.22)
        self.assertIn(NOT_REACHABLE, said)

    def test_total_of_a_clip(self):
        rate, said = self.total(first_pictures(self, "claire_qcif", 180), 3)
        self.assertEqual(said, "", f"{rate} kbit/s")

    def test_start(self):
        """The first picture comes in time, and the others are hardly worse for it."""
        for live in ["--live"], []:
            with self.subTest(live=live):
                points = []
                for start in (0, 1):
                    reported, _ = self.encode(CLOSE_Y4M, "--bitrate", 5, "--start", start, *live)
                    point = json.loads(self.succeed("evaluate", CLOSE_Y4M, "out.fbs", "--json"))["points"][0]
                    points.append((reported["bytes"]["startup"], point["psnr_face"]))
                    if not live:
                        self.assertAlmostEqual(self.rate(reported), 5, delta=0.03 * 5)
                self.assertGreater(points[0][0], 625)
                self.assertLessEqual(points[1][0], 625)
                self.assertGreater(points[1][1], points[0][1] - 0.5)

    def most_waiting(self, kbps):
        """Most bytes that wait for a channel of this rate, which takes the packets of out.fbs by their times."""
        waiting = most = before = 0
        for packet in json.loads(self.succeed("inspect", "out.fbs", "--packets", "--json"))["packets"]:
            if packet["seconds"] is not None:
                waiting = max(0, waiting - 125 * kbps * (packet["seconds"] - before))
                before = packet["seconds"]
            waiting += packet["bytes"]
            most = max(most, waiting)
        return most

    def stamped(self, header, true, stamp, pictures=150, steady=True):
        """Stamps are the clock, in a file and live, whatever the rate in the header of the container.

        header   -- the rate in the header
        true     -- the mean rate that the stamps have
        stamp    -- setts' expression for them
        pictures -- of the source
        steady   -- they are evenly spaced, so that a live stream has the rate that one of a Y4M file has
        """
        kbps, buffer, within = 4, 2, 0.05
        live = "--bitrate", kbps, "--live", "--buffer", buffer
        if steady:
            right = self.folder / "right.y4m"
            ffmpeg("-r", str(true), "-i", CLOSE_Y4M, "-frames:v", str(pictures), right)
            usual = self.rate(self.encode(right, *live)[0])
        h264 = ("-c:v", "libx264", "-bf", "0", "-qp", "0")
        vp9 = ("-c:v", "libvpx-vp9", "-lossless", "1", "-deadline", "realtime", "-cpu-used", "8")
        for name, codec in ("in.mkv", h264), ("in.webm", vp9), ("in.flv", h264), ("in.ts", h264), ("in.mp4", h264):
            with self.subTest(name=name):
                plain, source = (self.folder / (kind + name) for kind in ("plain", "stamped"))
                ffmpeg("-r", str(header), "-i", CLOSE_Y4M, "-frames:v", str(pictures), *codec, plain)
                ffmpeg("-i", plain, "-c", "copy", "-bsf:v", f"setts=ts={stamp}", source)
                reported, said = self.encode(source, "--bitrate", kbps)
                self.assertAlmostEqual(reported["seconds"], pictures / true, delta=0.15)
                self.assertAlmostEqual(self.rate(reported), kbps, delta=within * kbps)
                self.assertEqual(said, "")
                rate = self.rate(self.encode(source, *live)[0])
                self.assertLess(self.most_waiting(kbps), (1 + within) * 125 * kbps * buffer)
                if steady:
                    self.assertAlmostEqual(rate, usual, delta=within * usual)

    def test_stamps_at_a_fourth_of_the_rate(self):
        self.stamped(30, 7.5, "TS*4")

    def test_stamps_at_three_times_the_rate(self):
        self.stamped(10, 30, "TS/3")

    def test_stamps_at_a_third_of_the_rate_for_half_of_the_pictures(self):
        self.stamped(30, 15, "TS+2*min(N\\,37)/30/TB", pictures=75, steady=False)

    def motion(self, source):
        worse = 0
        for kbps in (0.3, 0.6, 1.2):
            reported, said = self.encode(source, "--motion-bitrate", kbps)
            self.assertEqual(said, "")
            self.assertAlmostEqual(self.motion_rate(reported) / kbps, 1, delta=WITHIN, msg=f"of {kbps} kbit/s")
            point = json.loads(self.succeed("evaluate", source, "out.fbs", "--json"))["points"][0]
            self.assertGreater(point["psnr_face"], worse, "bits buy pictures")
            worse = point["psnr_face"]

    def test_motion(self):
        self.motion(CLOSE_Y4M)

    def test_motion_of_a_clip(self):
        self.motion(first_pictures(self, "carphone_qcif", 180))

    def test_rate_and_quality_exclude_each_other(self):
        self.fail_cleanly("encode", TALK_Y4M, "out.fbs", "--bitrate", "3", "--quality", "50", says=["--bitrate", "--quality"])
