#!/usr/bin/env python3
"""Writes what measure.py has measured into the tables of docs/results.md. The shorter table in README.md is edited by
hand.

    python3 ../shared/measure/measure.py build/release/fbs --json measured.json \\
        --points "--quality 0;--quality 15;--quality 30;--quality 50;--quality 70;--quality 90"
    docs/make_results.py measured.json              the tables of rates
    docs/make_results.py measured.json --speed      and the one of quality 50, with the speeds: of a quiet machine
"""

import argparse
import json
import math
import pathlib
import statistics

RESULTS = pathlib.Path(__file__).resolve().parent / "results.md"
# kbit/s at which the clips are compared: where fbs is at home, and the peers' rates begin.
RATES = {"akiyo_cif": (3, 5), "carphone_hq_qcif": (3, 5), "carphone_qcif": (3, 5), "claire_qcif": (3, 4.8),
         "foreman_cif": (3, 5), "man_glasses_720x1280": (6, 12), "man_goatee_512": (6, 12),
         "woman_expressions_512": (5, 8), "woman_presenter_700": (7, 12), "woman_speech_512": (7, 12)}


def table(head, rows):
    return "\n".join("| " + " | ".join(row) + " |" for row in [head, ["---"] + ["--:"] * (len(head) - 1), *rows]) + "\n"


def number(value, digits=1):
    return f"{value:.{digits}f}" if isinstance(value, (int, float)) else "–"


def at_rate(points, rate, key):
    """Between the two points that enclose a rate, along its logarithm; nothing below and above them all."""
    points = sorted((point for point in points if key in point), key=lambda point: point["kbps"])
    for a, b in zip(points, points[1:]):
        if a["kbps"] <= rate <= b["kbps"]:
            share = math.log(rate / a["kbps"]) / math.log(b["kbps"] / a["kbps"])
            return (1 - share) * a[key] + share * b[key]
    return None


def envelope(points, key):
    """Those that are better than all of less rate."""
    out = []
    for point in sorted((point for point in points if key in point), key=lambda point: point["kbps"]):
        if not out or point[key] > out[-1][key]:
            out.append(point)
    return out


def equal_quality(summary):
    names = "bd_rate_psnr_face", "bd_rate_psnr_y"
    rows = [[clip["clip"]] + [f"{clip[name]:.0f} %" for name in names] for clip in summary]
    rows.append(["median"] + [f"{statistics.median(clip[name] for clip in summary):.0f} %" for name in names])
    return table(["clip", "face", "frame"], rows)


def given_rates(rows, peers):
    out = []
    for clip, rates in RATES.items():
        others = json.loads((peers / f"{clip}.json").read_text())["points"]
        for k, rate in enumerate(rates):
            line = [clip if k == 0 else "", f"{rate:g}"]
            for key, digits in (("psnr_face", 1), ("psnr_y", 1), ("ssim_y", 3)):
                line.append(number(at_rate([row for row in rows if row["clip"] == clip], rate, key), digits))
                line.append(number(at_rate(envelope(others, key), rate, key), digits))
            out.append(line)
    return table(["clip", "kbit/s", "face", "peers", "frame", "peers", "SSIM", "peers"], out)


def quality_50(rows):
    columns = {"kbit/s": ("kbps", 3), "motion": ("motion_kbps", 3), "startup": ("startup", 0), "face": ("psnr_face", 2),
               "face, peers": ("peers_psnr_face", 2), "face, first picture held": ("psnr_face_still", 2),
               "frame": ("psnr_y", 2), "frame, peers": ("peers_psnr_y", 2), "encoded/s": ("encode_fps", 1),
               "decoded/s": ("decode_fps", 0)}
    return table(["clip", *columns], [[row["clip"]] + [number(row[key], digits) for key, digits in columns.values()]
                                      for row in rows if row["args"] in ("--quality 50", "")])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("measured")
    parser.add_argument("--speed", action="store_true")
    parser.add_argument("--peers", type=pathlib.Path, default=RESULTS.parent.parent.parent / "shared/peers")
    arguments = parser.parse_args()
    measured = json.loads(pathlib.Path(arguments.measured).read_text())
    tables = {"equal quality": equal_quality(measured["summary"]), "given rates": given_rates(measured["rows"], arguments.peers)}
    if arguments.speed:
        tables["quality 50"] = quality_50(measured["rows"])
    text = RESULTS.read_text()
    for name, new in tables.items():
        head, rest = text.split(f"<!-- {name}: docs/make_results.py -->\n")
        text = head + f"<!-- {name}: docs/make_results.py -->\n" + new + rest[rest.index("<!-- end -->"):]
    RESULTS.write_text(text)


if __name__ == "__main__":
    main()
