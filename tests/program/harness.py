"""Runs fbs as a user would, and reads its output. Python's standard library only."""
import json
import math
import os
import pathlib
import resource
import signal
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ.get("FBS_SOURCE", pathlib.Path(__file__).resolve().parents[2]))
BUILD = pathlib.Path(os.environ.get("FBS_BUILD", SOURCE / "build/release"))
SHARED = pathlib.Path(os.environ.get("FBS_SHARED") or SOURCE.parent / "shared")
FBS, TALKER = BUILD / "fbs", BUILD / "talker"
MATERIAL = BUILD / "tests/program/material"
TALK_Y4M, TALK_FBS, TALK_ONE_FBS, TALK_TRUTH = (
    MATERIAL / name for name in ("talk.y4m", "talk.fbs", "talk_one.fbs", "talk.csv"))
CLOSE_Y4M, CLOSE_TRUTH = (MATERIAL / name for name in ("close.y4m", "close.csv"))
TWO_SCENES_FBS, KEYED_FBS = (MATERIAL / name for name in ("two_scenes.fbs", "keyed.fbs"))
GREY_FIRST = 7         # pictures before the talker of the two scenes

# Exit codes of fbs: failed; decode --keep-going has lost less than a tenth of the pictures, or more.
FAILED, LITTLE_LOST, MUCH_LOST = 2, 3, 4
MAX_SECONDS = 240      # for any one command


def make_material():
    """A talker of 120 QCIF pictures with its truth and its streams of several patterns and of one, 150 pictures of one who
    is closer and turns more, and two streams of several scenes: grey pictures, then the talker one and a half times; and
    the talker with a scene every half second."""
    MATERIAL.mkdir(parents=True, exist_ok=True)
    talker(TALK_Y4M, "--size", "176x144", "--frames", "120", "--truth", TALK_TRUTH)
    talker(CLOSE_Y4M, "--size", "176x144", "--frames", "150", "--eye-distance", "0.2", "--noise", "2", "--seed", "5",
           "--yaw", "20", "--pitch", "12", "--roll", "10", "--scale", "0.15", "--truth", CLOSE_TRUTH)
    subprocess.run([FBS, "encode", TALK_Y4M, TALK_FBS, "--quiet"], check=True)
    subprocess.run([FBS, "encode", TALK_Y4M, TALK_ONE_FBS, "--quiet", "--patterns", "1"], check=True)
    subprocess.run([FBS, "encode", TALK_Y4M, KEYED_FBS, "--quiet", "--key-interval", "0.5"], check=True)
    grey = flat_y4m(176, 144, GREY_FIRST).partition(b"\n")[2]
    head, _, talk = TALK_Y4M.read_bytes().partition(b"\n")
    subprocess.run([FBS, "encode", "-", TWO_SCENES_FBS, "--quiet", "--patterns", "1"], check=True,
                   input=head + b"\n" + grey + talk + talk[:len(talk) // 2])


def talker(*arguments):
    subprocess.run([TALKER, *arguments], check=True, timeout=MAX_SECONDS)


def ffmpeg(*arguments):
    subprocess.run(["ffmpeg", "-v", "error", "-nostdin", "-y", *arguments], check=True, timeout=MAX_SECONDS)


def ffprobe(path, entries, *options):
    """The JSON that ffprobe prints about the video stream of `path`."""
    done = subprocess.run(["ffprobe", "-v", "error", "-select_streams", "v", "-show_entries", entries, "-of", "json",
                           *options, path], check=True, capture_output=True, timeout=MAX_SECONDS)
    return json.loads(done.stdout)


class Y4m:
    """A Y4M stream in memory: header line, size, rate, and pictures as bytes of all planes. 8 bits, 4:2:0."""

    def __init__(self, data):
        head, _, rest = data.partition(b"\n")
        tags = {tag[:1].decode(): tag[1:].decode() for tag in head.split(b" ")[1:]}
        self.width, self.height = int(tags["W"]), int(tags["H"])
        numerator, denominator = map(int, tags["F"].split(":"))
        self.rate = numerator / denominator
        self.header = head + b"\n"
        size = self.width * self.height + 2 * ((self.width + 1) // 2) * ((self.height + 1) // 2)
        step = len(b"FRAME\n") + size
        assert head.startswith(b"YUV4MPEG2 ") and len(rest) % step == 0, "not whole pictures"
        self.pictures = [rest[at + len(b"FRAME\n"):at + step] for at in range(0, len(rest), step)]

    @property
    def shape(self):
        return self.width, self.height, len(self.pictures), round(self.rate, 3)

    def luma_psnr(self, other, box=None):
        """PSNR in dB of the luma of all pictures against another's, in box = left, top, right, bottom."""
        left, top, right, bottom = box or (0, 0, self.width, self.height)
        error = count = 0
        for a, b in zip(self.pictures, other.pictures, strict=True):
            for y in range(top, bottom):
                row = slice(y * self.width + left, y * self.width + right)
                error += sum((p - q) ** 2 for p, q in zip(a[row], b[row]))
                count += right - left
        return 10 * math.log10(255 ** 2 * count / max(error, 1e-6))


def read_y4m(path):
    return Y4m(pathlib.Path(path).read_bytes())


def flat_y4m(width, height, pictures, luma=lambda x, y: 128):
    """Bytes of a grey video without a face."""
    plane = bytes(luma(x, y) & 255 for y in range(height) for x in range(width))
    chroma = bytes([128]) * (2 * ((width + 1) // 2) * ((height + 1) // 2))
    return b"YUV4MPEG2 W%d H%d F25:1 Ip C420jpeg\n" % (width, height) + pictures * (b"FRAME\n" + plane + chroma)


def check_size(length):
    """Bytes of the check of a packet with a payload of this length (SPEC 3.1)."""
    return 2 if length < 256 else 3


def packets(stream):
    """(type, begin, end) of each packet of a complete stream (SPEC 3.1), checksum included."""
    at, found = 4, []
    while at < len(stream):
        begin, kind, length, shift = at, stream[at], 0, 0
        at += 1
        while True:
            length |= (stream[at] & 127) << shift
            shift += 7
            at += 1
            if stream[at - 1] < 128:
                break
        at += length + check_size(length)
        found.append((kind, begin, at))
    return found


SETUP, SURROUND, PATTERN, MOTION, END, BLEND, UNIT, RETURN = 1, 3, 4, 5, 6, 7, 11, 13  # packet types


class ProgramTest(unittest.TestCase):
    """Each test runs its programs in a new, empty folder."""

    def setUp(self):
        self.new_folder()

    def new_folder(self):
        temporary = tempfile.TemporaryDirectory(prefix="fbs-test-")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def fbs(self, *arguments, stdin=b"", stdout=subprocess.PIPE, environment=None, largest_file=None):
        """Runs fbs to its end, whatever the outcome. `largest_file`, bytes, simulates a full disk."""
        def limit():
            if largest_file is not None:
                signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
                resource.setrlimit(resource.RLIMIT_FSIZE, (largest_file, largest_file))
        return subprocess.run([FBS, *map(str, arguments)], input=stdin, stdout=stdout, stderr=subprocess.PIPE,
                              cwd=self.folder, timeout=MAX_SECONDS, preexec_fn=limit, env=environment)

    def succeed(self, *arguments, **keywords):
        """Runs fbs, which must exit with 0; returns its standard output."""
        done = self.fbs(*arguments, **keywords)
        self.assertEqual(done.returncode, 0, done.stderr.decode(errors="replace"))
        return done.stdout

    def fail_cleanly(self, *arguments, says=(), **keywords):
        """Runs fbs, which must fail cleanly: exit code 2, one line on standard error that contains the words of `says`,
        nothing on standard output, and no change in the folder."""
        before = self.files()
        done = self.fbs(*arguments, **keywords)
        error = done.stderr.decode(errors="replace")
        self.assertEqual(done.returncode, FAILED, error)
        self.assertRegex(error, r"\Afbs: [^\n]+\n\Z", "not exactly one line")
        self.assertLess(len(error), 300)
        for words in says:
            self.assertIn(words, error)
        self.assertFalse(done.stdout)
        self.assertEqual(self.files(), before, "files were left or changed")

    def files(self):
        return {str(path.relative_to(self.folder)): path.read_bytes()
                for path in sorted(self.folder.rglob("*")) if path.is_file()}

    def write(self, name, data):
        (self.folder / name).write_bytes(data)
        return name

    def decoded(self, stream=TALK_FBS):
        return Y4m(self.succeed("decode", stream, "-"))
