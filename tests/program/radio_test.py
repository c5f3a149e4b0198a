"""samples/radio: a stream comes through a radio that flips bits and loses frames."""
import re
import subprocess
import unittest
import wave

from harness import BUILD, KEYED_FBS, MAX_SECONDS, TALK_Y4M, ProgramTest, ffmpeg
from speech import RATE, bursts

RADIO = BUILD / "radio"
FEND = b"\xc0"
BARE = ("--parity", 0, "--spare", 0)  # no code
PICTURES = 120                        # of the talker


@unittest.skipUnless(RADIO.exists(), "the sample was not built: no libfec")
class Radio(ProgramTest):
    def radio(self, verb, stdin, *options):
        """What it writes, and the numbers that it reports."""
        done = subprocess.run([RADIO, verb, *map(str, options)], input=stdin, capture_output=True, cwd=self.folder,
                              timeout=MAX_SECONDS)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout, [float(number) for number in re.findall(r"\d+\.?\d*", done.stderr.decode())]

    def received(self, stream, channel, *layout):
        """The stream behind the radio, and how many bits the channel flipped and frames it dropped."""
        air, (dropped, _, wrong) = self.radio("channel", self.radio("send", stream, *layout)[0], *channel)
        return self.radio("receive", air, *layout)[0], wrong, dropped

    def shown(self, sent, received):
        """Packets lost, and shares of pictures: exact, concealed, frozen; in percent."""
        self.write("sent.fbs", sent)
        self.write("received.fbs", received)
        report = self.radio("compare", b"", "sent.fbs", "received.fbs")[0].decode()
        whole, all_of_them = map(int, re.search(r"packets: (\d+) of (\d+)", report).groups())
        shares = re.search(r"([\d.]+) % of \d+ exact, ([\d.]+) % concealed, ([\d.]+) % frozen", report).groups()
        return all_of_them - whole, *map(float, shares)

    def live(self, source=TALK_Y4M, *options):
        self.succeed("encode", source, "live.fbs", "--live", "--resilience", "strong", "--quiet", *options)
        return (self.folder / "live.fbs").read_bytes()

    def test_a_clean_channel_gives_the_same_bytes(self):
        stream = KEYED_FBS.read_bytes()
        for layout in ((), BARE, ("--spare", 0), ("--frame", 40, "--group", 3, "--spare", 2), ("--frame", 255, "--parity", 32)):
            for size in (1, 66, 67, 68, 3000, len(stream)):  # frames and groups that are full, and that are not
                self.assertEqual(self.received(stream[:size], ("--bit-errors", 0), *layout)[0], stream[:size], (layout, size))
        self.assertEqual(self.shown(stream, stream), (0, 100, 0, 0))

    def test_frames_are_those_of_kiss(self):
        air, report = self.radio("send", KEYED_FBS.read_bytes(), "--frame", 60)
        frames = air.split(FEND)
        self.assertEqual((frames[0], frames[-1]), (b"", b""))
        for frame in frames[1:-1]:
            self.assertEqual(frame[0], 0)
            self.assertEqual(len(frame) - frame.count(b"\xdb"), 1 + 60)
        self.assertIn(len(air) - 1, report)  # without the first FEND
        self.assertIn(len(frames) - 2, report)

    def test_the_code_repairs_wrong_bits(self):
        stream = KEYED_FBS.read_bytes()
        for seed in range(20):
            received, wrong, _ = self.received(stream, ("--bit-errors", 1e-4, "--seed", seed))
            self.assertGreater(wrong, 0)
            self.assertEqual(received, stream, f"seed {seed}")

    def test_spare_frames_replace_lost_ones(self):
        stream = KEYED_FBS.read_bytes()
        frames = self.radio("send", stream)[0].split(FEND)[1:-1]
        for first in range(0, len(frames) - 4, 3):  # of four that follow one another, in one group or two
            left = frames[:first] + frames[first + 4:]
            air = FEND + b"".join(frame + FEND for frame in left)
            self.assertEqual(self.radio("receive", air)[0], stream, f"without frames {first} to {first + 3}")

    def test_a_byte_that_becomes_fend_and_a_fend_that_is_hit_cost_no_frame(self):
        stream = KEYED_FBS.read_bytes()
        air = self.radio("send", stream, "--spare", 0)[0]
        for at in (*range(0, len(air), 41), len(air) - 1):
            if air[at - 1:at] not in (FEND, b"\xdb") and air[at] != 0xDB:  # a command or an escape costs its frame
                value = 0xC1 if air[at] == 0xC0 else 0xC0
                hit = air[:at] + bytes([value]) + air[at + 1:]
                self.assertEqual(self.radio("receive", hit, "--spare", 0)[0], stream, f"byte {at}")

    def test_without_the_code_damage_stays_local(self):
        stream = KEYED_FBS.read_bytes()
        total, damaged, lossy = 0, 0, 0
        for seed in range(12):
            received, _, _ = self.received(stream, ("--bit-errors", 1e-4, "--seed", seed), *BARE)
            lost, exact, concealed, frozen = self.shown(stream, received)
            self.assertLess(frozen, 55, f"seed {seed}: more than two of four scenes")
            damaged += received != stream
            lossy += lost > 0
            total += exact + concealed
        self.assertGreater(damaged, lossy, "a packet's check sets one wrong bit right")
        self.assertGreater(lossy, 4)
        self.assertGreater(total / 12, 80)

    def test_a_lost_frame_behind_the_head_freezes_nothing_of_a_strong_stream(self):
        stream = self.live()
        frames = self.radio("send", stream, *BARE)[0].split(FEND)[1:-1]
        for gone in (len(frames) * 2 // 3, len(frames) * 3 // 4):
            air = FEND + b"".join(frame + FEND for i, frame in enumerate(frames) if i != gone)
            lost, exact, concealed, frozen = self.shown(stream, self.radio("receive", air, *BARE)[0])
            self.assertGreater(lost, 0)
            self.assertEqual(frozen, 0)
            self.assertGreater(exact, 30)
            self.assertGreater(concealed, 0)

    def test_frames_beyond_repair_are_passed_on(self):
        stream = KEYED_FBS.read_bytes()
        received = self.received(stream, ("--bit-errors", 2e-2, "--seed", 1), "--spare", 0)[0]
        self.assertGreater(sum(a == b for a, b in zip(received, stream)), len(stream) // 4)
        self.assertNotEqual(received, stream)

    def test_the_voice_comes_through(self):
        with wave.open(str(self.folder / "voice.wav"), "wb") as out:
            out.setparams((1, 2, RATE, 0, "NONE", ""))
            out.writeframes(bursts(4, 5).tobytes())
        ffmpeg("-i", TALK_Y4M, "-i", self.folder / "voice.wav", "-c:v", "libx264", "-crf", "10", "-c:a", "pcm_s16le",
               self.folder / "talk.mkv")
        stream = self.live("talk.mkv", "--sound", "codec2", "--sound-bitrate", "1.2")
        received, wrong, dropped = self.received(stream, ("--bit-errors", 1e-4, "--drop", 3, "--seed", 2))
        self.assertGreater(wrong, 0)
        self.assertGreater(dropped, 0)
        self.assertEqual(received, stream)
        self.write("received.fbs", received)
        report = self.radio("compare", b"", "live.fbs", "received.fbs")[0].decode()
        sound, all_of_it = map(int, re.search(r"(\d+) of (\d+) of the sound", report).groups())
        self.assertGreater(all_of_it, 4)
        self.assertEqual(sound, all_of_it)

    def test_what_makes_no_sense_is_refused(self):
        for arguments in ((), ("send", "--frame", 39), ("send", "--frame", 40.5), ("send", "--frame"), ("glue",),
                          ("send", "--group", 16), ("send", "--parity", "x"), ("send", "--parity", 0),
                          ("channel", "--bit-errors", 0.6), ("channel", "--drop", "nan"), ("compare", "a.fbs")):
            done = subprocess.run([RADIO, *map(str, arguments)], input=b"", capture_output=True, timeout=MAX_SECONDS)
            self.assertEqual((done.returncode, done.stdout), (2, b""), arguments)
            self.assertRegex(done.stderr.decode(), "^(usage|radio): ")
        done = subprocess.run([RADIO, "compare", "no.fbs", "no.fbs"], capture_output=True, timeout=MAX_SECONDS, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn(b"no.fbs", done.stderr)
