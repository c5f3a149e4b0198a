#!/usr/bin/env python3
"""Compares the analysis with the exact truth of the generated talker, at several levels of camera noise.

    measure_truth.py [--build build/release] [--noise 0 3 6] [--seeds 1 2 3] [--frames 300] [--size 352x288]
                     [--talker "ARGS"] [--encode "ARGS"] [--true-marks] [--json OUT]

--talker  arguments of talker; default --yaw 25 --pitch 15 --roll 15 --scale 0.2
--encode  arguments of fbs encode, e.g. "--quality 90"; the default quality trades precision of the state for bits
--true-marks  gives the encoder the true points of the first picture, which excludes errors of detection and marking

Columns, means over all pictures of all seeds:
    rotation, degrees   raw: angle between exported and true rotation. first: the same for rotations relative to the
                        first picture, which fbs takes as frontal; this removes a constant difference of the head
                        frames. rx, ry, rz: per axis, relative to the first picture. 95 %: percentile of 'first'
    translation, px     raw: exported against true position of the head frame's origin, which differs between the two
                        heads. first: relative to the first picture. origin: with that constant difference, three
                        numbers per clip, removed. face: mean of nose and eye corners relative to the first picture,
                        which does not depend on a head frame
    scale, percent      relative to the first picture
    landmarks, percent of the eye distance, of the visible points: per feature, all, and 'moved', with each
                        point's mean offset over the clip removed; 'moved*' is the same without the jaw
    r                   correlation of mouth opening, brow height and eye opening with the true values
"""
import argparse
import collections
import json
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile

import truth

ROOT = pathlib.Path(__file__).resolve().parents[2]
RIGID = (*range(27, 36), 36, 39, 42, 45)  # points that no expression moves
AMPLITUDES = "--yaw 25 --pitch 15 --roll 15 --scale 0.2"
INNER = range(17, 68)


def run(*arguments):
    subprocess.run([str(a) for a in arguments], check=True)


def follow(a, noise, seed, folder):
    """(found, true) pictures of one clip."""
    video, table, stream, out = (folder / name for name in ("talk.y4m", "true.csv", "talk.fbs", "out.csv"))
    run(a.build / "talker", video, "--truth", table, "--size", a.size, "--frames", a.frames, "--seed", seed,
        "--noise", noise, *a.talker.split())
    marks = []
    if a.true_marks:
        first = truth.read_truth(table)[0]
        (folder / "marks.json").write_text(json.dumps({"landmarks": first.points}))
        marks = ["--marks", folder / "marks.json"]
    run(a.build / "fbs", "encode", video, stream, "--quiet", *marks, *a.encode.split())
    run(a.build / "fbs", "export", stream, out)
    video.unlink()
    return truth.read(out), truth.read_truth(table)


def place(picture):
    return tuple(statistics.fmean(picture.points[k][axis] for k in RIGID) for axis in range(2))


def since(now, first):
    return now[0] - first[0], now[1] - first[1]


def errors(found, true):
    """{column: values}, one or more of each picture."""
    out = collections.defaultdict(list)
    offsets, c = truth.mean_offsets(found, true), truth.origin_between(found, true)
    f0, t0 = found[0], true[0]
    for f, t in zip(found, true, strict=True):
        f_turn, t_turn = truth.turn(f.rotation, f0.rotation), truth.turn(t.rotation, t0.rotation)
        out["rot raw"].append(truth.angle(truth.turn(f.rotation, t.rotation)))
        out["rot first"].append(truth.angle(truth.turn(f_turn, t_turn)))
        for axis, x, y in zip(("rx", "ry", "rz"), truth.degrees(f_turn), truth.degrees(t_turn)):
            out[axis].append(abs(x - y))
        out["px raw"].append(truth.distance(f.shift, t.shift))
        out["px first"].append(truth.distance(since(f.shift, f0.shift), since(t.shift, t0.shift)))
        moved = [t.shift[i] + t.scale * sum(t.rotation[i][k] * c[k] for k in range(3)) for i in range(2)]
        out["px origin"].append(truth.distance(f.shift, moved))
        out["px face"].append(truth.distance(since(place(f), place(f0)), since(place(t), place(t0))))
        out["scale %"].append(100 * abs(f.scale / f0.scale / (t.scale / t0.scale) - 1))
        for name, points in truth.FEATURES.items():
            out[name] += truth.landmark_error(f, t, points)
        out["all"] += truth.landmark_error(f, t, range(68))
        out["moved"] += truth.landmark_error(f, t, range(68), offsets)
        out["moved*"] += truth.landmark_error(f, t, INNER, offsets)
    mine, theirs = list(map(truth.openings, found)), list(map(truth.openings, true))
    for name in mine[0]:
        out["r " + name].append(truth.correlation([o[name] for o in mine], [o[name] for o in theirs]))
    return out


def summary(columns):
    means = {name: statistics.fmean(v for v in values if math.isfinite(v)) for name, values in columns.items()
             if any(map(math.isfinite, values))}
    turns = sorted(columns["rot first"])
    means["rot 95 %"] = turns[int(0.95 * (len(turns) - 1))]
    return means


def print_table(title, names, rows):
    width = max(7, *(len(n) + 1 for n in names))
    print(f"{title:22}" + "".join(f"{n:>{width}}" for n in names))
    for label, row in rows:
        print(f"{label:22}" + "".join(f"{row.get(n, math.nan):{width}.2f}" for n in names))
    print(flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    parser.add_argument("--noise", type=float, nargs="+", default=[0, 3, 6])
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3])
    parser.add_argument("--frames", type=int, default=300)
    parser.add_argument("--size", default="352x288")
    parser.add_argument("--talker", default=AMPLITUDES)
    parser.add_argument("--encode", default="")
    parser.add_argument("--true-marks", action="store_true")
    parser.add_argument("--json", type=pathlib.Path)
    a = parser.parse_args()
    rows = []
    for noise in a.noise:
        together = collections.defaultdict(list)
        for seed in a.seeds:
            with tempfile.TemporaryDirectory(prefix="fbs-truth-") as folder:
                one = errors(*follow(a, noise, seed, pathlib.Path(folder)))
            rows.append((f"noise {noise:g} seed {seed}", summary(one)))
            for name, values in one.items():
                together[name] += values
        rows.append((f"noise {noise:g} all", summary(together)))
    print(f"talker {a.talker}, {a.size}, {a.frames} pictures; fbs encode {a.encode or '(defaults)'}"
          f"{' with true marks' if a.true_marks else ''}\n")
    print_table("rotation, degrees", ["rot raw", "rot first", "rx", "ry", "rz", "rot 95 %"], rows)
    print_table("translation, px", ["px raw", "px first", "px origin", "px face", "scale %"], rows)
    print_table("landmarks, % of eyes", [*truth.FEATURES, "all", "moved", "moved*"], rows)
    print_table("openings", ["r mouth", "r brows", "r eyes"], rows)
    if a.json:
        a.json.write_text(json.dumps(dict(rows), indent=1) + "\n")


if __name__ == "__main__":
    sys.exit(main())
