#!/usr/bin/env python3
"""AV1 in low delay over the links of lossy_link. What does a viewer see?

    av1_link.py CLIP... [--encoder aom] [--scale 1] [--every 1] [--at-most BYTES|FOLDER] [--crf 63]
                [--repair pli nack key2 key10] [--loss 0 1 5 10 20 burst] [--round-trip 0.2] [--wait 0.45] [--seeds 5]

  --encoder  aom: libaom for real time, svt: SVT-AV1 in low delay; both through ffmpeg
  --scale    the picture is coded at 1/N of its width and height, and shown at full size (Lanczos)
  --every    each Nth picture is coded, and held
  --at-most  code at the lowest crf whose stream without loss is no larger: bytes, or FOLDER with CLIP.packet.fbs
  --repair   pli: a loss is answered by a key frame; nack: lost packets are sent again, the picture freezes while one is
             late, and what still misses after a second is answered by a key frame; key2: a key frame every 2 s, and no
             answers
  --loss     percent of packets, each by itself; burst: 10 % in runs of 0.3 s on average
  --wait     s that the receiver of nack holds pictures back; the others show what comes

A frame is sent in packets of at most 1200 bytes. It needs all of them, and all frames since the last key frame; until they
are there the last picture stays. As in lossy_link the first key frame arrives, a loss is noticed when the next frame is due,
requests are not lost, and packets that are sent again are lost each by itself. Key frames are really coded: a new encoder
starts there. At constant quality without look-ahead this is what -force_key_frames gives, byte count by byte count, with
libaom; libsvtav1 1.4 ignores that option.

Prints a line of JSON for each clip and link, then means over the clips: shares of pictures that are right, current, and
within 1 dB of the stream without loss in frame and face, PSNR gained (lost: negative) and the longest freeze, as lossy_link,
but a freeze may last to the end; PSNR shown; kbit/s and packets/s of all that is sent, without their headers. The face is the
box around the oval of FBS_SHARED/reference/CLIP.csv.
"""
import argparse
import collections
import csv
import json
import math
import os
import pathlib
import random
import struct
import subprocess

import cv2
import numpy as np

SHARED = pathlib.Path(os.environ.get("FBS_SHARED", "/work/shared"))
ENCODERS = {
    "aom": "-c:v libaom-av1 -usage realtime -cpu-used 4 -lag-in-frames 0 -b:v 0 -g 9999",
    "svt": "-c:v libsvtav1 -preset 8 -svtav1-params pred-struct=1:keyint=-1:scd=0",
}
ONE_WAY, PACKET, PATIENCE = 0.05, 1200, 1.0
Sent = collections.namedtuple("Sent", "key index time")  # a coded frame, and when it can be decoded


def ffmpeg(arguments, data=None):
    return subprocess.run(["ffmpeg", "-v", "error", *arguments.split()], input=data, stdout=subprocess.PIPE,
                          check=True, env={**os.environ, "SVT_LOG": "1"}).stdout


class Clip:
    """Luma, raw pictures and face boxes of a source."""

    def __init__(self, path):
        probe = subprocess.run(["ffprobe", "-v", "error", "-select_streams", "v", "-show_entries",
                                "stream=width,height,r_frame_rate", "-of", "csv=p=0", path], stdout=subprocess.PIPE, check=True)
        width, height, rate = probe.stdout.decode().strip().split(",")
        self.name, self.width, self.height, self.rate = pathlib.Path(path).stem, int(width), int(height), rate
        self.fps = float(rate.split("/")[0]) / float(rate.split("/")[1])
        self.raw = np.frombuffer(ffmpeg(f"-i {path} -vsync 0 -pix_fmt yuv420p -f rawvideo -"), np.uint8)
        self.raw = self.raw.reshape(-1, self.width * self.height * 3 // 2)
        self.boxes = []
        for row in csv.DictReader(open(SHARED / "reference" / f"{self.name}.csv", encoding="utf-8")):
            x, y = ([float(row[f"{axis}{k}"]) for k in range(36)] for axis in ("ox", "oy"))
            left, top = max(0, int(min(x))), max(0, int(min(y)))
            self.boxes.append((slice(top, max(top + 8, int(max(y)) + 1)), slice(left, max(left + 8, int(max(x)) + 1))))
        assert len(self.boxes) == len(self.raw)

    def luma(self, raw):
        return raw[:self.width * self.height].reshape(self.height, self.width)

    def score(self, raw, n):
        """PSNR in frame and face of a picture that is shown for picture n."""
        shown, source = self.luma(raw), self.luma(self.raw[n])
        return psnr(shown, source), psnr(shown[self.boxes[n]], source[self.boxes[n]])


def psnr(a, b):
    mse = cv2.norm(np.ascontiguousarray(a), np.ascontiguousarray(b), cv2.NORM_L2SQR) / a.size
    return min(60.0, 10 * math.log10(65025 / mse)) if mse else 60.0


class Coder:
    """The streams of a clip that begin with a key frame at any of the coded pictures, coded as far as they are needed."""

    def __init__(self, clip, options, crf):
        self.clip, self.every, self.scale = clip, options.every, options.scale
        self.settings = f"{ENCODERS[options.encoder]} -crf {crf}"
        self.pictures = clip.raw[::self.every]
        self.fps = clip.fps / self.every
        self.streams = {}  # by key frame: IVF and sizes of its frames

    def encode(self, key, frames):
        clip = self.clip
        data = self.pictures[key:key + frames].tobytes()
        ivf = ffmpeg(f"-f rawvideo -pix_fmt yuv420p -s {clip.width}x{clip.height} -r {clip.rate} -i - "
                     f"-vf scale=iw/{self.scale}:ih/{self.scale}:flags=lanczos {self.settings} -f ivf -", data)
        sizes, at = [], 32
        while at < len(ivf):
            sizes.append(struct.unpack_from("<I", ivf, at)[0])
            at += 12 + sizes[-1]
        assert len(sizes) == len(data) // self.pictures[0].size
        self.streams[key] = ivf, sizes

    def size(self, key, index):
        known = len(self.streams[key][1]) if key in self.streams else 0
        if index >= known:
            self.encode(key, len(self.pictures) - key if key == 0 else max(20, 3 * known))
        return self.streams[key][1][index]

    def decode(self, key):
        clip = self.clip
        raw = ffmpeg(f"-f ivf -i - -vsync 0 -vf scale={clip.width}:{clip.height}:flags=lanczos -pix_fmt yuv420p -f rawvideo -",
                     self.streams[key][0])
        return np.frombuffer(raw, np.uint8).reshape(-1, clip.raw.shape[1])


def over_link(coder, repair, loss, burst, options, seed):
    """What is sent, what of it can be decoded at which time, and the bytes and packets that it took."""
    chance, frame_time = random.Random(seed), 1 / coder.fps
    leave = min(1.0, frame_time / burst) if burst else 1
    patience = PATIENCE if repair == "nack" else 0
    interval = round(float(repair[3:]) * coder.fps) if repair.startswith("key") else 0
    sent, size_sent, packets_sent, key, next_key, bad = [], 0, 0, 0, 0, False
    for n in range(len(coder.pictures)):
        if n == next_key or interval and n % interval == 0:
            key = n
        size = coder.size(key, n - key)
        packets = [min(PACKET, size - k) for k in range(0, size, PACKET)]
        size_sent += size
        packets_sent += len(packets)
        if burst:
            bad = chance.random() >= leave if bad else chance.random() < leave * loss / (1 - loss)
        arrived = n * frame_time + ONE_WAY
        noticed = arrived + frame_time
        for packet in packets:
            if n == 0 or not (bad if burst else chance.random() < loss):
                continue
            time = noticed if repair == "nack" else math.inf
            again = 0
            while time < math.inf and (not again or chance.random() < loss):
                again += 1
                time += options.round_trip
            size_sent += again * packet
            packets_sent += again
            arrived = max(arrived, time)
        if not interval and arrived > noticed + patience and next_key <= n:
            next_key = n + 1 + math.ceil((patience + options.round_trip) * coder.fps - 1e-3)
        sent.append(Sent(key, n - key, arrived if n == key else max(arrived, sent[-1].time)))
    return sent, size_sent, packets_sent


def shown_of(coder, sent, wait):
    """For each picture of the source the coded frame that is shown, and whether it is the one that should be."""
    shown = []
    for n in range(len(coder.clip.raw)):
        due = n / coder.clip.fps + ONE_WAY + wait + 1e-6
        j = n // coder.every
        while sent[j].time > due:
            j -= 1
        shown.append((sent[j].key, sent[j].index, j == n // coder.every))
    return shown


def scores_of(coder, runs):
    """PSNR of every coded frame at every picture of the source for which some run shows it."""
    wanted = collections.defaultdict(set)
    for shown in runs:
        for n, (key, index, _) in enumerate(shown):
            wanted[key].add((index, n))
    scores = {}
    for key, places in wanted.items():
        decoded = coder.decode(key)
        for index, n in places:
            scores[key, index, n] = coder.clip.score(decoded[index], n)
    return scores


def report(coder, runs, scores):
    """The line of one link: means over its runs, each (shown, bytes, packets)."""
    whole = [scores[0, n // coder.every, n] for n in range(len(coder.clip.raw))]
    seconds = len(whole) / coder.clip.fps
    got = np.array([[scores[key, index, n] for n, (key, index, _) in enumerate(shown)] for shown, _, _ in runs])
    lost = got - np.array(whole)
    frames = [frame for shown, _, _ in runs for frame in shown]
    return {"right": np.mean([current and key == 0 for key, _, current in frames]),
            "current": np.mean([current for _, _, current in frames]), "within": np.mean((lost >= -1).all(axis=2)),
            "frame": lost[:, :, 0].mean(), "face": lost[:, :, 1].mean(),
            "longest": max(map(len, "".join(".F"[not current] for _, _, current in frames).split("."))) / coder.clip.fps,
            "frame_shown": got[:, :, 0].mean(), "face_shown": got[:, :, 1].mean(),
            "kbps": np.mean([size for _, size, _ in runs]) * 8e-3 / seconds,
            "packets_per_s": np.mean([packets for _, _, packets in runs]) / seconds}


def coder_of(clip, options):
    coder, crf = Coder(clip, options, options.crf), options.crf
    coder.encode(0, len(coder.pictures))
    if options.at_most:
        folder = pathlib.Path(options.at_most)
        most = (folder / f"{clip.name}.packet.fbs").stat().st_size if folder.is_dir() else int(options.at_most)
        while crf > 20:
            finer = Coder(clip, options, crf - 2)
            finer.encode(0, len(finer.pictures))
            if sum(finer.streams[0][1]) > most:
                break
            coder, crf = finer, crf - 2
    return coder, crf


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("clips", nargs="+")
    parser.add_argument("--encoder", choices=ENCODERS, default="aom")
    for name, value in {"scale": 1, "every": 1, "crf": 63, "seeds": 5}.items():
        parser.add_argument(f"--{name}", type=int, default=value)
    parser.add_argument("--at-most")
    parser.add_argument("--repair", nargs="+", default=["pli", "nack", "key2", "key10"])
    parser.add_argument("--loss", nargs="+", default=["0", "1", "5", "10", "20", "burst"])
    parser.add_argument("--round-trip", type=float, default=0.2)
    parser.add_argument("--wait", type=float, default=0.45)
    options = parser.parse_args()
    lines = collections.defaultdict(list)
    for path in options.clips:
        coder, crf = coder_of(Clip(path), options)
        links = {}
        for repair in options.repair:
            for name in options.loss:
                loss, burst = (0.1, 0.3) if name == "burst" else (float(name) / 100, 0)
                over = [over_link(coder, repair, loss, burst, options, seed) for seed in range(1, options.seeds + 1)]
                wait = options.wait if repair == "nack" else 0
                links[repair, name] = [(shown_of(coder, sent, wait), size, packets) for sent, size, packets in over]
        whole = [(0, n // coder.every, True) for n in range(len(coder.clip.raw))]
        scores = scores_of(coder, [whole] + [shown for runs in links.values() for shown, _, _ in runs])
        for link, runs in links.items():
            lines[link].append(report(coder, runs, scores))
            print(json.dumps({"clip": coder.clip.name, "crf": crf, "repair": link[0], "loss": link[1],
                              **{k: round(float(v), 4) for k, v in lines[link][-1].items()}}), flush=True)
    for (repair, loss), of_clips in lines.items():
        means = {k: round(float(np.mean([line[k] for line in of_clips])), 4) for k in of_clips[0]}
        print(json.dumps({"clip": "mean", "repair": repair, "loss": loss, **means}))


if __name__ == "__main__":
    main()
