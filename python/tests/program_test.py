"""Whole files, through the program."""

import os
import pickle
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from conftest import PICTURES, VECTORS

import fbs
from fbs import _program


@pytest.fixture(scope="module")
def long_video(talker):
    """A minute, which no test waits for."""
    head, _, pictures = (talker / "talk.y4m").read_bytes().partition(b"\n")
    path = talker / "long.y4m"
    path.write_bytes(head + b"\n" + 90 * pictures)
    return path


def test_the_package_brings_its_program():
    assert _program.program().startswith(os.path.dirname(fbs.__file__)) or "FBS_PROGRAM" in os.environ
    command = os.path.join(os.path.dirname(sys.executable), "fbs")
    assert subprocess.check_output([command, "--version"], text=True) == f"fbs {fbs.__version__}\n"


def test_without_a_program(monkeypatch):
    monkeypatch.setenv("FBS_PROGRAM", "/nowhere/fbs")
    with pytest.raises(fbs.ProgramMissingError, match="/nowhere/fbs"):
        _program.run(["--version"])


def test_progress_is_told(video, tmp_path):
    told = []
    path = fbs.encode(video, tmp_path / "a.fbs", on_progress=lambda done, total: told.append((done, total)))
    assert told[-1] == (PICTURES, PICTURES) and told == sorted(told)
    assert fbs.inspect(path)["frames"] == PICTURES


def test_an_exception_in_progress_ends_the_program(long_video, tmp_path):
    class Enough(Exception):
        pass

    def stop(done, total):
        raise Enough

    began = time.monotonic()
    with pytest.raises(Enough):
        fbs.encode(long_video, tmp_path / "a.fbs", on_progress=stop)
    assert list(tmp_path.iterdir()) == [] and time.monotonic() - began < 20


def test_ctrl_c_ends_the_program_and_leaves_nothing(long_video, tmp_path):
    script = "import fbs, sys; fbs.encode(sys.argv[1], sys.argv[2], on_progress=lambda *n: print(n, flush=True))"
    python = subprocess.Popen(
        [sys.executable, "-c", script, long_video, tmp_path / "a.fbs"], stdout=subprocess.PIPE, stderr=subprocess.PIPE
    )
    python.stdout.readline()
    python.send_signal(signal.SIGINT)
    _, log = python.communicate(timeout=20)
    assert b"KeyboardInterrupt" in log
    assert list(tmp_path.iterdir()) == []


def test_too_little_time(long_video):
    with pytest.raises(fbs.ProgramTimeoutError, match="more than 0.1 s"):
        _program.run(["track", long_video, "-"], timeout=0.1)
    with pytest.raises(TimeoutError):
        _program.run(["track", long_video, "-"], timeout=0.1)


def test_errors_have_their_class_and_the_text_of_the_program(video, stream, tmp_path):
    grey = tmp_path / "grey.y4m"
    grey.write_bytes(b"YUV4MPEG2 W64 H64 F25:1 C420jpeg\n" + 3 * (b"FRAME\n" + bytes([128]) * (64 * 64 * 3 // 2)))
    out = tmp_path / "out.fbs"
    for error, says, call in [
        (fbs.FileError, "none.mkv: No such file", lambda: fbs.encode(tmp_path / "none.mkv", out)),
        (fbs.FileError, "none", lambda: fbs.encode(video, tmp_path / "none" / "out.fbs")),
        (fbs.UnsupportedError, "it is an fbs stream", lambda: fbs.encode(stream, out)),
        (fbs.ArgumentError, "quality", lambda: fbs.encode(video, out, quality=101)),
        (fbs.NoFaceError, "no face", lambda: fbs.encode(grey, out)),
        (fbs.NoFaceError, "no face", lambda: fbs.track(grey)),
        (fbs.NotFbsError, "not an fbs stream", lambda: fbs.inspect(video)),
        (fbs.NotFbsError, "not an fbs stream", lambda: fbs.decode(video, tmp_path / "out.mp4")),
        (fbs.DamagedError, "checksum|damaged", lambda: fbs.decode(VECTORS / "flipped_bits.fbs", tmp_path / "out.y4m")),
        (fbs.NotFbsError, "not an fbs stream", lambda: fbs.retarget(video, stream, out)),
        (fbs.FileError, "none", lambda: fbs.evaluate(tmp_path / "none.mkv")),
    ]:
        with pytest.raises(error, match=says) as raised:
            call()
        assert type(raised.value) is error and raised.value.exit_code == 2
        assert str(raised.value) in raised.value.log
    assert list(tmp_path.iterdir()) == [grey]


def test_a_crash_is_an_error(monkeypatch, tmp_path):
    crashing = tmp_path / "fbs"
    crashing.write_text("#!/bin/sh\nkill -SEGV $$\n")
    crashing.chmod(0o755)
    monkeypatch.setenv("FBS_PROGRAM", str(crashing))
    with pytest.raises(fbs.Error, match="ended by SIGSEGV") as raised:
        _program.run([])
    assert raised.value.exit_code == -signal.SIGSEGV


def test_a_source_that_is_cut_off_is_a_warning(video, tmp_path):
    cut = tmp_path / "cut.y4m"
    cut.write_bytes(video.read_bytes()[:-1000])
    with pytest.warns(fbs.PartialWarning, match=f"the {PICTURES - 1} pictures before are encoded"):
        path = fbs.encode(cut, tmp_path / "cut.fbs")
    assert len(fbs.Decoder(path).states) == PICTURES - 1


def test_names_that_look_like_options(video, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "--quality").write_bytes(video.read_bytes())
    fbs.encode("--quality", "-.fbs", options=["--frames", "3"])
    assert fbs.inspect("-.fbs")["frames"] == 3


def test_decoding_to_a_file_and_retargeting(stream, tmp_path):
    path = fbs.decode(stream, tmp_path / "a.y4m", options=["--from", "0.5"])
    assert path.read_bytes().count(b"FRAME\n") == PICTURES - 15
    talks = fbs.retarget(stream, stream, tmp_path / "b.fbs")
    assert len(fbs.Decoder(talks).states) == PICTURES
    np.testing.assert_allclose(fbs.Decoder(talks).states.yaw, fbs.Decoder(stream).states.yaw, atol=1)


def test_evaluation_is_a_dictionary(video, stream):
    told = []
    result = fbs.evaluate(video, stream, on_progress=lambda *n: told.append(n))
    (point,) = result["points"]
    assert point["frames"] == PICTURES and 20 < point["psnr_frame"] < 50
    assert point["bytes"]["total"] == stream.stat().st_size
    assert told[-1][0] == PICTURES


def test_results_and_errors_go_from_process_to_process(stream):
    decoder = fbs.Decoder(stream)
    picture = next(decoder)
    with pytest.raises(fbs.FileError) as raised:
        fbs.inspect("/nowhere.fbs")
    for thing in (picture, decoder.state, decoder.states, decoder.info, decoder.format, raised.value):
        again = pickle.loads(pickle.dumps(thing))
        assert type(again) is type(thing) and str(again) == str(thing)
    assert again.exit_code == 2 and again.log == raised.value.log


def test_no_descriptor_stays_open(stream):
    def open_files():
        return len(os.listdir("/proc/self/fd"))

    fbs.inspect(stream)
    before = open_files()
    for _ in range(3):
        fbs.inspect(stream)
        with pytest.raises(fbs.Error):
            fbs.inspect("/nowhere.fbs")
    assert open_files() == before
