#!/usr/bin/env python3
"""Prints the table of README.md for a rendered talker and for clips of your own (docs/results.md).

    scripts/measure_clips.py [FOLDER] [--build DIR] [--quality N] [--seconds S] [--jobs N] [--keep DIR]

Encodes each video of FOLDER, in any format that ffmpeg reads, at one quality, 50 unless given, and compares it with x264,
x265 and AV1 at the same rate (docs/evaluate.md). The face is the inside of the stream's mesh, so landmarks are not needed.
An interrupted run with --keep continues. Needs the built programs fbs and talker, and ffmpeg with libx264, libx265 and
libsvtav1 or libaom.
"""

import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
HEADS = ["clip", "kbit/s", "motion", "startup", "face", "face, peers", "frame", "frame, peers"]


def evaluate(fbs, source, run, *options):
    """The clips in the report of `fbs evaluate`, with their peers. Exits on failure."""
    command = [fbs, "evaluate", source, "--peers", "--json", "--keep", run, *options]
    done = subprocess.run(list(map(str, command)), stdout=subprocess.PIPE)
    if not done.stdout:
        sys.exit(done.returncode or 1)
    report = json.loads(done.stdout)
    return report.get("clips", [report])


def best_peer(peers, key, kbps):
    """The best value of the peers at this rate, interpolated over the logarithm of the rate; "-" where none goes so low."""
    envelope = []
    for rate, value in sorted((peer["kbps"], peer[key]) for peer in peers if key in peer):
        if not envelope or value > envelope[-1][1]:
            envelope.append((rate, value))
    for (low, a), (high, b) in zip(envelope, envelope[1:]):
        if low <= kbps <= high:
            return f"{a + (b - a) * math.log(kbps / low) / math.log(high / low):.2f}"
    return f"{envelope[-1][1]:.2f}" if envelope and kbps > envelope[-1][0] else "-"


def row(clip):
    point, = clip["points"]
    kbps, motion = point["kbps"], point["bytes"]["motion"] * 8e-3 / point["seconds"]
    face = f"{point['psnr_face']:.2f}" if "psnr_face" in point else "-"
    return [pathlib.Path(clip["source"]).stem, f"{kbps:.2f}", f"{motion:.2f}", str(point["bytes"]["startup"]), face,
            best_peer(clip["peers"], "psnr_face", kbps), f"{point['psnr_frame']:.2f}",
            best_peer(clip["peers"], "psnr_frame", kbps)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?")
    parser.add_argument("--build", default=ROOT / "build/release", type=pathlib.Path)
    parser.add_argument("--quality", default="50")
    parser.add_argument("--seconds", default=10.0, type=float, help="length of the talker")
    parser.add_argument("--jobs", default="1")
    parser.add_argument("--keep", type=pathlib.Path, help="folder for finished results")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        run = options.keep or pathlib.Path(temporary)
        run.mkdir(parents=True, exist_ok=True)
        talker = run / "talker.y4m"
        if not talker.exists():
            unfinished = run / "unfinished.y4m"
            subprocess.run([options.build / "talker", unfinished, "--frames", str(round(options.seconds * 30))], check=True)
            unfinished.rename(talker)
        fbs = options.build / "fbs"
        clips = evaluate(fbs, talker, run / "talker", "--quality", options.quality)
        if options.folder:
            clips += evaluate(fbs, options.folder, run / "clips", "--jobs", options.jobs, "--quality", options.quality)
    for cells in [HEADS, ["---"] + ["--:"] * (len(HEADS) - 1)] + [row(clip) for clip in clips]:
        print("| " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
