"""Ctrl-C, SIGTERM and kill -9: what was read until then is kept."""
import json
import os
import signal
import subprocess
import time

from harness import LITTLE_LOST, FBS, MAX_SECONDS, TALK_FBS, TALK_ONE_FBS, TALK_Y4M, ProgramTest, Y4m, ffmpeg, read_y4m
from sound_test import read_wave

STOPS = {signal.SIGINT: 130, signal.SIGTERM: 143}  # signal: exit code
PICTURE = len(b"FRAME\n") + 176 * 144 * 3 // 2     # bytes of the talker's


class Stop(ProgramTest):
    def start(self, *arguments, stdin=subprocess.PIPE):
        """Starts fbs; waits until it has opened its output."""
        running = subprocess.Popen([FBS, *map(str, arguments)], stdin=stdin, stderr=subprocess.PIPE, cwd=self.folder)
        self.addCleanup(running.communicate)
        self.addCleanup(running.kill)
        return running

    def feed(self, running, pictures):
        """Writes the beginning of the talker; returns when the encoder has read it, but for what a pipe holds."""
        data = TALK_Y4M.read_bytes()
        running.stdin.write(data[:data.index(b"\n") + 1 + pictures * PICTURE])
        running.stdin.flush()

    def wait_for(self, condition):
        until = time.monotonic() + MAX_SECONDS
        while not condition():
            self.assertLess(time.monotonic(), until, "did not happen")
            time.sleep(0.02)

    def part(self, name="out.fbs"):
        return self.folder / (name + ".part")

    def ends_with(self, running, code):
        self.assertEqual(running.wait(MAX_SECONDS), code)
        return running.stderr.read().decode()

    def test_encoder_that_waits_for_a_pipe_finishes_the_stream(self):
        for stop, code in STOPS.items():
            running = self.start("encode", "-", "out.fbs")
            self.feed(running, 40)
            self.wait_for(self.part().exists)
            time.sleep(1)
            running.send_signal(stop)
            said = self.ends_with(running, code)
            self.assertRegex(said, r"(?s)\Afbs: finishing the stream.*\nout\.fbs: \d+ pictures, .*\nfbs: stopped by " + stop.name)
            self.assertEqual(list(self.files()), ["out.fbs"])
            self.assertIn(len(self.decoded("out.fbs").pictures), range(35, 41))  # some may wait in the pipe

    def test_encoder_of_a_file_with_sound_finishes_both(self):
        """The sound behind what was read is still read: pictures that wait need it."""
        ffmpeg("-stream_loop", "20", "-i", TALK_Y4M, "-f", "lavfi", "-i", "anoisesrc=amplitude=0.2:duration=80", "-c:v", "libx264",
               "-preset", "ultrafast", "-qp", "10", "-c:a", "pcm_s16le", "-shortest", self.folder / "talk.mkv")
        running = self.start("encode", "talk.mkv", "out.fbs")
        self.wait_for(self.part().exists)
        time.sleep(1)
        running.send_signal(signal.SIGINT)
        self.ends_with(running, 130)
        shown = json.loads(self.succeed("inspect", "out.fbs", "--json"))
        self.assertLess(shown["frames"], 2400)
        self.succeed("decode", "out.fbs", "out.wav", "--quiet")
        loud = read_wave(self.folder / "out.wav")[1][-2400:]
        self.assertGreater(max(map(abs, loud)), 300, "the last 50 ms are heard")

    def test_encoder_of_a_file_finishes_the_stream(self):
        for stop, code in STOPS.items():
            running = self.start("encode", TALK_Y4M, "out.fbs", "--overlay", "see.y4m")
            overlay = self.part("see.y4m")
            self.wait_for(lambda: overlay.exists() and overlay.stat().st_size > 1000)  # a picture has been read
            running.send_signal(stop)
            self.ends_with(running, code)
            pictures = len(self.decoded("out.fbs").pictures)
            self.assertIn(pictures, range(1, 120))
            self.assertEqual(len(read_y4m(self.folder / "see.y4m").pictures), pictures)
            self.assertEqual(list(self.files()), ["out.fbs", "see.y4m"])

    def test_encoder_that_waits_for_a_named_pipe_finishes_the_stream(self):
        os.mkfifo(self.folder / "in.mkv")  # read by libav
        running = self.start("encode", "in.mkv", "out.fbs")
        writer = subprocess.Popen(["ffmpeg", "-v", "quiet", "-nostdin", "-y", "-re", "-stream_loop", "-1", "-i", TALK_Y4M,
                                   "-c:v", "ffv1", "in.mkv"], cwd=self.folder)
        self.addCleanup(writer.wait)
        self.addCleanup(writer.kill)
        self.wait_for(self.part().exists)
        time.sleep(1)
        writer.send_signal(signal.SIGSTOP)  # the pipe stays open and empty
        time.sleep(1)
        running.send_signal(signal.SIGINT)
        self.ends_with(running, 130)
        self.assertGreater(len(self.decoded("out.fbs").pictures), 5)

    def test_stream_into_a_pipe_is_finished(self):
        running = subprocess.Popen([FBS, "encode", "-", "-"], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                   stderr=subprocess.DEVNULL)
        self.feed(running, 120)
        time.sleep(2)
        running.send_signal(signal.SIGINT)
        stream = running.communicate()[0]
        self.assertEqual(running.returncode, 130)
        self.write("out.fbs", stream)
        self.assertGreater(len(self.decoded("out.fbs").pictures), 0)

    def test_second_signal_ends_at_once_and_leaves_the_part(self):
        running = self.start("encode", "-", "out.fbs")
        self.feed(running, 120)
        self.wait_for(self.part().exists)
        running.send_signal(signal.SIGINT)
        self.wait_for(lambda: self.caught(running) == 0)
        running.send_signal(signal.SIGTERM)
        self.ends_with(running, -signal.SIGTERM)
        self.assertEqual(list(self.files()), ["out.fbs.part"])

    def caught(self, running):
        """Which of SIGINT and SIGTERM the process catches, as a mask."""
        with open(f"/proc/{running.pid}/status", encoding="ascii") as status:
            caught = int(next(line for line in status if line.startswith("SigCgt")).split()[1], 16)
        return caught & (1 << (signal.SIGINT - 1) | 1 << (signal.SIGTERM - 1))

    def test_stop_before_the_first_picture_leaves_nothing(self):
        running = self.start("encode", "-", "out.fbs")
        self.wait_for(lambda: self.caught(running) != 0)
        running.send_signal(signal.SIGINT)
        self.assertIn("nothing written", self.ends_with(running, 130))
        self.assertEqual(self.files(), {})

    def test_killed_encoder_leaves_every_whole_group(self):
        running = self.start("encode", "-", "out.fbs", "--patterns", "1")
        self.feed(running, 100)  # at 30 pictures a second
        self.wait_for(lambda: self.part().exists() and self.shown(self.part()) >= 60)
        running.kill()
        self.ends_with(running, -signal.SIGKILL)
        self.assertEqual(list(self.files()), ["out.fbs.part"])
        done = self.fbs("decode", "out.fbs.part", "-", "--keep-going")
        self.assertEqual(done.returncode, LITTLE_LOST, done.stderr)
        pictures = Y4m(done.stdout).pictures
        self.assertEqual(pictures, self.decoded(TALK_ONE_FBS).pictures[:len(pictures)])

    def shown(self, stream):
        """How many pictures of an unfinished stream can be shown."""
        return len(Y4m(self.fbs("decode", stream, "-", "--keep-going").stdout or b"YUV4MPEG2 W2 H2 F1:1\n").pictures)

    def test_stopped_decoder_leaves_nothing(self):
        for stop, code in STOPS.items():
            for output in ("out.y4m", "out.mkv", "out_%03d.png"):
                running = self.start("decode", "-", output)
                running.stdin.write(TALK_FBS.read_bytes()[:-10])  # and it waits for the rest
                running.stdin.flush()
                self.wait_for(self.files)
                running.send_signal(stop)
                self.assertIn("nothing written", self.ends_with(running, code))
                self.assertEqual(self.files(), {})
