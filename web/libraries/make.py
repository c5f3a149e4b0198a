#!/usr/bin/env python3
"""Builds the libraries of the decoder for WebAssembly: make.py [options] PREFIX.

dav1d, Draco, Opus and Codec 2 come as Debian's sources, checked against the hashes of its signed index, with Debian's
patches. Headers that need no building are taken from the packages that are installed. Needs emscripten, node-acorn, cmake,
ninja and patch. When PREFIX is complete, nothing is done, and no network is needed. Exit code 77 when the machine lacks a
tool or the network."""
import argparse
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import urllib.request
from dataclasses import dataclass

HERE = pathlib.Path(__file__).resolve().parent
DEFAULT_SOURCES = HERE.parents[1] / "build/web/sources"
TOOLS = {"em++": "emscripten", "node": "nodejs", "cmake": "cmake", "ninja": "ninja-build", "patch": "patch", "cc": "gcc"}
HEADERS = ("glm", "tl", "hwy")
SKIPPED = 77  # exit code: nothing is wrong, but the machine lacks a tool or the network


class Missing(Exception):
    """What the machine lacks."""


class Failed(Exception):
    """What went wrong."""


@dataclass
class Library:
    name: str
    suites: tuple = ("bookworm",)  # of Debian, the first that has it
    patched: bool = True           # Debian changes its code
    part: str = ""                 # of the archive: the rest is not unpacked


LIBRARIES = (
    Library("dav1d"),
    Library("draco", part="*/src/draco/*"),
    Library("opus"),
    Library("codec2", suites=("bookworm", "trixie"), patched=False),  # some mirrors of bookworm lack it
)


def run(*arguments, **options):
    done = subprocess.run([str(a) for a in arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          errors="replace", check=False, **options)
    if done.returncode != 0:
        last = "\n".join(line[:200] for line in done.stdout.splitlines()[-15:])
        raise Failed(f"{pathlib.Path(str(arguments[0])).name} failed:\n{last}")
    return done.stdout


def debian():
    """The address from which this machine has Debian's packages: it has their sources, too."""
    listed = run("apt-get", "indextargets", "--format", "$(REPO_URI)", "Identifier: Packages", "Origin: Debian",
                 "Label: Debian").split()
    if not listed:
        raise Missing("apt knows no address of Debian's packages: apt-get update")
    return listed[0]


def apt(suite, sources):
    """The command line of apt-get that knows the sources of a suite, and nothing else."""
    folder = sources / suite
    if not (folder / "updated").exists():
        (folder / "lists/partial").mkdir(parents=True, exist_ok=True)
        (folder / "debian.sources").write_text(
            f"Types: deb-src\nURIs: {debian()}\nSuites: {suite}\nComponents: main\n"
            "Signed-By: /usr/share/keyrings/debian-archive-keyring.gpg\n")
    command = ["apt-get", "-q", "-o", "Dir::Etc::sourceparts=/nonexistent", "-o",
               f"Dir::Etc::sourcelist={folder}/debian.sources", "-o", f"Dir::State::lists={folder}/lists"]
    if not (folder / "updated").exists():
        run(*command, "update", "--error-on=any")
        (folder / "updated").touch()
    return command


def download(uri, path, sha256):
    with urllib.request.urlopen(uri, timeout=60) as answer:
        content = answer.read()
    if hashlib.sha256(content).hexdigest() != sha256:
        raise Failed(f"{uri}: not the file of Debian's index")
    path.write_bytes(content)


def archives(library, sources):
    """Downloads the archives of a library: that of its authors, and Debian's."""
    wanted = [rf"{library.name}_[^-]*\.orig\.tar\.\w+"] + [rf"{library.name}_.*\.debian\.tar\.\w+"] * library.patched
    fault = ""
    for suite in library.suites:
        try:
            command = apt(suite, sources)
        except Failed as failed:
            raise Missing(f"Debian's index cannot be fetched: {failed}") from None
        listed = run(*command, "source", "--print-uris", library.name)
        files = [re.fullmatch(r"'(\S+)' (\S+) \d+ SHA256:(\w+)", line.strip()) for line in listed.splitlines()]
        try:
            out = []
            for pattern in wanted:
                uri, name, sha256 = next(f.groups() for f in files if f and re.fullmatch(pattern, f[2]))
                out.append(sources / name)
                download(uri, out[-1], sha256)
            return out
        except (OSError, StopIteration) as error:  # of the network; not in the list
            fault = f"{library.name} of {suite}: {error}"
    raise Missing(fault)


def fetch(library, sources):
    """The unpacked sources of a library."""
    folder = sources / library.name
    if folder.exists():
        return
    unpacked = sources / f"{library.name}.part"
    shutil.rmtree(unpacked, ignore_errors=True)
    unpacked.mkdir(parents=True)
    files = archives(library, sources)
    part = ["--wildcards", library.part] if library.part else []
    run("tar", "xf", files[0], "-C", unpacked, "--strip-components=1", *part)
    if library.patched:
        run("tar", "xf", files[1], "-C", unpacked)
        for name in (unpacked / "debian/patches/series").read_text().split():
            change = (unpacked / "debian/patches" / name).read_text(errors="replace")
            # What concerns files that were not unpacked, such as those of the build, is left out.
            pieces = [p for p in re.split(r"(?m)^(?=diff --git |--- a/)", change) if "+++ " in p and target_of(p, unpacked)]
            run("patch", "-p1", "-d", unpacked, input="".join(pieces))
    unpacked.rename(folder)


def target_of(piece, folder):
    return (folder / re.search(r"(?m)^\+\+\+ [^/\s]+/(\S+)", piece)[1]).exists()


def build(prefix, sources, flags):
    for tool, package in TOOLS.items():
        if not shutil.which(tool):
            raise Missing(f"{package} is not installed")
    os.environ.setdefault("NODE_PATH", "/usr/share/nodejs")  # where Debian has acorn, which emscripten needs
    for library in LIBRARIES:
        fetch(library, sources)
    folder = prefix / "build"
    run("emcmake", "cmake", "-S", HERE, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", f"-DSOURCES={sources}",
        f"-DCMAKE_INSTALL_PREFIX={prefix}", f"-DCMAKE_C_FLAGS={flags}", f"-DCMAKE_CXX_FLAGS={flags}")
    run("cmake", "--build", folder)
    run("cmake", "--install", folder)
    for name in HEADERS:
        link = prefix / "include" / name
        if not link.exists():
            link.symlink_to(pathlib.Path("/usr/include") / name)
    shutil.rmtree(folder)


def stamp(flags):
    """Of what the libraries are made by: another one, and they are made again."""
    recipe = b"".join(path.read_bytes() for path in sorted(HERE.glob("*")) if path.is_file())
    return hashlib.sha256(recipe + flags.encode()).hexdigest()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("prefix", type=pathlib.Path, metavar="PREFIX")
    parser.add_argument("--sources", type=pathlib.Path, default=DEFAULT_SOURCES, metavar="FOLDER",
                        help="where downloads are kept (default: build/web/sources)")
    parser.add_argument("--flags", default="", help="for both compilers, such as -fexceptions")
    arguments = parser.parse_args()
    prefix = arguments.prefix.resolve()
    complete, made_by = prefix / "complete", stamp(arguments.flags)
    if complete.exists() and complete.read_text() == made_by:
        return
    shutil.rmtree(prefix, ignore_errors=True)
    try:
        build(prefix, arguments.sources.resolve(), arguments.flags)
        complete.write_text(made_by)
    except Missing as missing:
        print(f"make.py: {missing}", file=sys.stderr)
        sys.exit(SKIPPED)
    except Failed as failed:
        sys.exit(f"make.py: {failed}")


if __name__ == "__main__":
    main()
