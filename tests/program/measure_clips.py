#!/usr/bin/env python3
"""Measures the clips of clip_floors.txt, for clips_test.py.

    measure_clips.py             prints the table
    measure_clips.py --update    also writes it into clip_floors.txt, with the margins below

Reads FBS_SHARED/clips/NAME.mkv, by default ../shared/clips beside the repository; FBS_BUILD is the folder of fbs, by default
build/release. docs/results.md tells how to use clips of your own.
"""
import dataclasses
import sys

from clips import FLOORS, FLOORS_FILE, Row, measure
from harness import ProgramTest

PSNR_MARGIN = 0.3    # dB, for other compilers and OpenCV versions
BYTES_MARGIN = 1.05


def floor(row):
    return dataclasses.replace(
        row, face_db=row.face_db - PSNR_MARGIN, frame_db=row.frame_db - PSNR_MARGIN,
        startup_bytes=round(row.startup_bytes * BYTES_MARGIN),
        motion_kbps=row.motion_kbps * BYTES_MARGIN + 0.005, total_kbps=row.total_kbps * BYTES_MARGIN + 0.005)


def main():
    print(Row.heading())
    measured = []
    for wanted in FLOORS:
        test = ProgramTest()
        test.setUp()
        measured.append(measure(test, wanted.clip, wanted.frames))
        test.doCleanups()
        print(measured[-1], flush=True)
    if "--update" in sys.argv[1:]:
        comments = [line for line in FLOORS_FILE.read_text().splitlines() if line.startswith("#")]
        FLOORS_FILE.write_text("\n".join(comments + [str(floor(row)) for row in measured]) + "\n")


if __name__ == "__main__":
    main()
