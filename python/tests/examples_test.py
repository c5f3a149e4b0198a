"""The examples of the docstrings, and that everything has one line at least."""

import doctest
import inspect
import re
import subprocess
import sys

import numpy as np
import pytest
from conftest import SOURCE

import fbs

@pytest.mark.parametrize("name", fbs.__all__)
def test_examples(name, talker, tmp_path, monkeypatch):
    for file in ("talk.y4m", "talk.fbs"):
        (tmp_path / file).symlink_to(talker / file)
    monkeypatch.chdir(tmp_path)
    names = {"fbs": fbs, "np": np, "stream": (talker / "talk.fbs").read_bytes()}
    runner = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS)
    for example in doctest.DocTestFinder().find(getattr(fbs, name), name, module=False, globs=names):
        said = []
        assert runner.run(example, out=said.append).failed == 0, "".join(said)


def test_the_manual_runs(talker, tmp_path, monkeypatch, capsys):
    """Its blocks of Python, one after the other."""
    monkeypatch.chdir(tmp_path)
    fbs.decode(talker / "talk.fbs", "talk.mkv")
    blocks = re.findall(r"```python\n(.*?)```", (SOURCE / "docs/python.md").read_text(), re.DOTALL)
    assert len(blocks) >= 5
    names = {}
    for block in blocks:
        exec(compile(block, "docs/python.md", "exec"), names)
    assert names["turned"].tobytes() != names["as_sent"].tobytes() != names["higher"].tobytes()
    assert names["picture"].number == len(fbs.decode("again.fbs")) - 1
    assert "cannot read nobody.mkv" in capsys.readouterr().err


def test_the_sample_shows_the_video_again(talker):
    """samples/round_trip.py, which knows nothing of files of ours."""
    source = fbs.decode(talker / "talk.fbs")
    raw = b"".join(picture.tobytes() for picture in fbs.Decoder(talker / "talk.fbs"))
    command = [sys.executable, SOURCE / "samples/round_trip.py", "176", "144", "30"]
    done = subprocess.run(command, input=raw, capture_output=True, check=True)
    assert int(done.stderr.split()[0]) < 4000
    shown, sent = (np.frombuffer(data, np.uint8).astype(float) for data in (done.stdout, raw))
    assert len(shown) == len(source) * 176 * 144 * 3 // 2
    assert np.mean((shown - sent) ** 2) < 50


def test_there_are_examples():
    with_examples = [
        name
        for name in fbs.__all__
        if any(test.examples for test in doctest.DocTestFinder().find(getattr(fbs, name), name, module=False))
    ]
    assert len(with_examples) >= 8, with_examples


def test_all_that_is_public_is_documented():
    for name in fbs.__all__:
        thing = getattr(fbs, name)
        assert inspect.getdoc(thing), name
        if inspect.isclass(thing):
            for member, value in vars(thing).items():
                if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                    assert inspect.getdoc(value), f"{name}.{member}"
            if issubclass(thing, Exception) and not issubclass(thing, Warning):
                assert issubclass(thing, fbs.Error)
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        fbs.nothing
