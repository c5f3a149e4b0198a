#!/usr/bin/env python3
"""Writes the output of measure.py into docs/results.md. The shorter table in README.md is edited by hand.

    python3 ../shared/measure/measure.py build/release/fbs > measured.txt
    docs/make_results.py measured.txt
"""

import pathlib
import re
import sys

RESULTS = pathlib.Path(__file__).resolve().parent / "results.md"
COLUMNS = ["kbit/s", "startup", "pattern", "motion", "face", "peers", "still", "frame", "peers", "SSIM", "peers", "fSSIM",
           "steady", "uv", "enc/s", "dec/s"]
SHOWN = [0, 3, 1, 4, 5, 6, 7, 8, 14, 15]
HEADS = ["clip", "kbit/s", "motion", "startup", "face", "face, peers", "face, first picture held", "frame", "frame, peers",
         "encoded/s", "decoded/s"]

rows = []
for line in pathlib.Path(sys.argv[1]).read_text().splitlines():
    words = line.split()
    numbers = words[-1 - len(COLUMNS):-1]
    if len(words) > len(COLUMNS) + 1 and "/" in words[-1] and re.fullmatch(r"[\d.]+", numbers[0]):
        rows.append([words[0]] + [numbers[i].replace("<", "-") for i in SHOWN])
assert rows, "no clip in " + sys.argv[1]
table = ["| " + " | ".join(row) + " |" for row in [HEADS, ["---"] * len(HEADS)] + rows]
text = RESULTS.read_text()
begin, end = "<!-- results: docs/make_results.py -->\n", "<!-- end of results -->"
head, rest = text.split(begin)
RESULTS.write_text(head + begin + "\n".join(table) + "\n" + end + rest.split(end)[1])
