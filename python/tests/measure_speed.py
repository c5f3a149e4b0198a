#!/usr/bin/env python3
"""Speed of the Python decoder beside the program's: both decode a stream to planes, on one core.

    measure_speed.py STREAM [--threads N] [--core N] [--rounds N]

Prints pictures per second of both, and their ratio: of the medians of the rounds, which take turns.
"""

import argparse
import os
import statistics
import time

import fbs
from fbs import _program


def python_loop(stream, threads):
    count = 0
    began = time.perf_counter()
    with fbs.Decoder(stream, threads=threads) as decoder:
        for picture in decoder:
            count += picture.y.shape[0] > 0
    return count / (time.perf_counter() - began)


def program(stream, threads, count):
    began = time.perf_counter()
    _program.run(["decode", stream, "null:", "--quiet", "--threads", str(threads)])
    return count / (time.perf_counter() - began)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("stream")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--core", type=int, default=0)
    parser.add_argument("--rounds", type=int, default=7)
    a = parser.parse_args()
    os.sched_setaffinity(0, {a.core})
    count = len(fbs.Decoder(a.stream).states)
    ours, theirs = [], []
    for _ in range(a.rounds):
        ours.append(python_loop(a.stream, a.threads))
        theirs.append(program(a.stream, a.threads, count))
    ours, theirs = statistics.median(ours), statistics.median(theirs)
    print(f"{count} pictures, {a.threads} threads: Python {ours:.1f}/s, program {theirs:.1f}/s, ratio {ours / theirs:.3f}")


if __name__ == "__main__":
    main()
