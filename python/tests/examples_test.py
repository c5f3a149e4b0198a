"""The examples of the docstrings, and that everything has one line at least."""

import doctest
import inspect

import numpy as np
import pytest

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
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        fbs.nothing
