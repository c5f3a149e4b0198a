#!/usr/bin/env python3
"""Measures what loss costs, and prints tables (FBS_BUILD is the folder of fbs; default build/release).

    measure_loss.py packets [--rates 1 5 10 20] [--seeds 3]    packets of a stream are lost
    measure_loss.py flips [--flips 200]                        one bit of a stream is wrong
    measure_loss.py kills [--kills 20] [--within 60]           `fbs encode` is killed

packets  In percent, each packet by itself, or in bursts of three on average; never the signature
flips    The bits are spread evenly over the stream
kills    At a random time in so many seconds. The encoder is fed through a pipe at the speed of the video

--clips      videos; default: akiyo and carphone of FBS_SHARED. Each is played forwards and backwards up to --seconds, at --size
--intervals  of `fbs encode --key-interval`, in seconds, or "default"
--folder     where these videos and their streams are kept, and found again; without it they are made each time

packets prints
    right    share of the pictures that are those of the whole stream, at their time
    dB       luma PSNR against the source of what is on the screen, less that of the whole stream. Pictures that are held
             count as what is shown; where nothing has come yet the screen is black
    gap      seconds from a loss to the next right picture, or to the end of the video: median, longest
kills prints
    plays    share of the pictures fed so far that the .part file shows: median, least
    behind   seconds of video that it lacks: median, most
"""
import argparse
import pathlib
import random
import statistics
import subprocess
import tempfile
import threading
import time

from clips import CLIPS
from harness import FBS, Y4m, ffmpeg
from loss import Whole, burst_loss, decode, luma_psnr, random_loss, with_flipped_bits, without

CHANNELS = {"random": random_loss, "bursts": burst_loss}


class Material:
    """A clip that goes on for long enough, and its streams."""

    def __init__(self, clip, arguments, folder):
        self.name, self.folder = clip.stem, folder
        self.video = folder / f"{clip.stem}.y4m"
        if self.video.exists():
            return
        once = folder / "once.mkv"
        ffmpeg("-i", clip, "-an", "-vf", f"scale={arguments.size},split[a][b];[b]reverse,trim=start_frame=1[r];[a][r]concat,"
               "setpts=N/FRAME_RATE/TB", "-pix_fmt", "yuv420p", "-c:v", "ffv1", once)
        ffmpeg("-stream_loop", "-1", "-i", once, "-t", str(arguments.seconds), self.video)
        once.unlink()

    @staticmethod
    def options(interval):
        return [] if interval == "default" else ["--key-interval", interval]

    def whole(self, interval):
        stream = self.folder / f"{self.name}_{interval}.fbs"
        if not stream.exists():
            subprocess.run([FBS, "encode", self.video, stream, "--quiet", *self.options(interval)], check=True)
        return Whole(stream)


def print_row(*cells):
    print("| " + " | ".join(str(cell) for cell in cells) + " |", flush=True)


def print_head(*cells):
    print_row(*cells)
    print_row("---", *["--:"] * (len(cells) - 1))


def percent(share, digits=0):
    return f"{100 * share:.{digits}f} %"


def lose_packets(material, whole, channel, rate, seed):
    """(share of right pictures, dB, gaps in seconds)"""
    lost = CHANNELS[channel](len(whole.packets), rate / 100, random.Random(f"{material.name} {channel} {rate} {seed}"))
    viewing = whole.seen(without(whole.stream, lost))
    psnr = luma_psnr(viewing.pictures, material.video)
    return viewing.share_right, psnr - whole.psnr, [(end - first) / whole.rate for first, end in viewing.gaps()]


def measure_packets(arguments, materials):
    wholes = {interval: [(material, material.whole(interval)) for material in materials] for interval in arguments.intervals}
    print_head("clip", "interval", "kbit/s", "scenes", "packets", "dB")
    for interval, pairs in wholes.items():
        for material, whole in pairs:
            whole.psnr = luma_psnr(whole.pictures, material.video)
            print_row(material.name, interval, f"{8 * len(whole.stream) * whole.rate / len(whole.pictures) / 1000:.2f}",
                      len(whole.scenes), len(whole.packets), f"{whole.psnr:.2f}")
    print()
    print_head("interval", "packets lost", *(f"{c}: {cell}" for c in CHANNELS for cell in ("right", "dB", "gap")))
    for interval, pairs in wholes.items():
        for rate in arguments.rates:
            cells = []
            for channel in CHANNELS:
                runs = [lose_packets(*pair, channel, rate, seed) for pair in pairs for seed in range(arguments.seeds)]
                gaps = [gap for run in runs for gap in run[2]] or [0]
                cells += [percent(statistics.mean(run[0] for run in runs)), f"{statistics.mean(run[1] for run in runs):.1f}",
                          f"{statistics.median(gaps):.1f}, {max(gaps):.1f} s"]
            print_row(interval, f"{rate:g} %", *cells)


def flip(whole, seed, of):
    """(share of pictures lost, whether fbs did not notice) with one wrong bit in part `seed` of `of` parts of the stream."""
    bits = 8 * (len(whole.stream) - 4)
    viewing = whole.seen(with_flipped_bits(whole.stream, 32 + int(bits * (seed + random.Random(seed).random()) / of)))
    return 1 - viewing.share_right, viewing.exit_code == 0 and not all(viewing.right)


def measure_flips(arguments, materials):
    print_head("clip", "interval", *(f"{cell}, {unit}" for unit in ("%", "s") for cell in ("lost: median", "90 %", "most")),
               "not noticed")
    for material in materials:
        for interval in arguments.intervals:
            whole = material.whole(interval)
            lost, unnoticed = zip(*(flip(whole, k, arguments.flips) for k in range(arguments.flips)))
            cuts = [statistics.median(lost), statistics.quantiles(lost, n=10)[-1], max(lost)]
            print_row(material.name, interval, *(f"{100 * x:.1f}" for x in cuts),
                      *(f"{x * len(whole.pictures) / whole.rate:.1f}" for x in cuts), sum(unnoticed))


def feed(encoder, video):
    """Writes the pictures of a Y4M in memory at its speed, until the encoder is gone. Returns how many were written."""
    begin, fed = time.monotonic(), 0
    try:
        encoder.stdin.write(video.header)
        for picture in video.pictures:
            time.sleep(max(0, begin + fed / video.rate - time.monotonic()))
            encoder.stdin.write(b"FRAME\n" + picture)
            fed += 1
    except BrokenPipeError:
        pass
    return fed


def kill(material, video, interval, seconds):
    """(pictures fed, pictures that can be played) when the encoder is killed after this many seconds."""
    part = material.folder / "killed.fbs.part"
    part.unlink(missing_ok=True)
    encoder = subprocess.Popen([FBS, "encode", "-", part.with_suffix(""), "--quiet", *material.options(interval)],
                               stdin=subprocess.PIPE, bufsize=0)
    killer = threading.Timer(seconds, encoder.kill)
    killer.start()
    fed = feed(encoder, video)
    killer.cancel()
    encoder.kill()
    encoder.wait()
    encoder.stdin.close()
    playable, _ = decode(part.read_bytes()) if part.exists() else (None, None)
    return fed, len(playable.pictures) if playable else 0


def measure_kills(arguments, materials):
    print_head("clip", "interval", "plays: median", "least", "behind: median", "most, s")
    for material in materials:
        video = Y4m(material.video.read_bytes())
        for interval in arguments.intervals:
            times = [arguments.within * random.Random(k).random() for k in range(arguments.kills)]
            pairs = [kill(material, video, interval, seconds) for seconds in times]
            plays = [played / max(fed, 1) for fed, played in pairs]
            behind = [(fed - played) / video.rate for fed, played in pairs]
            print_row(material.name, interval, percent(statistics.median(plays)), percent(min(plays)),
                      f"{statistics.median(behind):.1f}", f"{max(behind):.1f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("packets", "flips", "kills"))
    parser.add_argument("--clips", type=pathlib.Path, nargs="+", default=[CLIPS / "akiyo_cif.mkv", CLIPS / "carphone_qcif.mkv"])
    parser.add_argument("--intervals", nargs="+", default=["default", "10", "2"])
    parser.add_argument("--folder", type=pathlib.Path)
    parser.add_argument("--seconds", type=float, default=120)
    parser.add_argument("--size", default="176:144")
    parser.add_argument("--rates", type=float, nargs="+", default=[1, 5, 10, 20])
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--flips", type=int, default=200)
    parser.add_argument("--kills", type=int, default=20)
    parser.add_argument("--within", type=float, default=60)
    arguments = parser.parse_args()
    measure = {"packets": measure_packets, "flips": measure_flips, "kills": measure_kills}[arguments.what]
    with tempfile.TemporaryDirectory(prefix="fbs-loss-") as temporary:
        folder = arguments.folder or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        measure(arguments, [Material(clip, arguments, folder) for clip in arguments.clips])


if __name__ == "__main__":
    main()
