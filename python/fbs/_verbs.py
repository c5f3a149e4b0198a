"""Whole streams: decode, retarget, inspect, evaluate."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, overload

import numpy as np

from fbs import _program, _video
from fbs._decoder import Decoder
from fbs._encoding import discarded_part
from fbs._source import Source
from fbs.errors import ArgumentError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from fbs._program import PathLike, Progress


@overload
def decode(
    stream: Source, path: None = None, *, keep_going: bool = False, on_progress: Progress | None = None
) -> NDArray[np.uint8]: ...


@overload
def decode(
    stream: PathLike,
    path: PathLike,
    *,
    keep_going: bool = False,
    on_progress: Progress | None = None,
    options: Sequence[str] = (),
) -> Path: ...


def decode(
    stream: Source,
    path: PathLike | None = None,
    *,
    keep_going: bool = False,
    on_progress: Progress | None = None,
    options: Sequence[str] = (),
) -> NDArray[np.uint8] | Path:
    """Decode a stream: to an array of all its pictures, or to a file.

    Parameters
    ----------
    stream : path, bytes or binary file
        To write a file: a path, which may name a Matroska file with a stream.
    path : path, optional
        ``.mp4``, ``.mkv``, ``.y4m``, ``frame_%05d.png``, or ``.wav`` for the sound alone; the program ``fbs decode``
        writes it, with the sound.
    keep_going : bool
        Continue after damage.
    on_progress : callable, optional
        Called as ``on_progress(done, None)``, in pictures.
    options : sequence of str
        More options of ``fbs decode``, such as ``["--from", "90"]``; with `path` only.

    Returns
    -------
    (n, h, w, 3) uint8 array, or Path
        RGB: 0.3 MB for each picture of 352 by 288. Iterate over a :class:`Decoder` if that is too much. `path`, if
        given.

    Examples
    --------
    >>> fbs.decode("talk.fbs").shape
    (20, 144, 176, 3)
    """
    if path is None:
        if options:
            raise ArgumentError("options are those of the program, which writes files")
        return _all_pictures(stream, keep_going, on_progress)
    if not isinstance(stream, (str, Path)) and not hasattr(stream, "__fspath__"):
        raise ArgumentError("a file is written of a stream that is in a file")
    if _video.is_foreign(path) and "%" not in os.fspath(path) and not options:
        with Decoder(stream, keep_going=keep_going) as decoder:
            _video.write(path, decoder)
        return Path(path)
    arguments = ["decode", _program.argument(stream), _program.argument(path), "--quiet"]
    if keep_going:
        arguments.append("--keep-going")
    with discarded_part(path):
        _program.run([*arguments, *options], on_progress=on_progress)
    return Path(path)


def _all_pictures(stream: Source, keep_going: bool, on_progress: Progress | None) -> NDArray[np.uint8]:
    pictures = []
    with Decoder(stream, keep_going=keep_going) as decoder:
        for picture in decoder:
            pictures.append(picture.rgb())
            if on_progress is not None:
                on_progress(len(pictures), None)
    return np.stack(pictures) if pictures else np.empty((0, 0, 0, 3), np.uint8)


def retarget(
    motion: PathLike,
    face: PathLike,
    path: PathLike,
    *,
    quality: int | None = None,
    sound: bool = True,
    wire_frame: PathLike | None = None,
    options: Sequence[str] = (),
) -> Path:
    """Give one face the motion of another.

    Parameters
    ----------
    motion : path
        A stream: encode a video first.
    face : path
        Whose face: a stream, or a picture or video that shows one in its first picture.
    path : path
        The stream to write, ``.fbs``.
    quality : int, optional
        0 to 100, for a face that is not a stream; 70 unless given.
    sound : bool
        Include the sound of `motion`.
    wire_frame : path, optional
        Draw the face on this wire-frame, ``.gltf`` or ``.glb``.
    options : sequence of str
        More options of ``fbs retarget``.

    Returns
    -------
    Path
        `path`.

    Raises
    ------
    NoFaceError
        One of the inputs shows no face.
    """
    arguments = ["retarget", "--motion", _program.argument(motion), "--face"]
    if quality is not None:
        arguments.append(f"--quality={quality}")
    if wire_frame is not None:
        arguments += ["--wire-frame", _program.argument(wire_frame)]
    if not sound:
        arguments.append("--no-sound")
    with discarded_part(path), _video.readable(face, most=1) as name:
        _program.run([*arguments[:4], name, *arguments[4:], "--quiet", *options, _program.argument(path)])
    return Path(path)


def inspect(stream: PathLike) -> dict[str, Any]:
    """List the content of a stream, and the bytes of each part.

    Parameters
    ----------
    stream : path

    Returns
    -------
    dict
        As from ``fbs inspect --json``: `bytes` of each part, `frames`, `fps`, `seconds`, `patterns`, `scenes`.

    Examples
    --------
    >>> found = fbs.inspect("talk.fbs")
    >>> found["frames"], found["bytes"]["total"] == len(stream)
    (20, True)
    """
    found: dict[str, Any] = json.loads(_program.run(["inspect", "--json", _program.argument(stream)]))
    return found


def evaluate(
    video: PathLike,
    *streams: PathLike,
    quality: Sequence[int] = (),
    frames: int | None = None,
    peers: bool = False,
    html: PathLike | None = None,
    csv: PathLike | None = None,
    region: PathLike | None = None,
    keep: PathLike | None = None,
    live: bool = False,
    allow_no_face: bool = False,
    jobs: int = 1,
    on_progress: Progress | None = None,
    options: Sequence[str] = (),
) -> dict[str, Any]:
    """Measure the bytes of streams, and the fidelity of their pictures to the source.

    Parameters
    ----------
    video : path
        The source, or a folder of videos.
    *streams : path
        Streams to measure. Without any, the source is encoded first.
    quality : sequence of int
        Qualities to encode at; 20, 35, 50, 65 and 80 unless given.
    frames : int, optional
        Measure at most this many pictures.
    peers : bool
        Also encode with x264, x265 and AV1, as far as ``ffmpeg`` has them; takes minutes.
    html, csv : path, optional
        Write a report, or a table of the values of each picture.
    region : path, optional
        Table of landmarks, or stream, that gives the face.
    keep : path, optional
        Folder for finished results; the same call continues from there.
    live, allow_no_face
        As for :func:`fbs.encode`.
    jobs : int
        Videos of a folder to evaluate at the same time.
    on_progress : callable, optional
        Called as ``on_progress(done, total)``, in pictures, anew for each encoding and each measurement.
    options : sequence of str
        More options of ``fbs evaluate``.

    Returns
    -------
    dict
        As from ``fbs evaluate --json``. ``result["points"]`` is a list with a dictionary for each stream: `kbps`,
        `psnr_face`, `psnr_frame` in dB, `ssim_face`, `ssim_frame` and more; ``pandas.DataFrame`` takes it as it is.

    Warns
    -----
    PartialWarning
        The source is truncated or damaged, or videos of a folder were left out.

    Examples
    --------
    >>> result = fbs.evaluate("talk.y4m", "talk.fbs")
    >>> [point["frames"] for point in result["points"]]
    [20]
    """
    arguments = [*map(_program.argument, streams), "--json=-"]
    if quality:
        arguments += ["--quality", *map(str, quality)]
    for name, path in (("--html", html), ("--csv", csv), ("--region", region), ("--keep", keep)):
        if path is not None:
            arguments += [name, _program.argument(path)]
    if frames is not None:
        arguments.append(f"--frames={frames}")
    if jobs != 1:
        arguments.append(f"--jobs={jobs}")
    flags = (("--peers", peers), ("--live", live), ("--allow-no-face", allow_no_face))
    arguments += [flag for flag, is_set in flags if is_set]
    with _video.readable(video) as name:
        printed = _program.run(["evaluate", name, *arguments, *options], on_progress=on_progress)
    result: dict[str, Any] = json.loads(printed)
    return result
