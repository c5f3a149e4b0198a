"""Sound beside the pictures: encode, decode, inspect."""
import array
import json
import math
import random
import struct
import subprocess

from harness import LITTLE_LOST, MUCH_LOST, TALK_FBS, TALK_Y4M, ProgramTest, ffmpeg, ffprobe, packets, talker

SOUND_SETUP, SOUND = 9, 10
STEP = 0.02  # seconds: pictures and sound are in step


def voice(seconds, rate):
    """Syllables of 80 to 200 ms at places that do not repeat: noise with formants, so that each place is known again."""
    out, source = array.array("h", bytes(2 * int(seconds * rate))), random.Random(1)
    at = 0.1
    while at < seconds - 0.3:
        length, pitch = source.uniform(0.08, 0.2), source.uniform(100, 160)
        for n in range(int(length * rate)):
            t = n / rate
            envelope = math.sin(math.pi * t / length)
            sample = sum(math.sin(2 * math.pi * pitch * k * t) / k for k in range(1, 12))
            out[int(at * rate) + n] = int(5000 * envelope * sample)
        at += length + source.uniform(0.05, 0.25)
    return out


def write_wave(path, samples, rate, channels=1):
    data = samples.tobytes()
    path.write_bytes(b"RIFF" + struct.pack("<I", 36 + len(data)) + b"WAVEfmt " +
                     struct.pack("<IHHIIHH", 16, 1, channels, rate, rate * 2 * channels, 2 * channels, 16) + b"data" +
                     struct.pack("<I", len(data)) + data)


def read_wave(path):
    """Rate and samples of a mono file."""
    data = path.read_bytes()
    at = data.index(b"data") + 8
    return struct.unpack_from("<I", data, 24)[0], array.array("h", data[at:at + (len(data) - at) // 2 * 2])


def level(samples, rate, step):
    """dB below the loudest place, down to -40: each step, over ten steps. Rises and falls of a syllable count, not how loud a
    codec makes it, which differs by codec and by pitch: lags by loudness itself are wrong by up to 25 ms for Codec 2."""
    hop, size = int(rate * step), int(rate * step) * 10
    padded = array.array("h", bytes(size)) + samples + array.array("h", bytes(size))
    sums = [sum(x * x for x in padded[k:k + hop]) for k in range(0, len(padded) - hop + 1, hop)]
    energy = [sum(sums[k:k + 10]) for k in range(len(sums) - 10)]
    most = max(energy) + 1
    return [max(10 * math.log10(value / most + 1e-9), -40) for value in energy]


def lag(reference, heard, begin, end, most=0.1, step=0.002):
    """Seconds by which what is heard between two times comes late: where the levels of both agree best."""
    a = level(*reversed(reference), step)[int(begin / step):int(end / step)]
    b = level(*reversed(heard), step)
    mean = sum(a) / len(a)
    a = [value - mean for value in a]
    reach, first = int(most / step), int(begin / step)

    def agreement(shift):
        pairs = [(x, b[first + k + shift]) for k, x in enumerate(a) if 0 <= first + k + shift < len(b)]
        mean = sum(y for _, y in pairs) / len(pairs)
        spread = sum(x * x for x, _ in pairs) * sum((y - mean) ** 2 for _, y in pairs)
        return sum(x * (y - mean) for x, y in pairs) / math.sqrt(spread + 1e-9)
    return step * max(range(-reach, reach + 1), key=agreement)


class SpokenTalk(ProgramTest):
    """The talker with a voice."""
    SECONDS = 4.0  # of TALK_Y4M: 120 pictures at 30/s

    def source(self, name="talk.mkv", *options, rate=48000, delay=0.0, frames_per_second=None):
        """The talker with a voice; the voice as it should be heard."""
        if not (self.folder / "voice.wav").exists():
            write_wave(self.folder / "voice.wav", voice(self.SECONDS, 48000), 48000)
        pictures = ["-r", frames_per_second, "-i", TALK_Y4M] if frames_per_second else ["-i", TALK_Y4M]
        ffmpeg(*pictures, "-itsoffset", str(delay), "-i", self.folder / "voice.wav", "-map", "0:v", "-map", "1:a", "-c:v",
               "libx264", "-qp", "10", "-c:a", "pcm_s16le", "-ar", str(rate), *options, self.folder / name)
        return name

    def reference(self):
        return read_wave(self.folder / "voice.wav")

    def bytes_of(self, stream):
        return json.loads(self.succeed("inspect", stream, "--json"))["bytes"]

    def heard(self, name):
        """Of a container, as ffmpeg decodes it, from the first picture on."""
        ffmpeg("-i", self.folder / name, "-vn", "-ac", "1", self.folder / "heard.wav")
        rate, samples = read_wave(self.folder / "heard.wav")
        begin = float(subprocess.run(["ffprobe", "-v", "error", "-select_streams", "a", "-show_entries", "stream=start_time",
                                      "-of", "csv=p=0", self.folder / name], check=True, capture_output=True).stdout)
        return rate, array.array("h", bytes(2 * int(max(begin, 0) * rate))) + samples

    def assert_in_step(self, heard, end=None):
        end = end or self.SECONDS
        for begin in (0, end / 2 - 0.75, end - 1.5):
            self.assertLess(abs(lag(self.reference(), heard, begin, begin + 1.5)), STEP, begin)


class Sound(SpokenTalk):
    def test_comes_along_and_back_in_step(self):
        self.source()
        self.succeed("encode", "talk.mkv", "talk.fbs", "--quiet")
        size = self.bytes_of("talk.fbs")
        self.assertEqual(size["total"], sum(size[part] for part in ("geometry", "patterns", "motion", "sound", "other")))
        self.assertTrue(2000 < size["sound"] < 8000, size)
        self.succeed("decode", "talk.fbs", "talk.wav", "--quiet")
        rate, samples = read_wave(self.folder / "talk.wav")
        self.assertEqual((rate, len(samples)), (48000, int(48000 * self.SECONDS)))
        self.assert_in_step((rate, samples))
        for name in ("out.mp4", "out.mkv"):
            self.succeed("decode", "talk.fbs", name, "--quiet")
            self.assert_in_step(self.heard(name))

    def test_codec2_takes_a_fraction(self):
        self.source()
        self.succeed("encode", "talk.mkv", "talk.fbs", "--quiet", "--sound", "codec2", "--sound-bitrate", "1.2")
        size = self.bytes_of("talk.fbs")
        self.assertLess(size["sound"], self.SECONDS * 1200 / 8 * 1.15)
        self.succeed("decode", "talk.fbs", "talk.wav", "--quiet")
        heard = read_wave(self.folder / "talk.wav")
        self.assertEqual((heard[0], len(heard[1])), (8000, int(8000 * self.SECONDS)))
        self.succeed("decode", "talk.fbs", "out.mp4", "--quiet")
        for sound in (heard, self.heard("out.mp4")):
            self.assert_in_step(sound)

    def test_pictures_are_the_same(self):
        self.source()
        for name, option in (("with.fbs", ()), ("without.fbs", ("--no-sound",))):
            self.succeed("encode", "talk.mkv", name, "--quiet", *option)
        self.assertEqual(self.bytes_of("without.fbs")["sound"], 0)
        self.assertEqual(self.decoded("with.fbs").pictures, self.decoded("without.fbs").pictures)

    def test_each_part_comes_before_its_pictures(self):
        """So a stream that is cut off has the sound of the pictures that it has."""
        self.source()
        self.succeed("encode", "talk.mkv", "talk.fbs", "--quiet", "--key-interval", "1")
        stream = (self.folder / "talk.fbs").read_bytes()
        kinds = [kind for kind, _, _ in packets(stream)]
        self.assertEqual(kinds[1], SOUND_SETUP)
        self.assertEqual(kinds.count(SOUND_SETUP), kinds.count(1), "one in each scene")
        setups = [begin for kind, begin, _ in packets(stream) if kind == 1]
        self.write("cut.fbs", stream[:setups[2]])
        self.assertEqual(self.fbs("decode", "cut.fbs", "cut.wav", "--quiet", "--keep-going").returncode, LITTLE_LOST)
        rate, samples = read_wave(self.folder / "cut.wav")
        shown = self.succeed("inspect", "cut.fbs", "--json")
        self.assertAlmostEqual(len(samples) / rate, json.loads(shown)["seconds"], delta=0.001)
        self.assert_in_step((rate, samples), end=len(samples) / rate)

    def test_from_the_middle(self):
        self.source()
        self.succeed("encode", "talk.mkv", "talk.fbs", "--quiet", "--key-interval", "1")
        rate, reference = self.reference()
        for name in ("part.wav", "part.mp4"):
            self.succeed("decode", "talk.fbs", name, "--quiet", "--from", "2")
            heard = read_wave(self.folder / name) if name.endswith("wav") else self.heard(name)
            self.assertLess(abs(lag((rate, reference[2 * rate:]), heard, 0, 2)), STEP)

    def test_joined_in_the_middle(self):
        """A stream that lacks its first scenes begins at once, with the sound of the pictures that it has."""
        self.source()
        self.succeed("encode", "talk.mkv", "talk.fbs", "--quiet", "--key-interval", "1")
        stream = (self.folder / "talk.fbs").read_bytes()
        setups = [begin for kind, begin, _ in packets(stream) if kind == 1]
        self.write("joined.fbs", stream[:4] + stream[setups[1]:])
        seconds = json.loads(self.succeed("inspect", "joined.fbs", "--json"))["seconds"]
        self.assertLess(seconds, self.SECONDS - 0.5)
        rate, reference = self.reference()
        reference = reference[-int(seconds * rate):]
        for name in ("joined.wav", "joined.mkv"):
            self.succeed("decode", "joined.fbs", name, "--quiet")
            heard = read_wave(self.folder / name) if name.endswith("wav") else self.heard(name)
            self.assertAlmostEqual(len(heard[1]) / heard[0], seconds, delta=0.1)
            self.assertLess(abs(lag((rate, reference), heard, 0.1, seconds - 0.5)), STEP, name)

    def test_sound_that_begins_later_or_earlier(self):
        rate, reference = self.reference() if (self.folder / "voice.wav").exists() else (48000, voice(self.SECONDS, 48000))
        for delay in (0.5, -0.5):
            self.source("moved.mkv", delay=delay)
            self.succeed("encode", "moved.mkv", "moved.fbs", "--quiet")
            self.succeed("decode", "moved.fbs", "moved.wav", "--quiet")
            expected = array.array("h", bytes(2 * int(max(delay, 0) * rate))) + reference[int(max(-delay, 0) * rate):]
            heard = read_wave(self.folder / "moved.wav")
            self.assertEqual(len(heard[1]), int(rate * self.SECONDS), "silence to the end of the pictures")
            self.assertLess(abs(lag((rate, expected), heard, 1, 3)), STEP, delay)

    def test_rates_of_pictures_and_sound(self):
        for frames_per_second, sound_rate in (("30000/1001", 44100), ("24000/1001", 11025), ("50", 96000), ("25", 12345)):
            name = self.source("rate.mkv", rate=sound_rate, frames_per_second=frames_per_second)
            self.succeed("encode", name, "rate.fbs", "--quiet", "--frames", "70")
            self.succeed("decode", "rate.fbs", "rate.wav", "--quiet")
            heard = read_wave(self.folder / "rate.wav")
            seconds = 70 / eval(frames_per_second)  # noqa: a fraction of ours
            self.assertAlmostEqual(len(heard[1]) / heard[0], seconds, delta=0.005)
            self.assertLess(abs(lag(self.reference(), heard, seconds - 1, seconds)), STEP, frames_per_second)

    def test_the_bitrate_is_the_total(self):
        self.source()
        for options, rate in (((), 12), ((), 5), (("--sound", "codec2"), 15)):
            done = self.fbs("encode", "talk.mkv", "talk.fbs", "--bitrate", rate, "--quiet", *options)
            self.assertEqual((done.returncode, done.stderr), (0, b""))
            total = self.bytes_of("talk.fbs")["total"] * 8 / self.SECONDS / 1000
            self.assertTrue(0.9 * rate < total < 1.1 * rate, (rate, total))

    def test_tracks(self):
        self.source()
        ffmpeg("-i", self.folder / "talk.mkv", "-f", "lavfi", "-i", "sine=frequency=440:duration=4", "-map", "0:v", "-map",
               "1:a", "-map", "0:a", "-c:v", "copy", "-c:a", "pcm_s16le", self.folder / "two.mkv")
        self.succeed("encode", "two.mkv", "two.fbs", "--quiet", "--track", "1")
        self.succeed("decode", "two.fbs", "two.wav", "--quiet")
        self.assert_in_step(read_wave(self.folder / "two.wav"))
        self.fail_cleanly("encode", "two.mkv", "no.fbs", "--track", "2", says=("two.mkv", "2"))

    def test_longer_and_shorter_than_the_pictures(self):
        for seconds in (1.5, 6.0):
            write_wave(self.folder / "other.wav", voice(seconds, 48000), 48000)
            ffmpeg("-i", TALK_Y4M, "-i", self.folder / "other.wav", "-map", "0:v", "-map", "1:a", "-c:v", "libx264", "-qp", "10",
                   "-c:a", "pcm_s16le", self.folder / "other.mkv")
            self.succeed("encode", "other.mkv", "other.fbs", "--quiet")
            self.succeed("decode", "other.fbs", "other_out.wav", "--quiet")
            rate, samples = read_wave(self.folder / "other_out.wav")
            self.assertEqual(len(samples), int(rate * self.SECONDS))
            end = min(seconds, self.SECONDS)
            self.assertLess(abs(lag(read_wave(self.folder / "other.wav"), (rate, samples), end - 1.3, end)), STEP)
            self.assertLess(max(map(abs, samples[int((seconds + 0.1) * rate):]), default=0), 40, "silence behind it")
            self.succeed("decode", "other.fbs", "out.mp4", "--quiet")
            self.assertLess(len(self.heard("out.mp4")[1]) / 48000, self.SECONDS + 0.07)

    def test_several_channels_become_one(self):
        for channels in (2, 6):
            name = self.source("wide.mkv", "-ac", str(channels))
            self.succeed("encode", name, "wide.fbs", "--quiet", "--patterns", "1")
            self.succeed("decode", "wide.fbs", "wide.wav", "--quiet")
            self.assert_in_step(read_wave(self.folder / "wide.wav"))

    def test_a_source_without_sound_makes_a_stream_without(self):
        self.succeed("encode", TALK_Y4M, "silent.fbs", "--quiet", "--patterns", "1")
        ffmpeg("-i", TALK_Y4M, "-c:v", "ffv1", self.folder / "silent.mkv")
        self.succeed("encode", "silent.mkv", "silent2.fbs", "--quiet", "--patterns", "1")
        for name in ("silent.fbs", "silent2.fbs"):
            self.assertEqual(self.bytes_of(name)["sound"], 0)
            self.succeed("decode", name, "silent.mp4", "--quiet")
        self.fail_cleanly("encode", "silent.mkv", "no.fbs", "--sound", "opus", says=("silent.mkv", "no sound"))

    def test_evaluate_counts_it_as_its_own_part(self):
        self.source()
        self.succeed("encode", "talk.mkv", "with.fbs", "--quiet", "--patterns", "1")
        self.succeed("encode", "talk.mkv", "without.fbs", "--quiet", "--patterns", "1", "--no-sound")
        table = self.succeed("evaluate", "talk.mkv", "with.fbs", "without.fbs", "--json", "--quiet")
        with_sound, without = json.loads(table)["points"]
        self.assertAlmostEqual(with_sound["kbps"], without["kbps"], delta=0.01)
        self.assertAlmostEqual(with_sound["sound_kbps"], 8e-3 * with_sound["bytes"]["sound"] / self.SECONDS, delta=0.01)
        self.assertGreater(with_sound["sound_kbps"], 4)
        self.assertNotIn("sound_kbps", without)
        shown = self.succeed("evaluate", "talk.mkv", "with.fbs", "--quiet").decode()
        self.assertIn(f"sound beside the pictures: {with_sound['bytes']['sound']} bytes", shown)

    def test_damaged_sound_does_no_harm_to_pictures(self):
        self.source()
        self.succeed("encode", "talk.mkv", "talk.fbs", "--quiet", "--key-interval", "1")
        stream = bytearray((self.folder / "talk.fbs").read_bytes())
        begin = [begin for kind, begin, _ in packets(bytes(stream)) if kind == SOUND][3]
        stream[begin + 10] ^= 255  # its check is wrong: the rest of its scene is lost
        self.write("broken.fbs", bytes(stream))
        done = self.fbs("decode", "broken.fbs", "broken.wav", "--keep-going", "--quiet")
        self.assertIn(done.returncode, (LITTLE_LOST, MUCH_LOST))
        rate, samples = read_wave(self.folder / "broken.wav")
        self.assertEqual(len(samples), int(48000 * self.SECONDS))
        self.assertLess(abs(lag(self.reference(), (rate, samples), 3.1, 4.0)), STEP, "behind the damage")

    def test_bad_input(self):
        self.source()
        self.succeed("encode", "talk.mkv", "talk.fbs", "--quiet")
        for arguments, says in (
                (("encode", TALK_Y4M, "out.fbs", "--sound", "opus"), ("--sound", "no sound")),
                (("encode", TALK_Y4M, "out.fbs", "--track", "0"), ("no sound",)),
                (("encode", "talk.mkv", "out.fbs", "--sound", "opus", "--sound-bitrate", "3"), ("opus", "6 to 64")),
                (("encode", "talk.mkv", "out.fbs", "--sound-bitrate", "5"), ("codec2", "3.2")),
                (("encode", "talk.mkv", "out.fbs", "--sound", "codec2", "--sound-bitrate", "12"), ("codec2", "3.2")),
                (("encode", "talk.mkv", "out.fbs", "--no-sound", "--sound", "opus"), ("--no-sound",)),
                (("encode", "talk.mkv", "out.fbs", "--bitrate", "1"), ("--bitrate", "--no-sound")),
                (("encode", "talk.mkv", "out.fbs", "--bitrate", "5", "--sound", "opus"), ("--bitrate", "codec2")),
                (("decode", "talk.fbs", "out.wav", "--md5"), ("--md5", ".wav")),
                (("decode", "talk.fbs", "out.wav", "--sound", "talk.mkv"), ("--sound", ".wav")),
                (("decode", TALK_FBS, "out.wav"), ("no sound",)),
                (("decode", "talk.fbs", "out.y4m", "--no-sound"), ("--no-sound",)),
                (("decode", "talk.fbs", "out.mp4", "--no-sound", "--sound", "talk.mkv"), ("--no-sound",))):
            with self.subTest(arguments=arguments):
                self.fail_cleanly(*arguments, says=says)


class LongTalk(ProgramTest):
    def test_does_not_drift(self):
        """A frame rate whose nominal duration is a rounded one: 1501.5 ticks."""
        seconds, rate = 60, 48000
        talker(self.folder / "still.y4m", "--size", "128x96", "--frames", "60", "--still")
        clicks = array.array("h", bytes(2 * seconds * rate))
        for second in range(seconds):
            for n in range(rate // 20):
                clicks[second * rate + n] = int(12000 * math.sin(2 * math.pi * 500 * n / rate))
        write_wave(self.folder / "clicks.wav", clicks, rate)
        ffmpeg("-stream_loop", "-1", "-r", "60000/1001", "-i", self.folder / "still.y4m", "-i", self.folder / "clicks.wav",
               "-shortest", "-c:v", "libx264", "-qp", "20", "-c:a", "pcm_s16le", "-t", str(seconds), self.folder / "long.mov")
        self.succeed("encode", "long.mov", "long.fbs", "--quiet", "--patterns", "1")
        shown = json.loads(self.succeed("inspect", "long.fbs", "--json"))
        self.assertAlmostEqual(shown["seconds"], shown["frames"] * 1001 / 60000, delta=0.006)
        self.succeed("decode", "long.fbs", "long.wav", "--quiet")
        self.assertLess(abs(lag((rate, clicks), read_wave(self.folder / "long.wav"), seconds - 3, seconds - 1)), STEP)
        self.succeed("decode", "long.fbs", "long.mp4", "--quiet")
        times = [float(packet["pts_time"]) for packet in ffprobe(self.folder / "long.mp4", "packet=pts_time")["packets"]]
        self.assertAlmostEqual(max(times) - min(times), (shown["frames"] - 1) * 1001 / 60000, delta=0.002)


if __name__ == "__main__":
    import unittest
    unittest.main()
