"""Lines on standard error that say how far a run is."""

from __future__ import annotations

import sys
import time

from fbs.corpus.driver import Tally

_EVERY_S = 5.0


class Progress:
    """Prints a line every few seconds; on a terminal it overwrites the last one."""

    def __init__(self, total: int, quiet: bool) -> None:
        self._total = total
        self._quiet = quiet
        self._begin = self._last = time.monotonic()
        self._on_terminal = sys.stderr.isatty()

    def __call__(self, tally: Tally) -> None:
        now = time.monotonic()
        if self._quiet or (now - self._last < _EVERY_S and tally.done < self._total):
            return
        self._last = now
        end = "\r" if self._on_terminal and tally.done < self._total else "\n"
        print(self._line(tally, now - self._begin).ljust(78), end=end, file=sys.stderr, flush=True)

    def _line(self, tally: Tally, elapsed_s: float) -> str:
        speed = tally.done / elapsed_s
        line = f"fbs.corpus: {tally.done} of {self._total} tasks, {speed:.1f} per second"
        if tally.failed:
            line += f", {tally.failed} failed"
        left_s = (self._total - tally.done) / speed
        return line + (f", {duration(left_s)} left" if left_s >= 1 else "")


def duration(seconds: float) -> str:
    """A duration in the unit that makes it a number of two or three digits."""
    for unit, size in (("days", 86400), ("h", 3600), ("min", 60)):
        if seconds >= 3 * size:
            return f"{seconds / size:.0f} {unit}"
    return f"{seconds:.0f} s"
