"""Attempts: a piece of work on a worker that may fail, be killed, or kill its worker."""

from __future__ import annotations

import functools
import socket
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

import distributed

from fbs.corpus.child import Calls, children_cpu_s, program_version
from fbs.corpus.order import Order
from fbs.corpus.results_folder import ResultsFolder
from fbs.errors import Error

T = TypeVar("T")


class Attempt:
    """Runs one piece of work in a scratch folder, and keeps count.

    A clip that takes its worker down cannot report it. So each start is recorded in the folder of results, and
    once there are `order.attempts` of this run without an end, the clip is given up. Without a folder that workers
    share, the client can only count what Dask tells it.
    """

    def __init__(self, key: str, order: Order, folder: ResultsFolder | None) -> None:
        self.host = socket.gethostname()
        self.seconds = 0.0
        self.cpu_s: float | None = None
        self.notes: list[str] = []
        self.number = 1
        self._key = key
        self._order = order
        self._folder = folder

    def run(self, work: Callable[[Calls, Path], T]) -> tuple[T | None, str | None]:
        """Do the work, again where its program was killed; give what it returns, or one line of error."""
        if self._folder is not None:
            self.number = self._folder.begin(self._key, self._order.run)
            if self.number > self._order.attempts:
                self.number -= 1
                self.host = self._folder.last_host(self._key)
                self._folder.end(self._key)
                return None, f"its worker was killed, {self.number} times"
        begin, cpu = time.monotonic(), children_cpu_s()
        value, error = self._within_attempts(work)
        self.seconds = time.monotonic() - begin
        if _is_alone():
            self.cpu_s = children_cpu_s() - cpu
        if self._folder is not None:
            self._folder.end(self._key)
        return value, error

    def _within_attempts(self, work: Callable[[Calls, Path], T]) -> tuple[T | None, str | None]:
        while True:
            try:
                return self._once(work), None
            except Error as problem:
                killed = problem.exit_code is not None and problem.exit_code < 0
                if not killed or self.number >= self._order.attempts:
                    return None, _one_line(problem)
                self.number += 1
            except OSError as problem:  # a full disk, say
                return None, f"{self.host}: {_one_line(problem)}"

    def _once(self, work: Callable[[Calls, Path], T]) -> T:
        calls = Calls(self._order)
        own = _own_version()
        if own != self._order.program:
            raise Error(f"{self.host} has {own}, and the run began with {self._order.program}")
        with tempfile.TemporaryDirectory(prefix="task-", dir=_scratch()) as scratch:
            value = work(calls, Path(scratch))
        self.notes = calls.notes
        return value


@functools.cache
def _own_version() -> str:
    return program_version()


def _worker() -> distributed.Worker | None:
    try:
        return distributed.get_worker()
    except ValueError:  # called without a cluster
        return None


def _is_alone() -> bool:
    """Whether CPU time of the children of this process is that of one task."""
    worker = _worker()
    return worker is None or (worker.state.nthreads == 1 and worker.nanny is not None)


def _scratch() -> str | None:
    """The worker's own folder: Dask removes that of a worker that was killed."""
    worker = _worker()
    return None if worker is None else worker.local_directory


def _one_line(problem: BaseException) -> str:
    return " ".join(str(problem).split())
