#!/usr/bin/env python3
"""Runs clang-tidy over all sources but the tests, in parallel. What was clean stays clean: a stamp is named by a hash of
a source, the headers of ours that it includes, its command and .clang-tidy, and what has a stamp is skipped. Stamps are
kept in the user's cache, and so hold for other clones.

    run_tidy.py CLANG_TIDY CMAKE BUILD    BUILD is configured here, with a command for each source and not for groups
"""

import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import time

SOURCE = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ("common", "bitstream", "decoder", "encoder", "library", "cli", "samples", "training")
STAMPS = pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache") / "fbs/tidy"
KEPT_DAYS = 60  # after their last use
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.M)


def sources(build):
    """{path below SOURCE: its command}; a file that is compiled several times counts once."""
    found = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        path = os.path.relpath(entry["file"], SOURCE)
        if path.split("/")[0] in FOLDERS and path.endswith(".cpp"):  # our rules are for C++
            found.setdefault(path, entry["command"])
    return found


def configure(cmake, build):
    subprocess.run([cmake, "-S", SOURCE, "-B", build, "-G", "Ninja", "-D", "CMAKE_BUILD_TYPE=Release", "-D",
                    "CMAKE_DISABLE_PRECOMPILE_HEADERS=ON"], check=True, stdout=subprocess.DEVNULL)


def with_headers(path, seen):
    """`path` and all headers of ours that it includes: our includes start at the root of the repository."""
    if path not in seen and (SOURCE / path).is_file():
        seen.add(path)
        for header in INCLUDE.findall((SOURCE / path).read_text()):
            with_headers(header, seen)
    return seen


def fingerprint(build, path, command, settings):
    for folder, name in ((build, "BUILD"), (SOURCE, "SOURCE")):
        command = command.replace(str(folder), name)
    digest = hashlib.sha256(settings + command.encode())
    for name in sorted(with_headers(path, set())):
        digest.update(name.encode() + (SOURCE / name).read_bytes())
    return digest.hexdigest()


def check(tidy, build, path, command, settings):
    """What clang-tidy finds; empty when it is clean."""
    stamp = STAMPS / fingerprint(build, path, command, settings)
    if stamp.is_file():
        stamp.touch()
        return ""
    done = subprocess.run([tidy, "-p", build, "--quiet", SOURCE / path], capture_output=True, text=True)
    if done.returncode == 0:
        stamp.touch()
        return ""
    return done.stdout or done.stderr or f"{path}: clang-tidy ended with {done.returncode}\n"


def drop_old_stamps():
    for stamp in STAMPS.iterdir():
        if stamp.stat().st_mtime < time.time() - KEPT_DAYS * 86400:
            stamp.unlink(missing_ok=True)


def main():
    tidy, cmake, build = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3]).resolve()
    configure(cmake, build)
    STAMPS.mkdir(parents=True, exist_ok=True)
    drop_old_stamps()
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
