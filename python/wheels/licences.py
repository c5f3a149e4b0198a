"""licences.py FOLDER: puts the licences of what was bundled into an unpacked wheel's .dist-info/licenses.

FOLDER is of a wheel that auditwheel has made portable from libraries of Debian. `bundled` there lists each library with the
package that it comes from, and `PACKAGE.txt` has the terms of that package. Packages whose headers or static libraries are
compiled in, and nanobind, have such a file too, and so has each licence that one of these files refers to.
"""

import importlib.metadata
import pathlib
import re
import subprocess
import sys

COMPILED_IN = "libcli11-dev libexpected-dev libglm-dev libtinygltf-dev nlohmann-json3-dev libhwy-dev libdraco-dev".split()
COMMON = pathlib.Path("/usr/share/common-licenses")


def package_of(library):
    """The Debian package that has libNAME.so.N, which auditwheel calls libNAME-HASH.so.N."""
    name = re.sub(r"-[0-9a-f]{8}(?=\.)", "", library)
    found = subprocess.run(["dpkg", "-S", f"*/{name}"], capture_output=True, text=True).stdout.splitlines()
    packages = {line.split(":")[0] for line in found if not line.startswith("diversion")}
    if not packages:
        sys.exit(f"no package of Debian has {name}")
    return min(packages)


(info,) = pathlib.Path(sys.argv[1]).glob("*.dist-info")
folder = info / "licenses"
folder.mkdir(exist_ok=True)
bundled = {path.name: package_of(path.name) for path in sorted(info.parent.glob("*.libs/*"))}
(folder / "bundled").write_text("".join(f"{library} {package}\n" for library, package in bundled.items()))
common = set()
for package in sorted({*bundled.values(), *COMPILED_IN}):
    text = pathlib.Path("/usr/share/doc", package, "copyright").read_text(errors="replace")
    (folder / f"{package}.txt").write_text(text)
    common.update(re.findall(rf"{COMMON}/([\w+-]+(?:\.\d+)*)", text))
for path in importlib.metadata.files("nanobind"):
    if path.name.startswith("LICENSE"):
        (folder / "nanobind.txt").write_text(path.read_text())
for name in sorted(common):
    terms = COMMON / name if (COMMON / name).exists() else COMMON / name.removesuffix(".0")  # some say GPL-2.0 for GPL-2
    (folder / f"common-{name}.txt").write_text(terms.read_text())
