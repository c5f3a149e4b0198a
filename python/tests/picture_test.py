"""Pictures, and their colours."""

import subprocess

import numpy as np
import pytest
from conftest import VECTORS

import fbs
from fbs import _program


def png_pixels(path, width, height):
    command = ["ffmpeg", "-v", "error", "-nostdin", "-i", path, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
    done = subprocess.run(command, check=True, capture_output=True)
    return np.frombuffer(done.stdout, np.uint8).reshape(height, width, 3)


@pytest.mark.parametrize("matrix, full_range", [("unspecified", False), ("bt709", False), ("bt601", True)])
def test_rgb_is_that_of_the_program(tmp_path, video, matrix, full_range):
    colours = {"matrix": matrix, "full_range": full_range}
    pictures = list(fbs.Decoder(VECTORS / "odd.fbs"))[:2]
    encoder = fbs.Encoder(pictures[0].width, pictures[0].height, allow_no_face=True, **colours)
    packets = [packet for picture in pictures for packet in encoder.push(picture.planes)] + encoder.finish()
    (tmp_path / "odd.fbs").write_bytes(b"".join(packets))
    picture = next(fbs.Decoder(tmp_path / "odd.fbs"))
    assert (picture.matrix, picture.full_range) == (matrix, full_range)
    _program.run(["decode", tmp_path / "odd.fbs", tmp_path / "%d.png", "--quiet"])
    expected = png_pixels(min(tmp_path.glob("*.png")), picture.width, picture.height)
    np.testing.assert_array_equal(picture.rgb(), expected)


def test_the_png_of_a_notebook_has_the_same_pixels(tmp_path, stream):
    picture = next(fbs.Decoder(stream))
    (tmp_path / "picture.png").write_bytes(picture._repr_png_())
    np.testing.assert_array_equal(png_pixels(tmp_path / "picture.png", 176, 144), picture.rgb())


@pytest.mark.parametrize("matrix", ["bt601", "bt709"])
@pytest.mark.parametrize("full_range", [False, True])
def test_colours_come_back(matrix, full_range):
    colours = [(0, 0, 0), (255, 255, 255), (255, 0, 0), (0, 255, 0), (0, 0, 255), (17, 130, 201)]
    rgb = np.repeat(np.repeat(np.array([colours], np.uint8), 66, axis=0), 12, axis=1)  # 72 wide
    picture = fbs.Picture.from_rgb(rgb, matrix=matrix, full_range=full_range)
    assert np.abs(picture.rgb().astype(int) - rgb).max() <= 2
    black = 0 if full_range else 16
    assert picture.y[0, 0] == black and picture.y[0, 12] == (255 if full_range else 235)


def test_rgb_of_any_layout():
    rng = np.random.default_rng(1)
    rgb = rng.integers(0, 256, (67, 71, 3), np.uint8)  # odd sides
    expected = fbs.Picture.from_rgb(rgb).tobytes()
    for same in (rgb[::-1].copy()[::-1], np.asfortranarray(rgb), rgb[:, :, ::-1].copy()[:, :, ::-1]):
        assert fbs.Picture.from_rgb(same).tobytes() == expected
    out = np.zeros((67, 100, 3), np.uint8)
    picture = fbs.Picture.from_rgb(rgb)
    picture.rgb(out=out[:, 29:])
    np.testing.assert_array_equal(out[:, 29:], picture.rgb())
    np.testing.assert_array_equal(np.asarray(picture, float), picture.rgb())
    assert not out[:, :29].any()


@pytest.mark.parametrize(
    "wrong", [np.zeros((70, 70), np.uint8), np.zeros((70, 70, 4), np.uint8), np.zeros((70, 70, 3)), "talk.png"]
)
def test_what_is_no_picture_is_refused(wrong):
    with pytest.raises(fbs.ArgumentError, match="RGB picture is an"):
        fbs.Picture.from_rgb(wrong)


def test_small_pictures_and_unknown_matrices_are_refused():
    with pytest.raises(fbs.ArgumentError, match="64 to 8192"):
        fbs.Picture.from_rgb(np.zeros((63, 64, 3), np.uint8))
    with pytest.raises(fbs.ArgumentError, match="bt2020"):
        fbs.Picture.empty(64, 64, matrix="bt2020")
    plane = np.zeros((64, 64), np.uint8)
    for wrong in (plane.astype(float), plane[0], plane.tolist()):
        with pytest.raises(fbs.ArgumentError, match="a plane is a 2-D array of uint8, not"):
            fbs.Picture(plane, wrong, plane)
    with pytest.raises(fbs.ArgumentError, match="planes are"):
        fbs.Picture(plane, plane, plane).rgb()
    with pytest.raises(fbs.ArgumentError, match="not .* of float64"):
        fbs.Picture.empty(64, 64).rgb(out=np.zeros((64, 64, 3)))
    with pytest.raises(fbs.ArgumentError, match="differ in size"):
        fbs.Picture.from_rgb(np.zeros((64, 64, 3), np.uint8)).rgb(out=np.zeros((64, 65, 3), np.uint8))
