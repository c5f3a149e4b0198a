#!/usr/bin/env python3
"""Decodes the test vectors by many builds of the decoder: run.py [--list] [NAME...].

Each build compiles common, bitstream and decoder anew, with its own compiler, options and processor, and its pictures
must have the MD5s of tests/vectors/vectors.txt. NAME may be a pattern such as 'gcc*'. What a machine lacks is said and left
out: other processors need Debian's cross compilers and qemu-user, and the packages of the libraries for them, which are
downloaded; WebAssembly needs what web/libraries/make.py names. All of that stays in build/exactness. Exit code 1 if a
build fails or a picture differs."""
import argparse
import concurrent.futures
import fnmatch
import os
import pathlib
import shutil
import subprocess
import sys
import time
from dataclasses import dataclass, field

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = ROOT / "build/exactness"
VECTORS = ROOT / "tests/vectors"
PACKAGES = ("libdav1d6", "libdav1d-dev", "libhwy1", "libhwy-dev", "libdraco7", "libdraco-dev", "libc6", "libstdc++6",
            "libgcc-s1")
WARNINGS = ["-Wall", "-Wextra", "-Werror"]
WITHOUT_VECTORS = ["-fno-tree-loop-vectorize", "-Wno-psabi"]  # as decoder/CMakeLists.txt has it


class Missing(Exception):
    """What a build needs and the machine lacks."""


@dataclass
class Machine:
    """What a processor is called by whom."""
    gnu: str
    debian: str
    qemu: str
    loader: str


I686 = Machine("i686", "i386", "i386", "ld-linux.so.2")
AARCH64 = Machine("aarch64", "arm64", "aarch64", "ld-linux-aarch64.so.1")
S390X = Machine("s390x", "s390x", "s390x", "ld64.so.1")  # its words have the high byte first


@dataclass
class Build:
    name: str
    compiler: str
    options: list = field(default_factory=list)
    debian: str = ""  # architecture of the libraries, if it is another one
    run: list = field(default_factory=list)  # what runs the program

    def prepare(self):
        """Options for compiler and linker."""
        if not self.debian:
            return [], ["-ldav1d", "-ldraco", "-lhwy"], self.run
        root = sysroot(self.debian)
        [folder] = {path.parent for path in root.glob("usr/lib/*/libdav1d.so")}
        # From the root only the headers of the three libraries: those of C and C++ come with the cross compiler.
        headers = root / "headers"
        headers.mkdir(exist_ok=True)
        for library in ("dav1d", "draco", "hwy"):
            if not (headers / library).exists():
                (headers / library).symlink_to(next(root.glob(f"usr/include/**/{library}")))
        for library in ("glm", "tl"):
            if not (headers / library).exists():
                (headers / library).symlink_to(pathlib.Path("/usr/include") / library)
        run = [part.format(root=root, libraries=folder) for part in self.run]
        link = [f"-L{folder}", f"-Wl,-rpath-link,{folder}", "-ldav1d", "-ldraco", "-lhwy"]
        return [f"-isystem{headers}"], link, run


class WebAssembly(Build):
    def prepare(self):
        prefix = web_libraries()
        headers = prefix / "include"
        link = [str(prefix / "lib/libdav1d.a"), str(prefix / "lib/libdraco.a"), "-sALLOW_MEMORY_GROWTH=1", "-sNODERAWFS=1",
                "-sEXIT_RUNTIME=1", "-fexceptions", "-sSTACK_SIZE=4MB" if stack_option() else "-sTOTAL_STACK=4MB"]
        return [f"-isystem{headers}", "-fexceptions"], link, self.run


def all_builds():
    out = []
    for name, compiler in (("gcc", "g++"), ("clang", "clang++")):
        for level in "0123":
            out.append(Build(f"{name}-O{level}", compiler, [f"-O{level}"]))
    out.append(Build("gcc-Os-m-native-fast-math", "g++", ["-Os", "-march=native", "-ffast-math"]))
    # One kind of vectors each, which the compiler may use as well. (Otherwise they are chosen when the program runs.)
    fixed = "-DHWY_COMPILE_ONLY_STATIC"
    for target, options in {
            "sse2": [], "ssse3": ["-mssse3"], "sse4": ["-msse4.2", "-mpclmul", "-maes"],
            "avx2": ["-march=haswell", "-maes"],
            "avx3": ["-march=skylake-avx512"], "avx3_dl": ["-march=icelake-server"]}.items():
        out.append(Build(f"gcc-{target}", "g++", ["-O2", fixed, *options]))
    out.append(Build("gcc-scalar", "g++", ["-O2", "-DHWY_COMPILE_ONLY_SCALAR"]))
    out.append(Build("clang-emulated-vectors", "clang++", ["-O2", "-DHWY_COMPILE_ONLY_EMU128"]))
    for name, options, machine in (("i686-gcc", WITHOUT_VECTORS, I686), ("i686-gcc-sse2", ["-msse2"], I686),
                                   ("aarch64-gcc", [], AARCH64), ("s390x-gcc", WITHOUT_VECTORS, S390X)):
        # The program is loaded by the loader of the downloaded C library.
        run = [f"qemu-{machine.qemu}", "-L", "{root}", "{root}/lib/" + machine.loader, "--library-path",
               "{libraries}:{root}/lib/" + machine.qemu + "-linux-gnu"]
        out.append(Build(name, f"{machine.gnu}-linux-gnu-g++", ["-O2", *options], machine.debian, run))
    out.append(WebAssembly("webassembly", "em++", ["-O2"], run=["node", "--no-experimental-fetch"]))  # reads files
    return out


def command(*arguments, **options):
    done = subprocess.run([str(a) for a in arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          errors="replace", check=False, **options)
    if done.returncode != 0:
        raise Missing(f"{pathlib.Path(str(arguments[0])).name} failed:\n" + "\n".join(done.stdout.splitlines()[-12:]))
    return done.stdout


def sysroot(architecture):
    """The libraries' packages of another architecture, unpacked."""
    root = BUILD / "root" / architecture
    if (root / "complete").exists():
        return root
    packages = root / "packages"
    packages.mkdir(parents=True, exist_ok=True)
    if architecture not in command("dpkg", "--print-foreign-architectures").split():
        raise Missing(f"packages of {architecture}: dpkg --add-architecture {architecture} && apt-get update")
    command("apt-get", "download", *[f"{package}:{architecture}" for package in PACKAGES], cwd=packages)
    for package in packages.glob("*.deb"):
        command("dpkg", "-x", package, root)
    (root / "complete").touch()
    return root


def stack_option():
    """Whether this emscripten has -sSTACK_SIZE."""
    version = command("em++", "--version").split("(Emscripten")[1].split(")")[1].split()[0].split("-")[0]
    return tuple(int(part) for part in version.split(".")[:3]) >= (3, 1, 27)


def web_libraries():
    """The libraries for WebAssembly, as the player in a browser has them but with exceptions."""
    prefix = BUILD / "web"
    command(sys.executable, ROOT / "web/libraries/make.py", prefix, "--flags=-fexceptions")
    return prefix


def sources():
    tools = {"head_table_tool.cpp"}
    beside = {ROOT / "decoder/export", ROOT / "decoder/sound"}  # what needs more libraries, and draws nothing
    found = [path for folder in ("common", "bitstream", "decoder") for path in sorted((ROOT / folder).rglob("*.cpp"))]
    found = [path for path in found if path.name not in tools and path.parent not in beside]
    return found + [VECTORS / "stream_digest.cpp", VECTORS / "stream_md5.cpp"]


def decode(build, pool):
    """Builds and runs: the last line of what the program says."""
    if not shutil.which(build.compiler):
        raise Missing(build.compiler)
    compile_options, link_options, run = build.prepare()
    if run and not shutil.which(run[0]):
        raise Missing(run[0])
    folder = BUILD / build.name
    folder.mkdir(parents=True, exist_ok=True)

    def compiled(source):
        out = folder / (str(source.relative_to(ROOT)).replace("/", "_") + ".o")
        launcher = ["ccache"] if shutil.which("ccache") and build.compiler != "em++" else []
        command(*launcher, build.compiler, "-std=c++20", *WARNINGS, *build.options, *compile_options, f"-I{ROOT}", "-c", source,
                "-o", out)
        return out

    objects = list(pool.map(compiled, sources()))
    program = folder / ("stream_md5.js" if build.compiler == "em++" else "stream_md5")
    command(build.compiler, *build.options, *objects, *link_options, "-o", program)
    done = subprocess.run([*run, program, VECTORS], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          errors="replace", check=False)
    lines = done.stdout.splitlines() or [f"nothing was printed, exit code {done.returncode}"]
    return done.returncode == 0, lines[-1]


def main():
    os.environ.setdefault("NODE_PATH", "/usr/share/nodejs")  # where Debian has acorn, which emscripten needs
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--list", action="store_true", help="print the names of all builds")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    arguments = parser.parse_args()
    chosen = [b for b in all_builds() if not arguments.names or any(fnmatch.fnmatch(b.name, n) for n in arguments.names)]
    if arguments.list:
        return print("\n".join(b.name for b in chosen))
    if not chosen:
        sys.exit("run.py: no such build; --list prints them")
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for build in chosen:
            begin = time.monotonic()
            try:
                same, said = decode(build, pool)
                failed += not same
            except Missing as missing:
                said = f"not run: {missing}"
                failed += "failed" in said
            options = " ".join(build.options)
            print(f"{build.name:<28}{options:<50}{said} ({time.monotonic() - begin:.0f} s)", flush=True)
    return sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
