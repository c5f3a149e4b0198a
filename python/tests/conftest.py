"""Material of the tests: a talker's video, and its stream."""

from __future__ import annotations

import os
import pathlib
import subprocess

import pytest

import fbs

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("FBS_BUILD", SOURCE / "build/release"))
VECTORS = SOURCE / "tests/vectors"
PICTURES = 20


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--keep", help="folder for pictures to be looked at")
    parser.addoption("--pictures", type=int, default=400, help="that the tests of memory decode")


@pytest.fixture(scope="session")
def talker(tmp_path_factory: pytest.TempPathFactory) -> pathlib.Path:
    """A folder with talk.y4m, 20 pictures of 176x144, and talk.fbs."""
    folder = tmp_path_factory.mktemp("talker")
    command = [BUILD / "talker", folder / "talk.y4m", "--size", "176x144", "--frames", str(PICTURES)]
    subprocess.run(command, check=True)
    fbs.encode(folder / "talk.y4m", folder / "talk.fbs")
    return folder


@pytest.fixture
def video(talker: pathlib.Path) -> pathlib.Path:
    return talker / "talk.y4m"


@pytest.fixture
def stream(talker: pathlib.Path) -> pathlib.Path:
    return talker / "talk.fbs"
