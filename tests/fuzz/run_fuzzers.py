#!/usr/bin/env python3
"""Builds the fuzz targets in build/fuzz and runs each: run_fuzzers.py [SECONDS] [TARGET...].

SECONDS is CPU time for each target, 30 unless given; TARGETs are all unless given. Corpora grow in build/fuzz/corpus and
serve the next run; what was found lies in build/fuzz/findings. Exit code 1 if anything was found."""
import argparse
import math
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = ROOT / "build/fuzz"
CORPUS, FINDINGS, LOGS = BUILD / "corpus", BUILD / "findings", BUILD / "logs"
# Without NDEBUG: assertions are findings too.
FLAGS = "-fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined -D_GLIBCXX_ASSERTIONS"
# Most bytes of an input, and seconds and MiB that it may take. The encoder's inputs are choices, each of which takes long.
LIMITS = {
    "encoder": (200, 120, 3000),
    "geometry_payload": (8192, 10, 1024),
    "library_decoder": (8192, 60, 2048),
    "packet": (8192, 10, 1024),
    "packet_list": (8192, 30, 2048),
    "pattern_decoder": (4096, 10, 2048),
    "scene_index": (8192, 10, 1024),
    "stream_decoder": (8192, 60, 2048),
    "wire_frame_payload": (8192, 10, 1024),
}
OTHER_LIMITS = (2048, 10, 1024)
MOST_FINDINGS = 5  # of a target: then it needs a human being, not more time
COLUMNS = ("target", "executions", "per s", "edges", "features", "corpus", "found", "slowest s", "peak MiB")


def build(jobs):
    if not shutil.which("clang++"):
        sys.exit("run_fuzzers.py: needs clang++ and its runtime: apt-get install clang libclang-rt-14-dev")
    launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
    run = lambda *command: subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    run("cmake", "-B", BUILD, "-G", "Ninja", "-DCMAKE_CXX_COMPILER=clang++", "-DCMAKE_BUILD_TYPE=RelWithDebInfo",
        "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O2 -g1", f"-DCMAKE_CXX_FLAGS={FLAGS}", "-DFBS_FUZZ=ON", *launcher)
    run("ninja", "-C", BUILD, f"-j{jobs}", "fbs_fuzzers")


def targets():
    return sorted(path.name.removeprefix("fuzz_") for path in BUILD.glob("fuzz_*") if os.access(path, os.X_OK))


def cpu_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def last_number(pattern, text):
    found = re.findall(pattern, text)
    return int(found[-1]) if found else 0


class Tally:
    """What the runs of one target came to."""

    def __init__(self, target):
        self.target, self.executions, self.found, self.cpu = target, 0, 0, 0.0
        self.edges = self.features = self.corpus = self.slowest = self.peak = 0

    def add(self, log, failed):
        self.executions += last_number(r"stat::number_of_executed_units:\s+(\d+)", log)
        self.slowest = max(self.slowest, last_number(r"stat::slowest_unit_time_sec:\s+(\d+)", log))
        self.peak = max(self.peak, last_number(r"stat::peak_rss_mb:\s+(\d+)", log))
        self.edges = max(self.edges, last_number(r"cov: (\d+)", log))
        self.features = max(self.features, last_number(r"ft: (\d+)", log))
        self.corpus = max(self.corpus, last_number(r"corp: (\d+)", log))
        self.found += 1 if failed else 0

    def row(self):
        rate = self.executions / self.cpu if self.cpu else 0
        return (self.target, self.executions, f"{rate:.0f}", self.edges, self.features, self.corpus, self.found,
                self.slowest, self.peak)


def fuzz(target, seconds):
    """Runs one target for a CPU time; a finding ends a run, and another continues."""
    corpus = CORPUS / target
    if not corpus.exists():
        subprocess.run([BUILD / f"replay_{target}", "--seeds", ROOT / "tests/vectors", corpus], check=True)
    longest, timeout, memory = LIMITS.get(target, OTHER_LIMITS)
    tally = Tally(target)
    for run in range(1000):
        left = seconds - tally.cpu
        if left < 1 or tally.found == MOST_FINDINGS:
            break
        before = cpu_seconds()
        done = subprocess.run(
            [BUILD / f"fuzz_{target}", corpus, f"-max_total_time={math.ceil(left)}", f"-max_len={longest}",
             f"-timeout={timeout}", f"-rss_limit_mb={memory}", "-print_final_stats=1",
             f"-artifact_prefix={FINDINGS}/{target}_"],
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, errors="replace", check=False)
        tally.cpu += max(cpu_seconds() - before, 0.1)
        (LOGS / f"{target}.{run}.log").write_text(done.stderr)
        tally.add(done.stderr, done.returncode != 0)
    return tally


def print_row(row):
    print(f"{row[0]:<18}" + "".join(f"{cell:>12}" for cell in row[1:]), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("seconds", nargs="?", type=int, default=30)
    parser.add_argument("targets", nargs="*")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="of the build")
    arguments = parser.parse_intermixed_args()
    build(arguments.jobs)
    for folder in (FINDINGS, LOGS):
        folder.mkdir(exist_ok=True)
    unknown = set(arguments.targets) - set(targets())
    if unknown:
        sys.exit(f"run_fuzzers.py: no such target: {', '.join(sorted(unknown))}; there are {', '.join(targets())}")
    begin = time.monotonic()
    print_row(COLUMNS)
    found = 0
    for target in arguments.targets or targets():
        tally = fuzz(target, arguments.seconds)
        print_row(tally.row())
        found += tally.found
    print(f"{found} findings, {time.monotonic() - begin:.0f} s" + (f"; see {FINDINGS} and {LOGS}" if found else ""))
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
