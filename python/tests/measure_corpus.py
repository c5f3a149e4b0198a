#!/usr/bin/env python3
"""Measures what docs/corpus.md says of scaling and overhead.

measure_corpus.py talkers DIR --talker build/release/talker   makes fifty clips: seeds, lights, poses, sizes
measure_corpus.py overhead [--tasks N ...] [--workers N ...]  tasks that do nothing: time of each, memory of the client
measure_corpus.py scaling DIR --workers 1 2 4 [OPTION ...]    runs a corpus with so many workers; OPTIONs of fbs.corpus
measure_corpus.py paper RESULTS --clips N --price P           what N clips would take, by the tasks of a run
measure_corpus.py report RESULTS --clips N                    multiplies results: time and memory of a large report
"""

import argparse
import json
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

import pandas as pd
import pyarrow as pa
import pyarrow.parquet as parquet

from fbs.corpus.cluster import connected
from fbs.corpus.report.page import ReportOptions, write_report
from fbs.corpus.results_folder import ResultsFolder
from fbs.corpus.schema import TASKS
from fbs.corpus.window import Window


def peak_mb():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def make_talkers(options):
    """Every clip differs from the others in seed, and with its number in light, pose, motion, noise and size."""
    options.folder.mkdir(parents=True, exist_ok=True)
    motions = ("default", "turns", "talk", "brows", "blink")
    for n in range(options.count):
        size = "352x288" if n % 5 == 4 else "176x144"
        chosen = {
            "--seed": 100 + n, "--size": size, "--frames": 40 + n % 3 * 10, "--motion": motions[n % 5],
            "--light": n % 4 * 0.15, "--yaw": 6 + n % 7 * 5, "--pitch": 3 + n % 4 * 4, "--roll": 2 + n % 5 * 4,
            "--scale": n % 3 * 0.06, "--noise": n % 6 * 0.8, "--eye-distance": 0.10 + n % 6 * 0.02,
        }  # fmt: skip
        words = [str(word) for pair in chosen.items() for word in pair]
        subprocess.run([options.talker, options.folder / f"talker-{n:02}.y4m", *words], check=True)


def nothing(number):
    return number


def measure_overhead(options):
    print(
        "| workers | tasks | in flight | seconds | ms per task | client and scheduler, MB |\n|--:|--:|--:|--:|--:|--:|"
    )
    for workers in options.workers:
        for count in options.tasks:
            with connected("local", workers=workers) as client:
                window = Window(client, 64 * workers)
                begin = time.monotonic()
                left = iter(range(count))

                def fill():
                    while window.has_room and (numbers := [n for _, n in zip(range(8), left, strict=False)]):
                        window.submit(numbers, nothing, numbers)

                fill()
                for n, value, _ in window.ended():
                    assert value == n
                    fill()
                taken = time.monotonic() - begin
            print(
                f"| {workers} | {count} | {window.limit} | {taken:.1f} | {1e3 * taken / count:.2f} | {peak_mb():.0f} |",
                flush=True,
            )


def measure_scaling(options):
    """Efficiency is that from the begin of the first task to the end of the last, without start and report."""
    print("| workers | command, s | tasks, s | efficiency | tasks | CPU, s |\n|--:|--:|--:|--:|--:|--:|")
    first = None
    for workers in options.workers:
        with tempfile.TemporaryDirectory() as out:
            command = [sys.executable, "-m", "fbs.corpus", options.folder, "--out", out, "--workers", workers]
            command += ["--worst", 0, "--quiet", *options.rest]
            begin = time.monotonic()
            subprocess.run(list(map(str, command)), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            whole = time.monotonic() - begin
            tasks = ResultsFolder(out).tasks()
        begun = tasks["finished"] - pd.to_timedelta(tasks["task_s"], unit="s")
        taken = (tasks["finished"].max() - begun.min()).total_seconds()
        first = first or taken * workers
        share, cpu = 100 * first / taken / workers, tasks["cpu_s"].sum()
        print(f"| {workers} | {whole:.1f} | {taken:.1f} | {share:.0f} % | {len(tasks)} | {cpu:.0f} |", flush=True)


def measure_report(options):
    """Writes the parts of a run again and again under other names, then makes the report of them all."""
    source = ResultsFolder(options.results)
    points, tasks = source.points(), pa.Table.from_pandas(source.tasks(), schema=TASKS, preserve_index=False)
    have = len(tasks["clip"].unique())
    with tempfile.TemporaryDirectory() as out:
        folder = ResultsFolder(out)
        (folder.path / "run.json").write_text(json.dumps(source.asked()))
        for kind, table in (("points", points), ("tasks", tasks)):
            (folder.path / kind).mkdir()
            for n in range(-(-options.clips // have)):
                parquet.write_table(
                    _renamed(table, n), folder.path / kind / f"part-{n:06d}.parquet", compression="zstd"
                )
        size = sum(path.stat().st_size for path in folder.path.rglob("*.parquet"))
        before, begin = peak_mb(), time.monotonic()
        report = write_report(folder, folder.tasks(), None, None, ReportOptions("large", 10))
        taken = time.monotonic() - begin
        print(f"{options.clips} clips: {size / 1e6:.0f} MB of Parquet, report of {report.stat().st_size / 1e3:.0f} kB in {taken:.0f} s, "
              f"memory {before:.0f} to {peak_mb():.0f} MB")  # fmt: skip


def estimate(options):
    """CPU time of a picture and a setting, by size; what clips of that kind would take, and the tables of a run."""
    folder = ResultsFolder(options.results)
    tasks = folder.tasks()
    points = folder.points(["task_key", "codec", "width", "height", "pictures", "kbps"]).to_pandas()
    shapes = points.drop_duplicates("task_key").set_index("task_key")
    tasks = tasks[tasks["error"].isna()].join(shapes, on="task_key", how="inner")
    tasks["size"] = tasks["width"].astype(str) + "x" + tasks["height"].astype(str)
    tasks["ms"] = 1e3 * tasks["cpu_s"] / tasks["pictures"]
    fbs_kbps = tasks[tasks["codec"] == "fbs"].groupby("setting")["kbps"].mean().sum()
    tables = sum(path.stat().st_size for kind in ("points", "tasks") for path in (folder.path / kind).glob("*.parquet"))
    print(f"Parquet: {tables / len(points):.0f} bytes a point, {len(points) / len(tasks):.1f} points a task")
    print(f"Streams of fbs: {fbs_kbps:.1f} kbit/s in all qualities")
    print(
        "| size | codec | settings | CPU, ms a picture and setting | core hours | days on all cores | per 1000 clips |"
    )
    print("|---|---|--:|--:|--:|--:|--:|")
    for (size, codec), group in tasks.groupby(["size", "codec"]):
        settings = group["setting"].nunique()
        ms = group["ms"].mean()
        hours = options.clips * options.seconds * options.fps * settings * ms / 1e3 / 3600
        print(
            f"| {size} | {codec} | {settings} | {ms:.1f} | {hours:.0f} | {hours / options.cores / 24:.1f} "
            f"| {1000 * hours / options.clips * options.price:.2f} |"
        )


def _renamed(table, number):
    for name in ("clip", "task_key"):
        values = pa.array([f"{number}-{value}" for value in table[name].to_pylist()])
        table = table.set_column(table.column_names.index(name), table.schema.field(name), values)
    return table


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    what = parser.add_subparsers(required=True)
    talkers = what.add_parser("talkers")
    talkers.add_argument("folder", type=pathlib.Path)
    talkers.add_argument("--talker", required=True)
    talkers.add_argument("--count", type=int, default=50)
    talkers.set_defaults(run=make_talkers)
    overhead = what.add_parser("overhead")
    overhead.add_argument("--tasks", type=int, nargs="+", default=[1000, 10_000, 100_000])
    overhead.add_argument("--workers", type=int, nargs="+", default=[1, 2, 4])
    overhead.set_defaults(run=measure_overhead)
    scaling = what.add_parser("scaling")
    scaling.add_argument("folder", type=pathlib.Path)
    scaling.add_argument("--workers", type=int, nargs="+", default=[1, 2, 4])
    scaling.set_defaults(run=measure_scaling)
    paper = what.add_parser("paper")
    paper.add_argument("results", type=pathlib.Path)
    paper.add_argument("--clips", type=int, default=1_000_000)
    paper.add_argument("--seconds", type=float, default=10, help="of a clip")
    paper.add_argument("--fps", type=float, default=25)
    paper.add_argument("--cores", type=int, default=1000)
    paper.add_argument("--price", type=float, default=0.04, help="of a core for an hour")
    paper.set_defaults(run=estimate)
    report = what.add_parser("report")
    report.add_argument("results", type=pathlib.Path)
    report.add_argument("--clips", type=int, default=100_000)
    report.set_defaults(run=measure_report)
    options, options.rest = parser.parse_known_args()
    options.run(options)


if __name__ == "__main__":
    main()
