"""What networks and disks do to a stream, and what a viewer sees of what is left."""
import bisect
import hashlib
import json
import operator
import re
import subprocess

from harness import FBS, MAX_SECONDS, Y4m, packets


def random_loss(count, rate, random):
    """For each of `count` packets whether it is lost, each with the same probability."""
    return [random.random() < rate for _ in range(count)]


def burst_loss(count, rate, random, mean_burst=3):
    """The same in bursts: a Gilbert-Elliott channel that loses every packet in its bad state and none in its good one."""
    recovers = 1 / mean_burst
    fails = min(recovers * rate / (1 - rate), 1)  # so that it is bad for `rate` of the time
    bad, lost = random.random() < rate, []
    for _ in range(count):
        lost.append(bad)
        bad = random.random() >= recovers if bad else random.random() < fails
    return lost


def without(stream, lost):
    """The stream without its lost packets; the signature is never lost."""
    kept = (stream[begin:end] for (_, begin, end), gone in zip(packets(stream), lost, strict=True) if not gone)
    return stream[:4] + b"".join(kept)


def with_flipped_bits(stream, *bits):
    flipped = bytearray(stream)
    for bit in bits:
        flipped[bit // 8] ^= 1 << bit % 8
    return bytes(flipped)


def decode(stream):
    """Everything that fbs can decode of a stream, or None; and its exit code."""
    done = subprocess.run([FBS, "decode", "-", "-", "--keep-going", "--quiet"], input=stream, capture_output=True,
                          timeout=MAX_SECONDS)
    return Y4m(done.stdout) if done.stdout else None, done.returncode


def digest_of(picture):
    return hashlib.blake2b(picture, digest_size=16).digest()


class Whole:
    """An undamaged stream: its packets, its pictures, and the numbers of those that begin scenes."""

    def __init__(self, path):
        self.stream = path.read_bytes()
        self.packets = packets(self.stream)
        video, _ = decode(self.stream)
        self.video, self.pictures, self.rate = video, video.pictures, video.rate
        self.digests = [digest_of(picture) for picture in self.pictures]
        inspected = subprocess.run([FBS, "inspect", path, "--json"], check=True, capture_output=True)
        self.scenes = [scene["picture"] for scene in json.loads(inspected.stdout)["scenes"]]
        luma = video.width * video.height
        self.black = bytes([16]) * luma + bytes([128]) * (len(self.pictures[0]) - luma)

    def seen(self, stream):
        """What a viewer sees of this stream once it is damaged."""
        return Viewing(self, *decode(stream))

    def scene_of(self, picture):
        """Number of the scene that has a picture."""
        return bisect.bisect(self.scenes, picture) - 1


class Viewing:
    """What is on the screen at the time of each picture: that picture, or an earlier one that is held. Before the first
    scene that arrives the screen is black, and at the end the last picture stays."""

    def __init__(self, whole, video, exit_code):
        self.exit_code = exit_code
        self.video = video
        self.decoded = decoded = video.pictures if video else []
        # The first of them begins a scene, though it may not be right: the stream says its time, the Y4M does not.
        digests = [digest_of(picture) for picture in decoded]
        self.black = max((scene for scene in whole.scenes if scene + len(decoded) <= len(whole.pictures)),
                         key=lambda scene: sum(map(operator.eq, whole.digests[scene:], digests)),
                         default=0) if decoded else len(whole.pictures)
        stays = len(whole.pictures) - self.black - len(decoded)
        self.pictures = [whole.black] * self.black + decoded + decoded[-1:] * stays
        self.digests = [digest_of(picture) for picture in self.pictures]
        self.right = [a == b for a, b in zip(self.digests, whole.digests, strict=True)]

    @property
    def share_right(self):
        return sum(self.right) / len(self.right)

    def gaps(self):
        """(first, end) of each run of pictures that are not right."""
        edges = [i for i in range(1, len(self.right)) if self.right[i] != self.right[i - 1]]
        runs = zip([0, *edges], [*edges, len(self.right)])
        return [(first, end) for first, end in runs if not self.right[first]]


def luma_psnr(pictures, source):
    """PSNR in dB of the luma of all pictures, by ffmpeg.
    @param source  path of a Y4M of as many pictures"""
    with open(source, "rb") as file:
        header = file.readline()
    with subprocess.Popen(["ffmpeg", "-f", "yuv4mpegpipe", "-i", "-", "-i", source, "-lavfi", "psnr", "-f", "null", "-"],
                          stdin=subprocess.PIPE, stderr=subprocess.PIPE) as ffmpeg:
        _, report = ffmpeg.communicate(header + b"".join(b"FRAME\n" + picture for picture in pictures))
    return float(re.search(rb"PSNR y:([\d.]+|inf)", report)[1])
