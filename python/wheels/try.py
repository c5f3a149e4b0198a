"""try.py DISTRIBUTION FOLDER: tries the package that was installed from DISTRIBUTION, a wheel of build.sh or an sdist, with
FOLDER's talk.y4m and talk.mp4, and prints a line of the table."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

distribution, material = map(pathlib.Path, sys.argv[1:])
version = "%d.%d" % sys.version_info[:2]
start = time.perf_counter()
import fbs  # noqa: E402

fbs.Decoder  # which loads the extension
imported = time.perf_counter() - start


def timed(function, *arguments):
    begin = time.perf_counter()
    return function(*arguments), time.perf_counter() - begin


portable = distribution.suffix == ".whl"
package = pathlib.Path(fbs.__file__).parent
libraries = package.parent / "fbs_codec.libs"
parts = [*package.rglob("*"), *libraries.rglob("*")]
installed = sum(part.stat().st_size for part in parts if part.is_file()) / 1e6

(info,) = package.parent.glob("fbs_codec-*.dist-info")
licences = {path.relative_to(info / "licenses").as_posix(): path.read_text() for path in (info / "licenses").rglob("*") if path.is_file()}
assert "The fbs authors" in licences["LICENSE"]
if portable:
    bundled = dict(line.split() for line in licences["bundled"].splitlines())
    assert bundled.keys() == {path.name for path in libraries.iterdir()}, "a library without a licence"
    assert not any("libav" in name for name in bundled), "FFmpeg was left out"
    terms = {f"{name}.txt": licences[f"{name}.txt"] for name in (*bundled.values(), "nanobind", "libcli11-dev")}
    referred = {name for text in terms.values() for name in re.findall(r"/usr/share/common-licenses/([\w+-]+(?:\.\d+)*)", text)}
    assert all(map(str.strip, terms.values())) and all(licences[f"common-{name}.txt"] for name in referred)

with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    _, encode_s = timed(fbs.encode, material / "talk.y4m", "talk.fbs")
    pictures, decode_s = timed(lambda: list(fbs.Decoder("talk.fbs")))
    assert len(pictures) == len(fbs.Decoder("talk.fbs").states.time) == 100
    assert fbs.track(material / "talk.y4m", frames=3)["success"].sum() == 3
    try:
        fbs.encode(material / "talk.mp4", "other.fbs")
        assert not portable, "a bare environment reads .mp4"
    except fbs.UnsupportedError:
        assert portable, "FFmpeg was left out"
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--only-binary", ":all:", "av>=12"]
    video = "FFmpeg" if not portable else "PyAV" if subprocess.run(pip, capture_output=True).returncode == 0 else "no wheel of PyAV"
    if not video.startswith("no"):
        fbs.encode(material / "talk.mp4", "other.fbs")
        fbs.decode("other.fbs", "other.mp4")
        fbs.encode("other.mp4", "again.fbs")
        assert len(list(fbs.Decoder("again.fbs"))) == 100
    size = os.path.getsize("talk.fbs")

print(
    f"{version:7} {distribution.name[:52]:52} {distribution.stat().st_size / 1e6:6.1f} {installed:9.1f} {len(licences):9}"
    f" {imported * 1000:9.0f}"
    f" {encode_s:9.1f} {size:8} {100 / decode_s:10.0f}  {video}"
)
