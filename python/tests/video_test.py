"""Videos where the program has no FFmpeg. PyAV and OpenCV are no requirement here: python/wheels/build.sh tries PyAV."""

from fractions import Fraction

import pytest

import fbs
from fbs import _program, _video


@pytest.fixture
def bare(monkeypatch):
    """A program without FFmpeg."""
    monkeypatch.setattr(_program, "lacks", lambda module: module == "fbs_av")
    monkeypatch.setattr(_video, "_module", lambda name: None)


def test_pictures_go_to_the_program_as_y4m(stream, tmp_path, monkeypatch, bare):
    pictures = list(fbs.Decoder(stream))
    fbs.decode(stream, tmp_path / "talk.y4m")
    fbs.encode(tmp_path / "talk.y4m", tmp_path / "expected.fbs")
    table = fbs.track(tmp_path / "talk.y4m", frames=3)

    monkeypatch.setattr(_video, "_pictures", lambda name: ((Fraction(30), picture) for picture in pictures))
    fbs.encode("talk.mp4", tmp_path / "talk.fbs")
    assert (tmp_path / "talk.fbs").read_bytes() == (tmp_path / "expected.fbs").read_bytes()
    assert list(fbs.track("talk.mp4", frames=3)["rx_deg"]) == list(table["rx_deg"])
    assert fbs.evaluate("talk.mp4", tmp_path / "talk.fbs")["points"][0]["frames"] == len(pictures)


def test_a_fault_of_the_reader_ends_the_program(stream, tmp_path, monkeypatch, bare):
    def pictures(name):
        for picture in fbs.Decoder(stream):
            yield Fraction(30), picture
            if picture.number == 3:
                raise fbs.FileError(f"{name} is damaged")

    monkeypatch.setattr(_video, "_pictures", pictures)
    with pytest.raises(fbs.FileError, match="talk.mp4 is damaged"):
        fbs.encode("talk.mp4", tmp_path / "talk.fbs")
    assert list(tmp_path.iterdir()) == []


def test_without_a_reader_it_says_what_to_install(stream, tmp_path, bare):
    (tmp_path / "talk.mp4").write_bytes(b"")
    with pytest.raises(fbs.UnsupportedError, match=r"pip install 'fbs-codec\[av\]'"):
        fbs.encode(tmp_path / "talk.mp4", tmp_path / "talk.fbs")
    with pytest.raises(fbs.UnsupportedError, match=r"pip install 'fbs-codec\[av\]'"):
        fbs.decode(stream, tmp_path / "out.mp4")
    with pytest.raises(fbs.FileError, match="cannot read nothing.mkv: No such file"):
        fbs.track("nothing.mkv")
