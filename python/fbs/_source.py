"""Where a decoder's bytes come from."""

from __future__ import annotations

import os
import tempfile
from typing import BinaryIO, Optional, Union

from fbs import _program
from fbs.errors import ArgumentError, FileError

Buffer = Union[bytes, bytearray, memoryview]
Source = Union[str, "os.PathLike[str]", Buffer, BinaryIO]

_MATROSKA = b"\x1aE\xdf\xa3"  # the first bytes of such files
_PIECE = 1 << 16  # bytes fed before the pictures in them are taken


class ByteSource:
    """A whole stream, a file that is read piece by piece, or nothing: then bytes are fed by the caller.

    Attributes
    ----------
    name : str or None
        Of a stream given by its path.
    """

    def __init__(self, source: Source | None) -> None:
        self.name: Optional[str] = None
        self._stream: Optional[Buffer] = None
        self._file: Optional[BinaryIO] = None
        self._at = 0
        if isinstance(source, (bytes, bytearray, memoryview)):
            self._stream = source
        elif isinstance(source, (str, os.PathLike)):
            self.name = os.fspath(source)
            self._stream = _bytes_of(self.name)
        elif source is not None and not hasattr(source, "read"):
            raise ArgumentError(f"a stream is a path, bytes, or a binary file, not {type(source).__name__}")
        else:
            self._file = source

    @property
    def is_whole(self) -> bool:
        return self._stream is not None

    @property
    def is_fed(self) -> bool:
        """Whether the caller feeds bytes."""
        return self._stream is None and self._file is None

    def whole(self, wanted: str) -> Buffer:
        """The stream, for the purpose `wanted`; ArgumentError if it is not complete from the beginning."""
        if self._stream is None:
            raise ArgumentError(f"{wanted}: only of a path or of bytes, which are there from the beginning")
        return self._stream

    def go_to(self, offset: int) -> None:
        """Go to a position in a whole stream."""
        self._at = offset

    def piece(self) -> Buffer:
        """The next bytes; none at the end."""
        if self._stream is not None:
            piece = memoryview(self._stream)[self._at : self._at + _PIECE]
            self._at += len(piece)
            return piece
        assert self._file is not None
        # Read what a pipe has now, rather than wait for a full piece.
        read = getattr(self._file, "read1", self._file.read)
        found: bytes = read(_PIECE)
        return found


def _bytes_of(path: str) -> bytes:
    try:
        with open(path, "rb") as file:
            found = file.read()
    except OSError as problem:
        raise FileError(f"cannot read {path}: {problem.strerror}") from problem
    return _taken_out(path) if found.startswith(_MATROSKA) else found


def _taken_out(path: str) -> bytes:
    """The stream in a Matroska file."""
    with tempfile.TemporaryDirectory(prefix="fbs-") as folder:
        stream = os.path.join(folder, "stream.fbs")
        _program.run(["remux", _program.argument(path), stream])
        with open(stream, "rb") as file:
            return file.read()
