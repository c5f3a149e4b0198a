"""The plugin for GStreamer in pipelines: what it reads and writes is what fbs reads and writes."""
import os
import re
import shutil
import signal
import subprocess
import time
import unittest

import call
from harness import (BUILD, KEYED_FBS, MAX_SECONDS, SOURCE, TALK_FBS, TALK_Y4M, TWO_SCENES_FBS, ProgramTest, packets,
                     read_y4m)

PLUGIN = BUILD / "gstreamer/libgstfbs.so"
ELEMENTS = ("fbsenc", "fbsdec", "fbsparse", "rtpfbspay", "rtpfbsdepay")
PICTURE = 176 * 144 * 3 // 2


def missing():
    """What the tests need and is not there, or None."""
    if not PLUGIN.exists():
        return "the plugin for GStreamer was not built"
    if b"libasan.so" in PLUGIN.read_bytes():
        return "GStreamer's tools load no plugin that is built with sanitizers"
    for tool in ("gst-launch-1.0", "gst-inspect-1.0", "gst-typefind-1.0"):
        if not shutil.which(tool):
            return f"no {tool}"
    for element in ("y4mdec", "filesrc", "decodebin"):
        if subprocess.run(["gst-inspect-1.0", "--exists", element], check=False).returncode != 0:
            return f"GStreamer has no {element}"
    return None


@unittest.skipIf(missing(), missing())
class GStreamer(ProgramTest):
    def tool(self, *words):
        """Runs a tool of GStreamer, which must succeed; returns what it prints."""
        environment = {**os.environ, "GST_PLUGIN_PATH": str(PLUGIN.parent),
                       "GST_REGISTRY": str(self.folder / "registry.bin"), "LC_ALL": "C"}
        done = subprocess.run([str(word) for word in words], cwd=self.folder, env=environment, capture_output=True,
                              text=True, timeout=MAX_SECONDS)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertNotIn("CRITICAL", done.stderr)
        return done.stdout

    def launch(self, line):
        """Runs a pipeline to its end."""
        return self.tool("gst-launch-1.0", "-q", *line.split())

    def pictures(self, line):
        """What a pipeline makes, as bytes of each picture."""
        self.launch(f"{line} ! filesink location=out.yuv")
        samples = (self.folder / "out.yuv").read_bytes()
        return [samples[at:at + PICTURE] for at in range(0, len(samples), PICTURE)]

    def test_a_file_is_decoded_as_fbs_decodes_it(self):
        for stream in (TALK_FBS, KEYED_FBS, TWO_SCENES_FBS):
            expected = self.decoded(stream).pictures
            self.assertEqual(self.pictures(f"filesrc location={stream} ! fbsparse ! fbsdec"), expected)
            self.assertEqual(self.pictures(f"filesrc location={stream} blocksize=100 ! queue ! fbsparse ! fbsdec threads=2"),
                             expected)

    def test_a_file_is_known_by_its_signature(self):
        self.write("talk", TALK_FBS.read_bytes())
        self.assertIn("video/x-fbs", self.tool("gst-typefind-1.0", "talk"))
        self.assertEqual(self.pictures("filesrc location=talk ! decodebin"), self.decoded(TALK_FBS).pictures)

    def test_what_is_encoded_is_a_file(self):
        for settings in ("threads=1", "threads=4", "bitrate=8000 delay=0.5", "live=false", "patterns=1 key-interval=1"):
            self.launch(f"filesrc location={TALK_Y4M} ! y4mdec ! fbsenc {settings} ! filesink location=out.fbs")
            decoded = self.decoded("out.fbs")
            self.assertEqual(decoded.shape, read_y4m(TALK_Y4M).shape, settings)
            self.assertEqual(self.pictures("filesrc location=out.fbs ! fbsparse ! fbsdec"), decoded.pictures)
            self.assertGreater(decoded.luma_psnr(read_y4m(TALK_Y4M)), 25, settings)

    def encoded_both(self, properties, options):
        """The stream that the element makes of the talker, and that of the program."""
        self.launch(f"filesrc location={TALK_Y4M} ! y4mdec ! fbsenc {properties} ! filesink location=out.fbs")
        self.succeed("encode", TALK_Y4M, "live.fbs", "--live", *options, "--quiet")
        return ((self.folder / name).read_bytes() for name in ("out.fbs", "live.fbs"))

    def test_properties_are_the_encoders_settings(self):
        for properties, options in (("quality=60", ("--quality", 60)), ("key-interval=1", ("--key-interval", 1)),
                                    ("effort=0", ("--effort", 0)), ("delay=0.4 patterns=1", ("--delay", 0.4, "--patterns", 1))):
            ours, theirs = map(packets, self.encoded_both(properties, options))
            self.assertEqual([kind for kind, _, _ in ours], [kind for kind, _, _ in theirs], properties)
            self.assertTrue(self.decoded("out.fbs").pictures == self.decoded("live.fbs").pictures, properties)

    def test_the_bitrate_is_that_of_the_program(self):
        # y4mdec guesses the colours. They lengthen AV1's headers, and the rate leaves fewer bits for the rest. A short buffer
        # is a small share of the bytes, however full it is at the end.
        ours, theirs = map(len, self.encoded_both("bitrate=8000 buffer=0.5", ("--bitrate", 8, "--buffer", 0.5)))
        self.assertAlmostEqual(ours, theirs, delta=0.05 * theirs)

    def test_a_file_goes_through_the_parser_and_rtp_unchanged(self):
        for stream in (TALK_FBS, KEYED_FBS):
            for between in ("fbsparse", "fbsparse ! rtpfbspay mtu=64 ! rtpfbsdepay", "fbsparse ! rtpfbspay ! rtpfbsdepay"):
                self.launch(f"filesrc location={stream} ! {between} ! filesink location=out.fbs")
                self.assertEqual((self.folder / "out.fbs").read_bytes(), stream.read_bytes(), between)

    def test_lost_packets_cost_their_scene_alone(self):
        expected = self.decoded(KEYED_FBS).pictures
        for probability in (0.02, 0.1, 0.4):
            pictures = self.pictures(f"filesrc location={KEYED_FBS} ! fbsparse ! rtpfbspay mtu=200"
                                     f" ! identity drop-probability={probability} ! rtpfbsdepay ! fbsdec")
            self.assertLessEqual(len(pictures), len(expected))
            self.assertLessEqual(set(pictures), set(expected), "a picture that the encoder never made")

    def test_the_decoder_survives_lost_groups(self):
        for probability in (0.1, 0.5):
            self.launch(f"filesrc location={KEYED_FBS} ! fbsparse ! identity drop-probability={probability} ! fbsdec"
                        " ! fakesink")

    def test_sizes_are_negotiated(self):
        self.launch("videotestsrc num-buffers=5 ! video/x-raw,width=97,height=65 ! fbsenc ! fbsdec ! fakesink")
        with self.assertRaises(AssertionError):
            self.launch("videotestsrc num-buffers=5 ! video/x-raw,width=32,height=32 ! fbsenc ! fakesink")
        with self.assertRaises(AssertionError):
            self.launch("videotestsrc num-buffers=5 ! video/x-raw,format=RGB ! fbsenc ! fakesink")

    def documented(self):
        """The lines of docs/gstreamer.md, with a file in place of camera and microphone, and no windows."""
        text = (SOURCE / "docs/gstreamer.md").read_text()
        blocks = [block for block in re.findall(r"(?:^    .*\n)+", text, re.MULTILINE) if "gst-launch-1.0" in block]
        first, lines = call.free_ports(), [" ".join(line.strip().rstrip("\\") for line in block.splitlines()) for block in blocks]
        for theirs, ours in (("v4l2src", f"filesrc location={TALK_Y4M} ! y4mdec ! clocksync"), ("HOST", "127.0.0.1"),
                             ("autoaudiosrc", "audiotestsrc is-live=true"), ("autovideosink", "fakesink name=window sync=true"),
                             ("autoaudiosink", "fakesink sync=true"), ("talk.mp4", str(TALK_Y4M))):
            lines = [line.replace(theirs, ours) for line in lines]
        return [re.sub(r"port=500(\d)", lambda port: f"port={first + int(port[1])}", line).split() for line in lines]

    def start(self, words, output):
        environment = {**os.environ, "GST_PLUGIN_PATH": str(PLUGIN.parent), "LC_ALL": "C",
                       "GST_REGISTRY": str(self.folder / "registry.bin"), "GST_DEBUG": "rtprtxreceive:5"}
        with open(self.folder / output, "wb") as out:
            return subprocess.Popen([words[0], "-v", *(word.replace('"', "") for word in words[1:])], cwd=self.folder,
                                    env=environment, stdout=out, stderr=subprocess.STDOUT)

    def test_lines_of_the_document_run(self):
        play, camera, best, *ends = self.documented()
        self.assertEqual(len(ends), 4)
        self.write("talk.fbs", TALK_FBS.read_bytes())
        self.tool(*play)
        recorder = self.start(camera, "camera.txt")
        time.sleep(3)
        recorder.send_signal(signal.SIGINT)
        self.assertEqual(recorder.wait(MAX_SECONDS), 0, (self.folder / "camera.txt").read_text())
        self.assertGreater(len(self.decoded("me.fbs").pictures), 0)
        self.tool(*best)
        self.assertEqual(len(self.decoded("talk.fbs").pictures), 120)

    def check_call(self, sends, sees, *expected):
        """Runs both ends until the second one has printed what is expected."""
        sender, receiver = (self.start(words, f"{name}.txt") for words, name in ((sends, "sends"), (sees, "sees")))
        end = time.monotonic() + 60
        while time.monotonic() < end and not all(text in (self.folder / "sees.txt").read_text() for text in expected):
            time.sleep(0.2)
        for process, name in ((sender, "sends.txt"), (receiver, "sees.txt")):
            text = (self.folder / name).read_text()
            self.assertIsNone(process.poll(), text)
            self.assertNotIn("ERROR", text)
            process.kill()
            process.wait()
        self.assertLess(time.monotonic(), end, expected)

    def test_the_call_of_the_document_shows_pictures(self):
        self.check_call(*self.documented()[3:5], "GstFakeSink:window.GstPad:sink: caps")

    def test_the_call_with_retransmission_repairs_what_is_lost(self):
        sends, sees = self.documented()[5:]
        first = sends.index("udpsink")
        sends[first:first] = "netsim drop-probability=0.3 delay-probability=1 min-delay=20 max-delay=60 !".split()
        self.check_call(sends, sees, "GstFakeSink:window.GstPad:sink: caps", "Got rtx packet")

    def test_elements_are_described(self):
        for element in ELEMENTS:
            text = self.tool("gst-inspect-1.0", element)
            for words in ("Long-name", "Klass", "fbs", "The fbs authors"):
                self.assertIn(words, text)
        text = self.tool("gst-inspect-1.0", "fbsenc")
        for words in ("bitrate", "Bit/s, from which quality follows", "key-interval", "live"):
            self.assertIn(words, text)
