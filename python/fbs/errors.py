"""The exceptions: one class for each error status of the library, all derived from :class:`fbs.Error`."""

from __future__ import annotations

__all__ = [
    "ArgumentError",
    "DamagedError",
    "Error",
    "FileError",
    "InternalError",
    "NoFaceError",
    "NoMemoryError",
    "NotFbsError",
    "PartialWarning",
    "ProgramMissingError",
    "ProgramTimeoutError",
    "TooLargeError",
    "TruncatedError",
    "UnsupportedError",
]


class Error(Exception):
    """Any error of fbs. Its text is one line for a user.

    Parameters
    ----------
    text : str
        What is wrong.
    offset : int
        Offset of the error in the stream; 0 if it has none.
    exit_code : int or None
        Of the program, if it was run; negative: the signal that ended it.
    log : str
        The program's standard error.
    """

    def __init__(self, text: str, offset: int = 0, *, exit_code: int | None = None, log: str = "") -> None:
        super().__init__(text)
        self.offset = offset
        self.exit_code = exit_code
        self.log = log


class ArgumentError(Error, ValueError):
    """A value out of its range, or a call at the wrong time."""


class NotFbsError(Error):
    """The input does not begin as an fbs stream does."""


class DamagedError(Error):
    """A packet is damaged, missing, or breaks a rule of the format."""


class TruncatedError(Error):
    """The stream ends inside a packet, or before its setup."""


class UnsupportedError(Error):
    """A newer version of the format, or a change of the picture's size."""


class TooLargeError(Error):
    """Beyond a limit of the format or of the settings."""


class NoMemoryError(Error, MemoryError):
    """Not enough memory."""


class NoFaceError(Error):
    """No face where one is needed."""


class FileError(Error, OSError):
    """A file cannot be read or written."""


class InternalError(Error):
    """A bug in fbs."""


class ProgramMissingError(Error):
    """The program ``fbs`` is not there, or does not start."""


class ProgramTimeoutError(Error, TimeoutError):
    """The program exceeded its time limit."""


class PartialWarning(UserWarning):
    """There are results, but the source was truncated or damaged, or part of it was left out."""
