"""Streams with sound that are joined in their middle, or that no encoder writes: times of the sound that are out of all
reason, codecs that this version does not know."""
import json
import sys
from pathlib import Path

from harness import END, LITTLE_LOST, PATTERN, SETUP, packets
from sound_test import SOUND, SOUND_SETUP, STEP, SpokenTalk, lag, read_wave

sys.path.append(str(Path(__file__).parent.parent))
from second_decoder.packets import Checks, crc_of  # noqa: E402

SIGNATURE = b"\x89fbs"
LATE_FRAME = 2 ** 32 - 100
MOST_TIME = 2 ** 53  # 1/90000 s: thousands of years


def varint(number):
    out = bytearray()
    while number > 127:
        out.append(number & 127 | 128)
        number >>= 7
    return bytes(out) + bytes([number])


def read_varint(data):
    """The number, and the bytes after it."""
    size = next(k for k, byte in enumerate(data) if byte < 128) + 1
    return sum((byte & 127) << 7 * k for k, byte in enumerate(data[:size])), data[size:]


def payloads(stream):
    """(type, payload) of each packet."""
    numbers = [(kind, *read_varint(stream[begin + 1:end])) for kind, begin, end in packets(stream)]
    return [(kind, rest[:length]) for kind, length, rest in numbers]


def joined(parts):
    """A stream of packets, with checks that are right (SPEC 3.1)."""
    out, checks = SIGNATURE, Checks()
    for kind, payload in parts:
        packet, crc = bytes([kind]) + varint(len(payload)) + payload, crc_of(len(payload))
        check = checks.of(packet, crc)
        checks.add(kind, payload, check)
        out += packet + check.to_bytes(crc.bits // 8, "big")
    return out


def at_time(setup, time):
    """The payload of a setup packet, for a scene that begins at a later time of the stream."""
    pictures, rest = read_varint(setup[2:])
    return setup[:2] + varint(pictures) + varint(time) + read_varint(rest)[1]


class SoundFaults(SpokenTalk):
    made = {}  # streams by codec

    def stream(self, codec="opus"):
        """A scene begins each second."""
        if codec not in self.made:
            self.source()
            self.succeed("encode", "talk.mkv", "talk.fbs", "--quiet", "--live", "--key-interval", "1", "--sound", codec)
            self.made[codec] = (self.folder / "talk.fbs").read_bytes(), (self.folder / "voice.wav").read_bytes()
        for name, data in zip(("talk.fbs", "voice.wav"), self.made[codec]):
            self.write(name, data)
        return self.made[codec][0]

    def length(self, name):
        rate, samples = read_wave(self.folder / name)
        return len(samples) / rate

    def test_checks_are_those_of_the_encoder(self):
        stream = self.stream()
        self.assertEqual(joined(payloads(stream)), stream)

    def test_joined_in_the_middle_is_in_step(self):
        stream = self.stream()
        scene = [p for p in packets(stream) if p[0] == SETUP][2]
        self.write("joined.fbs", SIGNATURE + stream[scene[1]:])
        seconds = json.loads(self.succeed("inspect", "joined.fbs", "--json"))["seconds"]
        self.assertLess(seconds, 3)
        rate, voice = self.reference()
        expected = rate, voice[int((self.SECONDS - seconds) * rate):]
        for name in ("out.wav", "out.mp4", "out.mkv"):
            self.succeed("decode", "joined.fbs", name, "--quiet")
            heard = read_wave(self.folder / name) if name.endswith("wav") else self.heard(name)
            self.assertAlmostEqual(len(heard[1]) / heard[0], seconds, delta=0.07)
            self.assertLess(abs(lag(expected, heard, 0.2, 1.7)), STEP, name)

    def test_sound_years_after_its_pictures_is_left_out(self):
        for codec in ("opus", "codec2"):
            parts = payloads(self.stream(codec))
            sounds = [k for k, (kind, _) in enumerate(parts) if kind == SOUND]
            kind, payload = parts[sounds[-1]]
            parts[sounds[-1]] = kind, varint(LATE_FRAME) + read_varint(payload)[1]
            self.write("late.fbs", joined(parts))
            for name in ("out.wav", "out.mkv"):
                self.succeed("decode", "late.fbs", name, "--quiet")
            self.assertAlmostEqual(self.length("out.wav"), self.SECONDS, delta=0.001)
            self.assertLess(abs(lag(self.reference(), read_wave(self.folder / "out.wav"), 0.2, 1.7)), STEP)

    def test_years_without_pictures_are_not_filled_with_silence(self):
        for codec, outputs in (("opus", ("out.wav",)), ("codec2", ("out.wav", "out.mp4"))):
            parts = payloads(self.stream(codec))
            scenes = [k for k, (kind, _) in enumerate(parts) if kind == SETUP]
            setup = parts[scenes[2]][1]
            pictures, rest = read_varint(setup[2:])
            _, rest = read_varint(rest)
            parts[scenes[2]] = SETUP, setup[:2] + varint(pictures + 2 ** 40 - 2 ** 20) + varint(MOST_TIME) + rest
            self.write("jump.fbs", joined(parts[:scenes[3]]))
            for name in outputs:
                done = self.fbs("decode", "jump.fbs", name, "--quiet", "--keep-going")
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertRegex(done.stderr.decode(), r"\nfbs: jump.fbs: \d+ hours are missing[^\n]*--from[^\n]*\n\Z")
                self.assertFalse((self.folder / name).exists())

    def test_a_stream_may_begin_at_any_time(self):
        parts = payloads(self.stream())
        scenes = [k for k, (kind, _) in enumerate(parts) if kind == SETUP]
        setup = parts[scenes[2]][1]
        pictures, _ = read_varint(setup[2:])
        self.write("hours.fbs", joined([(SETUP, at_time(setup, pictures * 5_400_000)), *parts[scenes[2] + 1:scenes[3]]]))
        self.fbs("decode", "hours.fbs", "out.wav", "--quiet", "--keep-going")
        self.assertTrue(0.5 < self.length("out.wav") < 1.1)

    def test_a_codec_that_is_not_known_is_left_out(self):
        parts = payloads(self.stream())
        with_other = lambda setup: joined([(kind, setup if kind == SOUND_SETUP else payload) for kind, payload in parts])
        pictures = self.succeed("decode", "talk.fbs", "--md5")
        for setup in (b"\x03what a later version says of it", b"\x02\x01" + varint(700) + varint(1920) + varint(960)):
            self.write("other.fbs", with_other(setup))
            self.assertEqual(self.succeed("decode", "other.fbs", "--md5"), pictures)
            self.fail_cleanly("decode", "other.fbs", "out.wav", says=("other.fbs", "no sound"))
            self.succeed("decode", "other.fbs", "out.mp4", "--quiet")
            self.assertGreater(json.loads(self.succeed("inspect", "other.fbs", "--json"))["bytes"]["sound"], 1000)
            self.fbs("remux", "other.fbs", "other.mkv")
            self.succeed("remux", "other.mkv", "back.fbs")
            self.assertEqual((self.folder / "back.fbs").read_bytes(), (self.folder / "other.fbs").read_bytes())

    def test_a_setup_that_is_wrong_is_named(self):
        parts = payloads(self.stream())
        for setup in (b"", b"\x00", b"\x01\x03\x00\xc0\x07\x00", b"\x01\x01\x00\xc1\x07\x00"):
            self.write("wrong.fbs", joined([(kind, setup if kind == SOUND_SETUP else payload) for kind, payload in parts]))
            self.fail_cleanly("decode", "wrong.fbs", "out.mp4", says=("wrong.fbs", "sound", "at byte"))
            done = self.fbs("decode", "wrong.fbs", "out.y4m", "--quiet", "--keep-going")
            self.assertEqual(done.returncode, LITTLE_LOST, done.stderr)

    def test_a_cut_stream_goes_into_matroska_and_back(self):
        stream = self.stream()
        for size in (len(stream) // 5, len(stream) // 2, len(stream) - 3):
            self.write("cut.fbs", stream[:size])
            self.succeed("remux", "cut.fbs", "cut.mkv")
            self.succeed("remux", "cut.mkv", "back.fbs")
            self.assertEqual((self.folder / "back.fbs").read_bytes(), stream[:size])


if __name__ == "__main__":
    import unittest
    unittest.main()
