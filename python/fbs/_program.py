"""Runs the program ``fbs``: whole files are encoded, tracked and measured in a process of their own.

A process is not held up by the interpreter's lock, can be ended at any time, and takes nothing with it when it
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
import time
import warnings
from collections.abc import Callable, Sequence
from pathlib import Path

from fbs.errors import Error, PartialWarning, ProgramMissingError, ProgramTimeoutError

Progress = Callable[[int, "int | None"], object]
"""Called with the pictures done and, where it is known, with how many there are about."""

_FAILED = 2
_OWN = Path(__file__).with_name("program") / "fbs"


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
    # `fbs` beside this interpreter is the command of this package, which would run itself for ever.
    scripts = sysconfig.get_path("scripts")
    folders = [f for f in os.environ.get("PATH", "").split(os.pathsep) if f and f != scripts]
    found = shutil.which("fbs", path=os.pathsep.join(folders))
    if found is None:
        raise ProgramMissingError("no program fbs: neither in this package, nor in PATH, and FBS_PROGRAM is not set")
    return found


def run(
    arguments: Sequence[str | os.PathLike[str]],
    *,
    on_progress: Progress | None = None,
    cwd: str | os.PathLike[str] | None = None,
    timeout: float | None = None,
    launcher: Sequence[str] = (),
) -> str:
    """Run ``fbs ARGUMENTS`` and wait for its end.

    Whatever leaves this function early, such as Ctrl-C or an exception of `on_progress`, ends the program.

    Parameters
    ----------
    arguments : sequence of str or path
        The verb, then its options and names.
    on_progress : callable, optional
        Called as ``on_progress(done, total)`` some ten times a second, in pictures; `total` is an estimate, and None
        where nobody knows it.
    cwd : path, optional
        The folder to run in.
    timeout : float, optional
        Seconds.
    launcher : sequence of str, optional
        A command that runs the program, such as ``("nice",)``.

    Returns
    -------
    str
        What the program wrote to standard output.

    Raises
    ------
    Error
        The program failed: its class says how, its text is the program's.
    ProgramTimeoutError
        It took more than `timeout`.

    Warns
    -----
    PartialWarning
        There are results, but the source was cut off or damaged, or something was left out.
    """
    name = program()
    try:
        child = subprocess.Popen(
            [*launcher, name, *map(os.fspath, arguments)],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            cwd=cwd,
            start_new_session=True,  # Ctrl-C is ours; and what it starts is ended with it
        )
    except OSError as problem:
        raise ProgramMissingError(f"{name}: {problem.strerror}") from problem
    try:
        out, log = _read_until_end(child, timeout)
    except BaseException:
        _end(child)
        raise
    text = out.decode("utf-8", "replace")
    notes = log.decode("utf-8", "replace")
    if child.returncode == 0:
        return text
    if child.returncode == _FAILED and text:
        warnings.warn(_without_name(notes), PartialWarning, stacklevel=2)
        return text
    raise _error_of(child.returncode, notes)


def _read_until_end(child: subprocess.Popen[bytes], timeout: float | None) -> tuple[bytes, bytes]:
    """Collect standard output and standard error."""
    end = None if timeout is None else time.monotonic() + timeout
    assert child.stdout is not None and child.stderr is not None
    collected = {child.stdout.fileno(): bytearray(), child.stderr.fileno(): bytearray()}
    out, log = collected.values()
    with selectors.DefaultSelector() as pipes, child.stdout, child.stderr:
        for pipe in collected:
            pipes.register(pipe, selectors.EVENT_READ)
        while pipes.get_map():
            left = None if end is None else end - time.monotonic()
            if left is not None and left <= 0:
                raise ProgramTimeoutError(f"fbs took more than {timeout:g} s")
            for key, _ in pipes.select(left):
                piece = os.read(key.fd, 1 << 16)
                collected[key.fd] += piece
                if not piece:
                    pipes.unregister(key.fd)
    child.wait()
    return bytes(out), bytes(log)


def _end(child: subprocess.Popen[bytes]) -> None:
    """End the program with all that it has started."""
    try:
        os.killpg(child.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass
    child.wait()


def _without_name(log: str) -> str:
    return "; ".join(line.removeprefix("fbs: ") for line in log.splitlines())


def _error_of(exit_code: int, log: str) -> Error:
    lines = log.splitlines()
    if exit_code < 0:
        text = f"fbs was ended by {signal.Signals(-exit_code).name}"
    elif lines:
        text = lines[-1].removeprefix("fbs: ")
    else:
        text = f"fbs ended with exit code {exit_code}"
    return Error(text, exit_code=exit_code, log=log)


def main() -> None:
    """The command ``fbs`` of an installed package: becomes the program."""
    try:
        name = program()
    except ProgramMissingError as problem:
        sys.exit(f"fbs: {problem}")
    os.execv(name, [name, *sys.argv[1:]])
