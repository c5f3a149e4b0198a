"""Clips: the videos of a folder, with a key for each state of a clip."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

SUFFIXES = frozenset(".y4m .mp4 .mkv .webm .mov .avi .m4v .mpg .mpeg .ts .ogv .flv .wmv .3gp".split())
"""Of files that are taken for clips, in small letters."""


def short_hash(value: object) -> str:
    """Hash of any JSON value: 16 hexadecimal digits."""
    return hashlib.sha256(json.dumps(value, sort_keys=True).encode()).hexdigest()[:16]


@dataclass(frozen=True)
class Clip:
    """A video file as it was when it was found."""

    folder: str
    """The corpus, as workers see it."""
    name: str
    """Path below `folder`."""
    size: int
    """Bytes."""
    changed_ns: int
    """Time of change, ns since 1970."""

    @property
    def path(self) -> str:
        return os.path.join(self.folder, self.name)

    @property
    def shown_name(self) -> str:
        """The name in tables: bytes that are not UTF-8 are replaced."""
        return os.fsencode(self.name).decode("utf-8", "replace")

    @property
    def key(self) -> str:
        """Key of this state of the clip, wherever the folder is mounted."""
        return short_hash([self.name, self.size, self.changed_ns])


def names_in(folder: str | os.PathLike[str]) -> Iterator[str]:
    """Paths of the clips below a folder, in order of name, a folder after the files beside it.

    Hidden files and folders are left out. A folder that cannot be read raises OSError.
    """
    yield from _names_below(os.fspath(folder), "")


def _names_below(folder: str, prefix: str) -> Iterator[str]:
    with os.scandir(folder) as listing:
        entries = sorted((e for e in listing if not e.name.startswith(".")), key=lambda e: e.name)
    for entry in entries:
        if Path(entry.name).suffix.lower() in SUFFIXES and entry.is_file():
            yield prefix + entry.name
    for entry in entries:
        if entry.is_dir(follow_symlinks=False):
            yield from _names_below(entry.path, f"{prefix}{entry.name}/")


def clips_in(folder: str | os.PathLike[str]) -> Iterator[Clip]:
    """The clips below a folder, one at a time, so that a million of them take no memory."""
    folder = os.path.abspath(folder)
    for name in names_in(folder):
        try:
            status = os.stat(os.path.join(folder, name))
        except FileNotFoundError:  # removed since the folder was listed
            continue
        yield Clip(folder, name, status.st_size, status.st_mtime_ns)
