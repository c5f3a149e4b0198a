"""Pose, landmarks and expression as a table."""

from __future__ import annotations

import io
import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from fbs import _program, _video
from fbs.errors import ArgumentError

if TYPE_CHECKING:
    import pandas
    from numpy.typing import NDArray

    from fbs._program import PathLike, Progress

    Table = Union["pandas.DataFrame", dict[str, NDArray[Any]]]

_WHOLE_NUMBERS = ("frame", "success")


def track(
    video: PathLike,
    *,
    face: int = 0,
    frames: int | None = None,
    duration: float | None = None,
    fps: float | None = None,
    on_progress: Progress | None = None,
    options: Sequence[str] = (),
) -> Table:
    """Track a face in a video, or read a stream's data of it.

    Parameters
    ----------
    video : path
        Any input of ``fbs encode``; or a stream, ``.fbs``, whose data need no tracking.
    face : int
        In a video: which face to follow, 0 being the largest.
    frames : int, optional
        Track at most this many pictures.
    duration : float, optional
        Track at most this many seconds.
    fps : float, optional
        Pictures per second, for images; 25 unless given.
    on_progress : callable, optional
        Called as ``on_progress(done, total)``, in pictures.
    options : sequence of str
        More options of ``fbs track``, such as ``["--marks", "face.json"]``.

    Returns
    -------
    pandas.DataFrame, or dict of (n,) arrays where pandas is not installed
        A row for each picture; column by column the same either way:

        ==============================  ==========================================================================
        ``frame``, ``timestamp``        from 0; seconds
        ``success``, ``confidence``     1 if the face is seen, else 0; 0 to 1
        ``rx_deg ry_deg rz_deg``        pitch (positive: down), yaw (to the picture's left), roll (clockwise)
        ``tx_px ty_px scale``           midway between the eyes; pixels per eye distance
        ``x0 y0`` ... ``x67 y67``       the 68 landmarks of iBUG, pixels from the top left corner
        ``gaze_x_deg gaze_y_deg``       positive to the picture's right, and down
        ``jawOpen`` ...                 weights of 32 blendshapes, with the names of ARKit
        ==============================  ==========================================================================

        A picture without a face has NaN in all but the first four.

    Raises
    ------
    NoFaceError
        No picture shows a face.
    FileError, UnsupportedError
        The video cannot be read.

    Examples
    --------
    >>> table = fbs.track("talk.y4m", frames=3)
    >>> len(table["timestamp"]), bool(table["success"].all())
    (3, True)
    >>> landmarks = np.stack([[table[f"x{k}"], table[f"y{k}"]] for k in range(68)]).transpose(2, 0, 1)
    >>> landmarks.shape
    (3, 68, 2)
    """
    name = _program.argument(video)
    if os.fspath(video).endswith(".fbs"):
        if face or any(value is not None for value in (frames, duration, fps)):
            raise ArgumentError("face, frames, duration and fps are for videos; the table of a stream has all pictures")
        arguments = ["export", name, "-", *options]
    else:
        arguments = ["track", name, "-", *options]
        for option, value in (("--face", face or None), ("--frames", frames), ("--duration", duration), ("--rate", fps)):
            if value is not None:
                arguments += [option, str(value)]
    pictures = None
    if arguments[0] == "track" and _video.is_foreign(video):
        pictures, arguments[1] = _video.as_y4m(video), "-"
    return _table_of(_program.run(arguments, on_progress=on_progress, stdin=pictures))


def _table_of(text: str) -> Table:
    header, _, rows = text.partition("\n")
    names = header.split(",")
    values = np.loadtxt(io.StringIO(rows), delimiter=",", ndmin=2, dtype=np.float64).reshape(-1, len(names))
    columns: dict[str, NDArray[Any]] = {
        name: column.astype(np.int64) if name in _WHOLE_NUMBERS else column for name, column in zip(names, values.T)
    }
    try:
        import pandas
    except ImportError:
        return columns
    return pandas.DataFrame(columns)
