#!/usr/bin/env python3
"""Tests of the Python package as its users have it: a wheel in a virtual environment.

    run.py BUILD install            makes BUILD/python/{prefix,wheel,venv}: what is installed, the wheel on top of it,
                                    and the environment that has it
    run.py BUILD test [argument..]  runs pytest there, in this folder

Exit code 77 where the environment cannot be made: it takes the network once, for requirements.txt.
"""

import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
PACKAGE = HERE.parent
REQUIREMENTS = HERE / "requirements.txt"
SKIPPED = 77
OLDEST = (3, 11)  # that the versions in requirements.txt have wheels for
NO_NETWORK = r"Failed to establish a new connection|Temporary failure in name resolution|Connection refused|timed out"


def skip(why):
    print(f"skipped: {why}")
    sys.exit(SKIPPED)


def run(*command, **keywords):
    command = [str(word) for word in command]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **keywords)
    if done.returncode != 0:
        print(done.stdout)
        sys.exit(f"failed: {' '.join(command)}")


def environment(folder):
    """The interpreter of a virtual environment with what requirements.txt names; made only where that has changed."""
    python = folder / "bin/python"
    wanted = hashlib.sha256(REQUIREMENTS.read_bytes() + sys.version.encode()).hexdigest()
    stamp = folder / "requirements.sha256"
    if stamp.exists() and stamp.read_text() == wanted:
        return python
    shutil.rmtree(folder, ignore_errors=True)
    if sys.version_info < OLDEST:
        skip(f"Python {sys.version.split()[0]} is older than the packages of the tests")
    made = subprocess.run([sys.executable, "-m", "venv", folder], capture_output=True, text=True)
    if made.returncode != 0:
        skip(f"no virtual environment: {made.stdout}{made.stderr}")
    command = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "-r", REQUIREMENTS]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        print(done.stdout)
        if re.search(NO_NETWORK, done.stdout):
            skip("no network, and no environment from an earlier run")
        sys.exit("the requirements cannot be installed")
    stamp.write_text(wanted)
    return python


def install(build):
    root = build / "python"
    python = environment(root / "venv")
    prefix, wheels = root / "prefix", root / "wheel"
    for old in (prefix, wheels):
        shutil.rmtree(old, ignore_errors=True)
    run(os.environ.get("FBS_CMAKE", "cmake"), "--install", build, "--prefix", prefix)
    # The environment has no network to ask: what builds the wheel is in it, and numpy too.
    settings = {"cmake.define.fbs_ROOT": prefix, "build-dir": root / "extension",
                "cmake.define.CMAKE_COMPILE_WARNING_AS_ERROR": "ON"}
    settings |= {f"cmake.define.CMAKE_{name}_COMPILER": os.environ[key]
                 for name, key in (("C", "CC"), ("CXX", "CXX")) if key in os.environ}
    if launcher := shutil.which("ccache"):
        settings["cmake.define.CMAKE_CXX_COMPILER_LAUNCHER"] = launcher
    options = [word for name, value in settings.items() for word in ("-C", f"{name}={value}")]
    run(python, "-m", "pip", "wheel", "--no-deps", "--no-build-isolation", "-w", wheels, PACKAGE, *options)
    (wheel,) = wheels.glob("fbs_codec-*.whl")
    run(python, "-m", "pip", "install", "--no-deps", "--force-reinstall", wheel)
    print(f"{wheel.name}: {wheel.stat().st_size} bytes")


def test(build, arguments):
    python = build / "python/venv/bin/python"
    if not list((build / "python/wheel").glob("*.whl")):
        skip("there is no wheel")
    variables = {**os.environ, "FBS_BUILD": str(build), "PYTHONDONTWRITEBYTECODE": "1"}
    variables.pop("PYTHONPATH", None)
    command = [python, "-m", "pytest", "-q", "-p", "no:cacheprovider", "--durations=5", *arguments]
    sys.exit(subprocess.run(command, cwd=HERE, env=variables).returncode)


if __name__ == "__main__":
    if len(sys.argv) < 3 or sys.argv[2] not in ("install", "test"):
        sys.exit(__doc__)
    if sys.argv[2] == "install":
        install(pathlib.Path(sys.argv[1]).resolve())
    else:
        test(pathlib.Path(sys.argv[1]).resolve(), sys.argv[3:])
