#!/usr/bin/env python3
"""Runs clang-tidy over all sources but the tests, in parallel. What was clean stays clean: a stamp for each source
holds a hash of the source, the headers of ours that it includes, its command and .clang-tidy, and an unchanged one is
skipped.

    run_tidy.py CLANG_TIDY BUILD    BUILD has compile_commands.json, and gets the stamps in tests/tidy/stamps
"""

import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ("common", "bitstream", "decoder", "encoder", "library", "cli", "samples", "training")
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.M)


def sources(build):
    """{path below SOURCE: its command}; a file that is compiled several times counts once."""
    found = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        path = os.path.relpath(entry["file"], SOURCE)
        if path.split("/")[0] in FOLDERS and path.endswith(".cpp"):  # our rules are for C++
            found.setdefault(path, entry["command"])
    return found


def with_headers(path, seen):
    """`path` and all headers of ours that it includes: our includes start at the root of the repository."""
    if path not in seen and (SOURCE / path).is_file():
        seen.add(path)
        for header in INCLUDE.findall((SOURCE / path).read_text()):
            with_headers(header, seen)
    return seen


def fingerprint(path, command, settings):
    digest = hashlib.sha256(settings + command.encode())
    for name in sorted(with_headers(path, set())):
        digest.update(name.encode() + (SOURCE / name).read_bytes())
    return digest.hexdigest()


def check(tidy, build, path, command, settings):
    """What clang-tidy finds; empty when it is clean."""
    stamp = build / "tests/tidy/stamps" / path.replace("/", ".")
    now = fingerprint(path, command, settings)
    if stamp.is_file() and stamp.read_text() == now:
        return ""
    done = subprocess.run([tidy, "-p", build, "--quiet", SOURCE / path], capture_output=True, text=True)
    if done.returncode == 0:
        stamp.write_text(now)
        return ""
    return done.stdout or done.stderr or f"{path}: clang-tidy ended with {done.returncode}\n"


def main():
    tidy, build = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    (build / "tests/tidy/stamps").mkdir(parents=True, exist_ok=True)
    version = subprocess.run([tidy, "--version"], check=True, capture_output=True).stdout
    settings = version + (SOURCE / ".clang-tidy").read_bytes()
    found = sources(build)
    assert len(found) > 50, f"only {len(found)} sources in {build}/compile_commands.json"
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        reports = list(pool.map(lambda item: check(tidy, build, *item, settings), found.items()))
    # Each finding in a header comes once for each source that includes it.
    findings = dict.fromkeys(re.split(r"(?m)^(?=/\S+:\d+:\d+: (?:error|warning):)", "".join(reports)))
    sys.stdout.write("".join(findings))
    dirty = sum(bool(report) for report in reports)
    print(f"{len(found)} sources, {dirty} with findings")
    return dirty > 0


if __name__ == "__main__":
    sys.exit(main())
