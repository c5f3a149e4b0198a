"""try.py WHEELS FOLDER: tries the installed package with FOLDER's talk.y4m and talk.mp4, and prints a line of the table."""

import os
import pathlib
import subprocess
import sys
import tempfile
import time

wheels, material = map(pathlib.Path, sys.argv[1:])
version = "%d.%d" % sys.version_info[:2]
start = time.perf_counter()
import fbs  # noqa: E402

fbs.Decoder  # which loads the extension
imported = time.perf_counter() - start


def timed(function, *arguments):
    begin = time.perf_counter()
    return function(*arguments), time.perf_counter() - begin


tag = "cp" + version.replace(".", "") if sys.version_info < (3, 12) else "abi3"
(wheel,) = wheels.glob(f"fbs_codec-*-{tag}-*.whl" if tag != "abi3" else "fbs_codec-*-abi3-*.whl")
package = pathlib.Path(fbs.__file__).parent
parts = [*package.rglob("*"), *(package.parent / "fbs_codec.libs").rglob("*")]
installed = sum(part.stat().st_size for part in parts if part.is_file()) / 1e6

with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    _, encode_s = timed(fbs.encode, material / "talk.y4m", "talk.fbs")
    pictures, decode_s = timed(lambda: list(fbs.Decoder("talk.fbs")))
    assert len(pictures) == len(fbs.Decoder("talk.fbs").states.time) == 100
    assert fbs.track(material / "talk.y4m", frames=3)["success"].sum() == 3
    try:
        fbs.encode(material / "talk.mp4", "other.fbs")
        sys.exit("a bare environment reads .mp4")
    except fbs.UnsupportedError:
        pass
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--only-binary", ":all:", "av>=12"]
    if subprocess.run(pip, capture_output=True).returncode == 0:
        fbs.encode(material / "talk.mp4", "other.fbs")
        fbs.decode("other.fbs", "other.mp4")
        fbs.encode("other.mp4", "again.fbs")
        assert len(list(fbs.Decoder("again.fbs"))) == 100
        video = "yes"
    else:
        video = "no wheel of PyAV"
    size = os.path.getsize("talk.fbs")

print(
    f"{version:7} {wheel.name[:48]:48} {wheel.stat().st_size / 1e6:6.1f} {installed:9.1f} {imported * 1000:9.0f}"
    f" {encode_s:9.1f} {size:8} {100 / decode_s:10.0f}  {video}"
)
