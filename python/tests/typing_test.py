"""What type checkers make of the package."""

import ast
import pathlib
import subprocess
import sys

import pytest

import fbs
from fbs import _fbs

# What users write, and the types that it must have.
SCRIPT = """
import numpy as np
import fbs

with fbs.Decoder("talk.fbs", threads=2) as decoder:
    for picture in decoder:
        reveal_type(picture.rgb())
    reveal_type(decoder.states.yaw)
    state = decoder.edited(yaw=10)
    if state is not None:
        reveal_type(decoder.render(state))
encoder = fbs.Encoder(64, 64, fps=29.97)
for packet in encoder.push(np.zeros((64, 64, 3), np.uint8)):
    reveal_type(packet.key)
reveal_type(fbs.decode("talk.fbs"))
reveal_type(fbs.decode("talk.fbs", "talk.mp4"))
reveal_type(fbs.evaluate("talk.mkv", quality=[30]))
fbs.encode("talk.mkv", "talk.fbs", quality="high")
"""
FOUND = """
ndarray[tuple[Any, ...], dtype[unsignedinteger[_8Bit]]]
ndarray[tuple[Any, ...], dtype[floating[_32Bit]]]
fbs._picture.Picture
bool
ndarray[tuple[Any, ...], dtype[unsignedinteger[_8Bit]]]
pathlib.Path
dict[str, Any]
"""


def test_the_stub_names_what_is_in_the_extension():
    stub = ast.parse((pathlib.Path(fbs.__file__).parent / "_fbs.pyi").read_text())

    def named(body, of):
        names = {n.name for n in body if isinstance(n, (ast.FunctionDef, ast.ClassDef))}
        names |= {n.target.id for n in body if isinstance(n, ast.AnnAssign)}
        assert {n for n in names if not n.startswith("_")} == {n for n in vars(of) if not n.startswith("_")}

    named(stub.body, _fbs)
    for thing in stub.body:
        if isinstance(thing, ast.ClassDef):
            named(thing.body, getattr(_fbs, thing.name))


def mypy(*arguments, cwd):
    command = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", cwd / "cache", *arguments]
    return subprocess.run(command, cwd=cwd, capture_output=True, text=True)


def test_types(tmp_path):
    pytest.importorskip("mypy")
    (tmp_path / "script.py").write_text(SCRIPT)
    (tmp_path / "mypy.ini").write_text("[mypy-pandas.*]\nignore_missing_imports = True\n")
    package = mypy("-m", "fbs", cwd=tmp_path)
    assert package.returncode == 0, package.stdout
    done = mypy("script.py", cwd=tmp_path)
    print(done.stdout)
    revealed = [line.split('"')[1] for line in done.stdout.splitlines() if "Revealed type" in line]
    for expected, found in zip(FOUND.split("\n")[1:], revealed):
        assert expected.split("[")[0] in found
    assert len(revealed) == 7
    errors = [line for line in done.stdout.splitlines() if ": error:" in line]
    assert len(errors) == 1 and 'Argument "quality"' in errors[0]
