"""samples/call: two ends talk to each other over a network that loses packets."""
import ctypes
import os
import subprocess
import unittest
import wave

import call
import gstreamer_test
from harness import SOURCE, TALK_Y4M, ProgramTest, read_y4m
from speech import RATE, bursts

SECONDS = 8
NETWORK = ("--min-delay", 5, "--max-delay", 25)


def missing():
    if gstreamer_test.missing():
        return gstreamer_test.missing()
    for element in ("rtpbin", "netsim", "opusenc", "rtpopuspay", "rtprtxsend", "audiobuffersplit", "clocksync", "wavparse"):
        if subprocess.run(["gst-inspect-1.0", "--exists", element], check=False).returncode != 0:
            return f"GStreamer has no {element}"
    return None


@unittest.skipIf(missing(), missing())
class Call(ProgramTest):
    def files(self):
        """The talker, there and back, and a voice."""
        video = read_y4m(TALK_Y4M)
        pictures = video.pictures + video.pictures[::-1]
        self.write("talk.y4m", video.header + b"".join(b"FRAME\n" + picture for picture in pictures))
        with wave.open(str(self.folder / "voice.wav"), "wb") as out:
            out.setparams((1, 2, RATE, 0, "NONE", ""))
            out.writeframes(bursts(len(pictures) / video.rate, 5).tobytes())
        return self.folder / "talk.y4m", self.folder / "voice.wav"

    def talk(self, *options, **more):
        files = self.files()
        ends = call.talk(self.folder, files, files, "--seconds", SECONDS, *NETWORK, *options, **more)
        for end in ends:
            self.assertGreater(len(end.pictures), 5)
            self.assertGreater(len(end.voice), 100)
            self.assertGreater(end.total["faces"], 0)
            self.assertGreater(end.total["voice"], 0)
        return ends

    def test_pictures_and_voice_arrive_both_ways_with_their_times(self):
        ends = self.talk()
        for here, there in zip(ends, ends[::-1]):
            for rows, what in ((here.pictures, "picture"), (here.voice, "voice")):
                known = [row for row in rows if row.recorded > 0]
                self.assertGreater(len(known), len(rows) // 4, what)
                for row in known:
                    self.assertGreaterEqual(row.recorded, there.sent[what] - 0.1)
                    self.assertGreater(row.at, row.recorded)
            self.assertGreaterEqual(len(here.seconds), SECONDS - 2)
            self.assertEqual(here.total["lost"], 0)

    def test_after_a_loss_a_scene_is_asked_for_and_the_picture_goes_on(self):
        ends = self.talk("--loss", 0.1, seeds=(3, 4))
        for end in ends:
            self.assertGreater(end.total["lost"], 2)
        self.assertGreater(sum(end.total["missing"] for end in ends), 0)
        self.assertGreater(sum(end.total["asked"] for end in ends), 0)
        self.assertGreater(sum(end.total["heard"] for end in ends), 0)
        self.assertGreater(sum(end.total["given"] for end in ends), len(ends))  # the first ones, and those asked for
        for end in ends:
            self.assertGreater(end.pictures[-1].at, end.voice[0].at + SECONDS / 4)

    def test_what_is_lost_is_sent_again(self):
        for repair in ("both", "copy"):
            ends = self.talk("--loss", 0.1, "--repair", repair)
            for end in ends:
                self.assertGreater(end.total["repair"], 0, repair)
                self.assertEqual(end.total["repaired"] > 0, repair == "both")

    def test_the_rate_follows_the_link(self):
        for end in self.talk("--bitrate", 10000, "--min-bitrate", 2000, "--max-bitrate", 20000, "--capacity", "200,32,32"):
            rates = [line["rate"] for line in end.seconds]
            self.assertGreater(max(rates), 10)
            self.assertLess(rates[-1], 0.8 * max(rates))  # of 32 kbit/s the voice leaves nothing
            self.assertGreater(max(line["trip"] for line in end.seconds), 250)

    def test_nothing_is_left_when_it_ends(self):
        self.talk("--loss", 0.1, "--repair", "rtx", more={"GST_TRACERS": "leaks", "GST_DEBUG": "GST_TRACER:7"})
        for name in "ab":
            left = [line for line in (self.folder / f"{name}.err").read_text().splitlines()
                    if "object-alive, type-name=(string)%" not in line and ("object-alive, " in line or "CRITICAL" in line)]
            self.assertEqual(left, [])

    def test_options_that_make_no_sense_are_refused(self):
        for options, words in (((), "--pictures"), (("--loss", "1"), "--loss"), (("--repair", "glue"), "--repair"),
                               (("--min-delay", "9"), "--max-delay"), (("--port", "0"), "ports"),
                               (("--no-such",), "--no-such"), (("--capacity", "5,x"), "--capacity"),
                               (("--min-bitrate", "9"), "--max-bitrate"), (("--queue", "0"), "--queue")):
            given = ("--pictures", "x", "--sound", "y", *options) if options else ()
            done = subprocess.run([call.CALL, *given], capture_output=True, text=True, timeout=60,
                                  env=call.environment(self.folder))
            self.assertEqual(done.returncode, 2, options)
            self.assertIn(words, done.stderr)
        self.write("talk.y4m", b"")
        done = subprocess.run([call.CALL, "--pictures", "talk.y4m", "--sound", "no.wav"], capture_output=True, text=True,
                              cwd=self.folder, timeout=60, env=call.environment(self.folder))
        self.assertEqual((done.returncode, done.stderr), (2, "call: cannot read no.wav\n"))
        done = subprocess.run([call.CALL, "--pictures", "talk.y4m", "--sound", "talk.y4m"], capture_output=True, text=True,
                              cwd=self.folder, timeout=60, env=call.environment(self.folder))
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, "^call: .*\n$")


class Control(ctypes.Structure):
    """RateControl of samples/call/rate.h."""
    _fields_ = [(name, ctypes.c_double) for name in ("min", "max", "rate", "sent", "loss", "base", "queue")]


@unittest.skipIf(missing(), missing())
class RateControl(ProgramTest):
    def setUp(self):
        super().setUp()
        flags = subprocess.run(["pkg-config", "--cflags", "--libs", "gstreamer-1.0"], check=True, capture_output=True,
                               text=True)
        sources = [SOURCE / "samples/call" / f"{name}.c" for name in ("rate", "retransmission")]
        subprocess.run([os.environ.get("CC", "cc"), "-shared", "-fPIC", *sources, "-o", self.folder / "rate.so",
                        *flags.stdout.split(), "-lm"], check=True)
        self.report = ctypes.CDLL(self.folder / "rate.so").rate_control_report
        self.report.restype = ctypes.c_double
        self.report.argtypes = [ctypes.POINTER(Control)] + [ctypes.c_double] * 4
        self.control = Control(2000, 20000, 10000)

    def call(self, seconds, capacity, loss=0.0, others=35000):
        """A report a second over a link with a queue of a second; returns the rates and the queues, s."""
        rates, queues, queue, before = [], [], 0, 0
        for _ in range(seconds):
            rate = self.control.rate
            growth = (others + rate) / capacity - 1
            full = max(0, queue + growth - 1)
            before, queue = queue, min(1, max(0, queue + growth))
            rates.append(self.report(self.control, loss + full, 0.1 + before, rate, 1))
            queues.append(queue)
        return rates, queues

    def test_it_uses_what_the_link_has(self):
        rates, queues = self.call(60, 100000)
        self.assertEqual((rates[-1], max(queues)), (20000, 0))

    def test_it_leaves_a_narrow_link_before_the_queue_is_full(self):
        self.call(20, 57000)
        rates, queues = self.call(60, 44000)
        self.assertLess(max(queues), 0.9)
        self.assertLess(max(queues[15:]), 0.5)
        self.assertGreater(sum(rates[20:]) / 40, 4000)
        rates, queues = self.call(40, 57000)
        self.assertGreater(rates[-1], 15000)

    def test_losses_without_a_queue_take_their_share_only(self):
        for loss, rate in ((0.05, 17500), (0.2, 10000), (0.1, 15000)):
            self.assertAlmostEqual(self.call(60, 100000, loss)[0][-1], rate, delta=100)

    def test_the_limits_hold(self):
        self.assertEqual(self.call(60, 30000)[0][-1], 2000)
        self.assertEqual(self.call(60, 100000, 0.6)[0][-1], 2000)
