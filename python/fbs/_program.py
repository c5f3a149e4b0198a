"""Runs the program ``fbs``: whole files are encoded, tracked and measured in a process of their own.

A process does not wait for the interpreter's lock, can be ended at any time, and takes nothing with it when it
crashes.
"""

from __future__ import annotations

import os
import selectors
import shutil
import signal
import subprocess
import sys
import sysconfig
import threading
import time
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Optional, Union

from fbs import errors

Progress = Callable[[int, Optional[int]], object]
"""Called with the pictures done and, where it is known, with about how many there are."""

PathLike = Union[str, "os.PathLike[str]"]

_PARTIAL = 2
_OWN = Path(__file__).with_name("program") / "fbs"
_ERROR_CLASSES: dict[str, type[errors.Error]] = {
    "argument": errors.ArgumentError,
    "not_fbs": errors.NotFbsError,
    "truncated": errors.TruncatedError,
    "damaged": errors.DamagedError,
    "unsupported": errors.UnsupportedError,
    "too_large": errors.TooLargeError,
    "no_face": errors.NoFaceError,
    "no_memory": errors.NoMemoryError,
    "io": errors.FileError,
    "internal": errors.InternalError,
}


def program() -> str:
    """Find the program: ``$FBS_PROGRAM``, then the package's own, then the first ``fbs`` of ``PATH``.

    Raises
    ------
    ProgramMissingError
        There is none.
    """
    named = os.environ.get("FBS_PROGRAM")
    if named:
        return named
    if _OWN.exists():
        return str(_OWN)
    # `fbs` beside this interpreter is this package's own command, which would run itself forever.
    scripts = sysconfig.get_path("scripts")
    folders = [f for f in os.environ.get("PATH", "").split(os.pathsep) if f and f != scripts]
    found = shutil.which("fbs", path=os.pathsep.join(folders))
    if found is None:
        raise errors.ProgramMissingError(
            "no program fbs: neither in this package, nor in PATH, and FBS_PROGRAM is not set"
        )
    return found


def lacks(module: str) -> bool:
    """Whether the program is the package's own, and was packed without a module of this name."""
    return program() == str(_OWN) and not _OWN.with_name(f"{module}.so").exists()


def argument(path: PathLike) -> str:
    """Name a file so that the program does not take it for an option, or ``-`` for a pipe."""
    name = os.fspath(path)
    return f"./{name}" if name.startswith("-") else name


def run(
    arguments: Sequence[PathLike],
    *,
    on_progress: Progress | None = None,
    cwd: PathLike | None = None,
    timeout: float | None = None,
    launcher: Sequence[str] = (),
    stdin: Iterator[bytes] | None = None,
) -> str:
    """Run ``fbs ARGUMENTS`` and wait for its end.

    Leaving this function early, for instance by Ctrl-C or an exception of `on_progress`, ends the program and
    everything it has started.

    Parameters
    ----------
    arguments : sequence of str or path
        The verb, then its options and names.
    on_progress : callable, optional
        Called as ``on_progress(done, total)`` some times a second, in pictures. `total` is an estimate, and None if
        unknown.
    cwd : path, optional
        The folder to run in.
    timeout : float, optional
        Seconds.
    launcher : sequence of str, optional
        A command that runs the program, such as ``("nice",)``.
    stdin : iterator of bytes, optional
        What the program reads from its standard input. An exception of the iterator is raised here.

    Returns
    -------
    str
        The program's standard output.

    Raises
    ------
    Error
        The program failed: the class says how, the text is the program's.
    ProgramTimeoutError
        It took more than `timeout`.

    Warns
    -----
    PartialWarning
        There are results, but the source was truncated or damaged, or something was left out.
    """
    name = program()
    child = _Child([*launcher, name, *map(os.fspath, arguments)], cwd, stdin)
    try:
        child.follow(on_progress, None if timeout is None else time.monotonic() + timeout)
    except TimeoutError:
        raise errors.ProgramTimeoutError(f"fbs took more than {timeout:g} s") from None
    finally:
        child.end()
    if child.input_fault is not None:
        raise child.input_fault
    if child.exit_code == _PARTIAL and child.error is None:
        warnings.warn(_notes(child.log), errors.PartialWarning, stacklevel=3)
    elif child.exit_code != 0:
        raise _error_of(child)
    return child.output


class _Child:
    """A running program and its output."""

    def __init__(self, command: list[str], cwd: PathLike | None, stdin: Iterator[bytes] | None) -> None:
        self.error: str | None = None
        self.input_fault: BaseException | None = None
        self._report, theirs = os.pipe()
        try:
            self._process = subprocess.Popen(
                command,
                stdin=subprocess.DEVNULL if stdin is None else subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                cwd=cwd,
                env={**os.environ, "FBS_REPORT_FD": str(theirs)},
                pass_fds=[theirs],
                start_new_session=True,  # Ctrl-C is ours to handle; and what it starts can be ended with it
            )
        except OSError as problem:
            os.close(self._report)
            raise errors.ProgramMissingError(f"cannot run {command[0]}: {problem.strerror}") from problem
        finally:
            os.close(theirs)
        assert self._process.stdout is not None and self._process.stderr is not None
        self._said = {
            pipe: bytearray() for pipe in (self._process.stdout.fileno(), self._process.stderr.fileno(), self._report)
        }

        if stdin is not None:
            threading.Thread(target=self._write, args=[stdin], daemon=True).start()

    def _write(self, pieces: Iterator[bytes]) -> None:
        assert self._process.stdin is not None
        pipe = self._process.stdin
        try:
            for piece in pieces:
                pipe.write(piece)
            pipe.close()
        except BrokenPipeError:  # the program has ended
            pass
        except BaseException as problem:
            self.input_fault = problem
            self._process.kill()  # or it would take what has come for all

    def follow(self, on_progress: Progress | None, end: float | None) -> None:
        """Read until the program ends; TimeoutError at the time `end` of the monotonic clock."""
        with selectors.DefaultSelector() as pipes:
            for pipe in self._said:
                pipes.register(pipe, selectors.EVENT_READ)
            while pipes.get_map():
                left = None if end is None else end - time.monotonic()
                if left is not None and left <= 0:
                    raise TimeoutError
                for key, _ in pipes.select(left):
                    piece = os.read(key.fd, 1 << 16)
                    self._said[key.fd] += piece
                    if not piece:
                        pipes.unregister(key.fd)
                    elif key.fd == self._report:
                        self._take_reports(on_progress)
        self._process.wait()

    def _take_reports(self, on_progress: Progress | None) -> None:
        *lines, rest = bytes(self._said[self._report]).split(b"\n")
        self._said[self._report][:] = rest
        for line in lines:
            kind, *words = line.decode("utf-8", "replace").split(" ", 3)
            if kind == "error":
                self.error = words[0]
            elif kind == "progress" and on_progress is not None:
                on_progress(int(words[0]), None if words[1] == "-" else int(words[1]))

    def end(self) -> None:
        """End the program, if it is still there, with everything it has started."""
        if self._process.poll() is None:
            try:
                os.killpg(self._process.pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
            self._process.wait()
        os.close(self._report)
        for pipe in (self._process.stdin, self._process.stdout, self._process.stderr):
            if pipe is not None:
                with suppress(BrokenPipeError):
                    pipe.close()

    @property
    def exit_code(self) -> int:
        return int(self._process.returncode)

    @property
    def output(self) -> str:
        return list(self._said.values())[0].decode("utf-8", "replace")

    @property
    def log(self) -> str:
        return list(self._said.values())[1].decode("utf-8", "replace")


def _notes(log: str) -> str:
    return "; ".join(line.removeprefix("fbs: ") for line in log.splitlines())


def _error_of(child: _Child) -> errors.Error:
    lines = child.log.splitlines()
    if child.exit_code < 0:
        text = f"fbs was ended by {signal.Signals(-child.exit_code).name}"
    elif lines:
        text = lines[-1].removeprefix("fbs: ")
    else:
        text = f"fbs ended with exit code {child.exit_code}"
    kind = _ERROR_CLASSES.get(child.error or "", errors.Error)
    return kind(text, exit_code=child.exit_code, log=child.log)


def main() -> None:
    """The command ``fbs`` of an installed package: becomes the program."""
    try:
        name = program()
    except errors.ProgramMissingError as problem:
        sys.exit(f"fbs: {problem}")
    os.execv(name, [name, *sys.argv[1:]])
