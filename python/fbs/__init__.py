"""fbs, a video codec for talking heads.

A stream holds a few pictures of a person, and between them only the motion of head and face: 2 to 8 kbit/s. This
package encodes and decodes such streams, and gives their data of the face as arrays.

Whole files, each in a process of its own::

    fbs.encode("talk.mkv", "talk.fbs", quality=60)
    fbs.decode("talk.fbs", "talk.mp4")
    fbs.track("talk.mkv")                             # pose, landmarks, blendshapes: a table
    fbs.retarget("talk.fbs", "photo.jpg", "out.fbs")  # the photograph talks
    fbs.evaluate("talk.mkv", quality=[30, 50, 70])    # rate and distortion

Picture by picture, in numpy's arrays::

    with fbs.Decoder("talk.fbs") as decoder:
        for picture in decoder:
            show(picture.rgb())                       # or picture.y, picture.u, picture.v

    with fbs.Encoder(352, 288, fps=25, quality=60) as encoder:
        for rgb in frames:
            stream.writelines(encoder.push(rgb))
        stream.writelines(encoder.finish())

Without drawing a picture::

    states = fbs.Decoder("talk.fbs").states
    plt.plot(states.time, states.yaw)                 # also landmarks, control points, blendshapes
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from fbs.errors import (
    ArgumentError,
    DamagedError,
    Error,
    FileError,
    InternalError,
    NoFaceError,
    NoMemoryError,
    NotFbsError,
    PartialWarning,
    ProgramMissingError,
    ProgramTimeoutError,
    TooLargeError,
    TruncatedError,
    UnsupportedError,
)

if TYPE_CHECKING:
    from fbs._fbs import BLENDSHAPES
    from fbs._decoder import Decoder, Scene
    from fbs._encoder import Encoder, Packet, Report
    from fbs._encoding import encode
    from fbs._face import FaceState, States
    from fbs._picture import Format, Picture, PictureInfo
    from fbs._table import track
    from fbs._verbs import decode, evaluate, inspect, retarget

    __version__: str

# Loaded on demand: errors and the program need neither numpy nor the extension.
_HOMES = {
    "BLENDSHAPES": "_fbs",
    "Decoder": "_decoder",
    "Encoder": "_encoder",
    "FaceState": "_face",
    "Format": "_picture",
    "Packet": "_encoder",
    "Picture": "_picture",
    "PictureInfo": "_picture",
    "Report": "_encoder",
    "Scene": "_decoder",
    "States": "_face",
    "decode": "_verbs",
    "encode": "_encoding",
    "evaluate": "_verbs",
    "inspect": "_verbs",
    "retarget": "_verbs",
    "track": "_table",
}

__all__ = [
    "ArgumentError",
    "BLENDSHAPES",
    "DamagedError",
    "Decoder",
    "Encoder",
    "Error",
    "FaceState",
    "FileError",
    "Format",
    "InternalError",
    "NoFaceError",
    "NoMemoryError",
    "NotFbsError",
    "Packet",
    "PartialWarning",
    "Picture",
    "PictureInfo",
    "ProgramMissingError",
    "ProgramTimeoutError",
    "Report",
    "Scene",
    "States",
    "TooLargeError",
    "TruncatedError",
    "UnsupportedError",
    "decode",
    "encode",
    "evaluate",
    "inspect",
    "retarget",
    "track",
]


def __getattr__(name: str) -> Any:
    if name == "__version__":
        return import_module("fbs._fbs").version()
    if name not in _HOMES:
        raise AttributeError(f"module 'fbs' has no attribute {name!r}")
    value = getattr(import_module(f"fbs.{_HOMES[name]}"), name)
    if callable(value):
        value.__module__ = "fbs"  # for help() and for tracebacks
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *_HOMES})
