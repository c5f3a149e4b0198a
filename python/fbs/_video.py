"""Videos by PyAV or OpenCV, where the package's program has no FFmpeg.

The wheels leave FFmpeg out, which is three times as large as all of fbs. What the program cannot read then goes to it as
Y4M, and what it cannot write is drawn here.
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from fbs import _program
from fbs._picture import Picture
from fbs.errors import FileError, UnsupportedError

if TYPE_CHECKING:
    from fbs._decoder import Decoder
    from fbs._program import PathLike

_OWN_KINDS = (".fbs", ".y4m", ".wav")  # that the program knows without help
_AV_BT709, _AV_BT601 = (1,), (5, 6)  # of AVColorSpace


def is_foreign(path: PathLike) -> bool:
    """Whether the program needs help with a video."""
    name = os.fspath(path)
    own = name == "-" or name.startswith("camera:") or name.endswith(_OWN_KINDS) or os.path.isdir(name)
    return not own and _program.lacks("fbs_av")


def has_sound(path: PathLike) -> bool:
    """Whether a video has sound, as far as can be told."""
    av = _module("av")
    if av is None:
        return False
    try:
        with av.open(os.fspath(path)) as file:
            return len(file.streams.audio) > 0
    except (av.error.FFmpegError, OSError):
        return False


def as_y4m(path: PathLike) -> Iterator[bytes]:
    """Read a video, as Y4M, picture by picture. The first one is read at once.

    Raises
    ------
    FileError
        It cannot be read, or has no pictures.
    UnsupportedError
        Neither PyAV nor OpenCV is installed.
    """
    pictures = _pictures(os.fspath(path))
    try:
        rate, first = next(pictures)
    except StopIteration:
        raise FileError(f"cannot read {os.fspath(path)}: no pictures") from None

    def pieces() -> Iterator[bytes]:
        matrix = "" if first.matrix == "unspecified" else f" XMATRIX={first.matrix.upper()}"
        yield (
            f"YUV4MPEG2 W{first.width} H{first.height} F{rate.numerator}:{rate.denominator} Ip A1:1 C420mpeg2"
            f" XCOLORRANGE=LIMITED{matrix}\n"
        ).encode()
        yield b"FRAME\n" + first.tobytes()
        for _, picture in pictures:
            yield b"FRAME\n" + picture.tobytes()

    return pieces()


@contextmanager
def readable(path: PathLike, most: int | None = None) -> Iterator[str]:
    """A name of the video for the program: its own, or that of a temporary file with at most so many pictures."""
    if not is_foreign(path):
        yield _program.argument(path)
        return
    with tempfile.TemporaryDirectory(prefix="fbs-") as folder:
        name = os.path.join(folder, Path(path).stem + ".y4m")
        with open(name, "wb") as file:
            for number, piece in enumerate(as_y4m(path)):
                if most is not None and number > most:
                    break
                file.write(piece)
        yield name


def write(path: PathLike, decoder: Decoder) -> None:
    """Write the pictures of a decoder to a video, in H.264 or by OpenCV in MPEG-4, without sound."""
    part = Path(path).with_name(f".{Path(path).stem}.part{Path(path).suffix}")
    try:
        (_write_by_av if _module("av") else _write_by_opencv)(str(part), decoder)
        os.replace(part, path)
    except (OSError, ValueError) as problem:
        raise FileError(f"cannot write {os.fspath(path)}: {problem}") from problem
    finally:
        part.unlink(missing_ok=True)


def _module(name: str) -> Any:
    try:
        return __import__(name)
    except ImportError:
        return None


def _pictures(name: str) -> Iterator[tuple[Fraction, Picture]]:
    if not os.path.exists(name) and "%" not in name and "://" not in name:
        raise FileError(f"cannot read {name}: No such file or directory")
    if _module("av"):
        return _by_av(name)
    if _module("cv2"):
        return _by_opencv(name)
    raise UnsupportedError(f"{name}: this package reads .y4m alone; pip install 'fbs-codec[av]' or 'fbs-codec[opencv]'")


def _by_av(name: str) -> Iterator[tuple[Fraction, Picture]]:
    av = _module("av")
    try:
        with av.open(name) as file:
            if not file.streams.video:
                raise FileError(f"cannot read {name}: no pictures")
            stream = file.streams.video[0]
            rate = Fraction(stream.average_rate or stream.guessed_rate or 25)
            for frame in file.decode(stream):
                yield rate, _of_frame(frame)
    except (av.error.FFmpegError, OSError) as problem:
        if isinstance(problem, FileError):
            raise
        raise FileError(f"cannot read {name}: {problem}") from problem


def _of_frame(frame: Any) -> Picture:
    space = int(frame.colorspace)
    matrix = "bt709" if space in _AV_BT709 else "bt601" if space in _AV_BT601 else "unspecified"
    turns = round(getattr(frame, "rotation", 0) / 90)  # of a phone, anticlockwise
    planes = [
        np.rot90(np.frombuffer(plane, np.uint8).reshape(plane.height, plane.line_size)[:, : plane.width], turns)
        for plane in frame.reformat(format="yuv420p", dst_color_range="MPEG").planes
    ]
    return Picture(*planes, matrix=matrix)


def _by_opencv(name: str) -> Iterator[tuple[Fraction, Picture]]:
    cv2 = _module("cv2")
    video = cv2.VideoCapture(name)
    rate = Fraction(video.get(cv2.CAP_PROP_FPS) or 25).limit_denominator(1001)
    while True:
        there, bgr = video.read()
        if not there:
            return
        yield rate, Picture.from_rgb(np.ascontiguousarray(bgr[:, :, ::-1]))


def _write_by_av(name: str, decoder: Decoder) -> None:
    av = _module("av")
    with av.open(name, "w") as file:
        stream = file.add_stream("libx264", rate=decoder.format.fps, options={"crf": "12"})
        stream.width, stream.height = decoder.format.width, decoder.format.height
        stream.pix_fmt = "yuv420p" if stream.width % 2 == stream.height % 2 == 0 else "yuv444p"
        stream.codec_context.time_base = Fraction(1, 90000)
        for picture in decoder:
            frame = av.VideoFrame.from_ndarray(picture.rgb(), format="rgb24")
            frame.pts, frame.time_base = round(picture.time * 90000), Fraction(1, 90000)
            file.mux(stream.encode(frame))
        file.mux(stream.encode())


def _write_by_opencv(name: str, decoder: Decoder) -> None:
    cv2 = _module("cv2")
    if cv2 is None:
        raise UnsupportedError("this package writes .y4m alone; pip install 'fbs-codec[av]' or 'fbs-codec[opencv]'")
    size = (decoder.format.width, decoder.format.height)
    video = cv2.VideoWriter(name, cv2.VideoWriter_fourcc(*"mp4v"), float(decoder.format.fps), size)
    if not video.isOpened():
        raise FileError("OpenCV does not know this kind of file")
    for picture in decoder:
        video.write(np.ascontiguousarray(picture.rgb()[:, :, ::-1]))
    video.release()
