"""Whole videos to streams."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from fbs import _program, _video
from fbs._encoder import Encoder, Rate, rate_of
from fbs._picture import Picture, PictureLike
from fbs.errors import ArgumentError, Error, FileError, PartialWarning

if TYPE_CHECKING:
    from fbs._program import PathLike, Progress

Video = Union[str, "os.PathLike[str]", Iterable[PictureLike]]


def encode(
    video: Video,
    path: PathLike,
    *,
    quality: int | None = None,
    bitrate: float | None = None,
    fps: Rate | None = None,
    effort: int = 5,
    tune: str = "eye",
    patterns: int = 0,
    face: int = 0,
    allow_no_face: bool = False,
    key_interval: float | None = None,
    live: bool = False,
    sound: bool = True,
    on_progress: Progress | None = None,
    options: Sequence[str] = (),
) -> Path:
    """Encode a video.

    A file is read, with its sound, by the program ``fbs encode``: Ctrl-C ends it at once and leaves nothing behind.
    Pictures are encoded in this process, without sound.

    Parameters
    ----------
    video : path, or iterable of pictures
        Any input of ``fbs encode``: a video file, ``camera:0``, images such as ``frame_%05d.png``, a folder of
        images. Or (h, w, 3) uint8 arrays of RGB, an (n, h, w, 3) array, or pictures and planes as for
        :meth:`Encoder.push`.
    path : path
        The stream to write, ``.fbs``. It has this name only once it is complete.
    quality : int, optional
        0 (smallest file) to 100 (best pictures); 50 unless given.
    bitrate : float, optional
        Instead: kbit/s in total, with sound.
    fps : int, float or Fraction, optional
        Pictures per second, for pictures and images; 25 unless given. A video file has its own.
    effort : int
        0 to 9. More takes longer and saves bits.
    tune : {"eye", "psnr"}
        What bytes are spent for: mouth and eyes that look right, or the PSNR of the whole frame. No effect with `live`.
    patterns : int
        Pictures of the person in a scene, 1 to 64; 0: chosen by the encoder.
    face : int
        Which face to follow, 0 being the largest.
    allow_no_face : bool
        Also encode a video without any face.
    key_interval : float, optional
        Longest time between scenes, where viewers can join, s.
    live : bool
        No look-ahead: more bits, less memory.
    sound : bool
        Include the sound of a file.
    on_progress : callable, optional
        Called as ``on_progress(done, total)``, in pictures; `total` is None if unknown.
    options : sequence of str
        More options of ``fbs encode``, such as ``["--overlay", "see.mp4"]``; for files only.

    Returns
    -------
    Path
        `path`.

    Raises
    ------
    NoFaceError
        No picture shows a face, and `allow_no_face` is not set.
    FileError, UnsupportedError, ArgumentError
        The video cannot be read, or the stream cannot be written; a value is out of range.

    Warns
    -----
    PartialWarning
        The file is truncated or damaged; the stream has the readable part.

    Examples
    --------
    >>> fbs.encode("talk.y4m", "new.fbs", quality=40).name
    'new.fbs'
    >>> frames = np.zeros((5, 64, 64, 3), np.uint8)
    >>> path = fbs.encode(frames, "black.fbs", fps=10, allow_no_face=True)
    >>> fbs.Decoder(path).states.time.tolist()
    [0.0, 0.1, 0.2, 0.3, 0.4]
    """
    if quality is not None and bitrate is not None:
        raise ArgumentError("give a quality or a bitrate, not both")
    path = Path(path)
    if not isinstance(video, (str, os.PathLike)):
        if options:
            raise ArgumentError("options are those of the program, which encodes files only")
        settings = {
            "quality": 50 if quality is None else quality,
            "bitrate": bitrate,
            "effort": effort,
            "tune": tune,
            "patterns": patterns,
            "face": face,
            "allow_no_face": allow_no_face,
            "key_interval": key_interval or 0,
            "live": live,
        }
        _encode_pictures(video, path, 25 if fps is None else fps, settings, on_progress)
        return path

    arguments = ["encode", _program.argument(video), _program.argument(path), "--quiet", f"--effort={effort}", f"--tune={tune}"]
    for name, value in (
        ("--quality", quality),
        ("--bitrate", bitrate),
        ("--patterns", patterns or None),
        ("--face", face or None),
        ("--key-interval", key_interval),
        ("--rate", None if fps is None else float(fps)),
    ):
        if value is not None:
            arguments += [name, str(value)]
    flags = (("--allow-no-face", allow_no_face), ("--live", live), ("--no-sound", not sound))
    arguments += [flag for flag, is_set in flags if is_set]
    pictures = None
    if _video.is_foreign(video):
        pictures, arguments[1] = _video.as_y4m(video), "-"
        if sound and _video.has_sound(video):
            warnings.warn(f"{os.fspath(video)}: without its sound, which this package cannot read", PartialWarning, 2)
    with discarded_part(path):
        _program.run([*arguments, *options], on_progress=on_progress, stdin=pictures)
    return path


@contextmanager
def discarded_part(path: PathLike) -> Iterator[None]:
    """Remove ``PATH.part``, which the program writes, if this process has ended it."""
    try:
        yield
    except BaseException as problem:
        if not isinstance(problem, Error) or problem.exit_code is None:
            Path(f"{os.fspath(path)}.part").unlink(missing_ok=True)
        raise


def _encode_pictures(
    pictures: Iterable[PictureLike], path: Path, fps: Rate, settings: dict[str, Any], on_progress: Progress | None
) -> None:
    total = len(pictures) if hasattr(pictures, "__len__") else None
    rate = rate_of(fps)
    seconds = None if total is None else float(total / rate)
    part = Path(f"{path}.part")
    encoder: Encoder | None = None
    try:
        with open(part, "wb") as file:
            for done, picture in enumerate(pictures, 1):
                if encoder is None:
                    encoder = _encoder_of(picture, rate, seconds, settings)
                file.writelines(encoder.push(picture))
                if on_progress is not None:
                    on_progress(done, total)
            if encoder is None:
                raise ArgumentError("there is no picture")
            file.writelines(encoder.finish())
        os.replace(part, path)
    except BaseException as problem:
        part.unlink(missing_ok=True)
        if isinstance(problem, OSError) and not isinstance(problem, Error):
            raise FileError(f"cannot write {path}: {problem.strerror}") from problem
        raise
    finally:
        if encoder is not None:
            encoder.close()


def _encoder_of(first: PictureLike, rate: Rate, seconds: float | None, settings: dict[str, Any]) -> Encoder:
    """An encoder for pictures like the first one."""
    if isinstance(first, Picture):
        settings = {**settings, "matrix": first.matrix, "full_range": first.full_range}
        height, width = first.height, first.width
    else:
        shape = np.shape(first if isinstance(first, np.ndarray) else first[0])
        if len(shape) < 2:
            raise ArgumentError("a picture is an (h, w, 3) array of uint8, a Picture, or three planes of uint8")
        height, width = shape[:2]
    return Encoder(width, height, fps=rate, seconds=seconds, **settings)
