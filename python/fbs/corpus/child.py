"""Calls of the program on a worker: within limits, and never longer than the worker lives."""

from __future__ import annotations

import resource
import shutil
import time
import warnings
from dataclasses import dataclass, field
from pathlib import Path

from fbs import _program
from fbs.corpus.order import Order
from fbs.errors import Error, PartialWarning


def _launcher(memory_bytes: int | None) -> list[str]:
    """The kernel ends the program with the thread that started it, or orphans would go on after a kill -9."""
    out: list[str] = []
    if setpriv := shutil.which("setpriv"):
        out += [setpriv, "--pdeathsig", "KILL"]
    if memory_bytes is not None:
        prlimit = shutil.which("prlimit")
        if prlimit is None:
            raise Error("a limit of memory needs prlimit of util-linux")
        out += [prlimit, f"--as={memory_bytes}"]
    return out


def program_version() -> str:
    """The version text of this machine's program."""
    return _program.run(["--version"], timeout=60).strip()


@dataclass
class Calls:
    """The calls that one task makes."""

    order: Order
    notes: list[str] = field(default_factory=list)
    """What the program said about sources that are cut off."""

    def run(self, *arguments: str | Path) -> tuple[str, float]:
        """Run fbs; give its output and the wall time, s."""
        begin = time.monotonic()
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always", PartialWarning)
            text = _program.run(
                [str(a) for a in arguments],
                timeout=self.order.timeout_s,
                launcher=_launcher(self.order.memory_bytes),
            )
        said = [str(w.message) for w in caught if issubclass(w.category, PartialWarning)]
        self.notes += [text for text in said if text not in self.notes]
        return text, time.monotonic() - begin

    def encode(self, clip: str, stream: Path, quality: int) -> float:
        """Encode a clip; give the wall time, s."""
        order = self.order
        options = ["--quality", str(quality), "--effort", str(order.effort), "--threads", "1", "--no-sound", "--quiet"]
        options += self.frames_option()
        if order.allow_no_face:
            options.append("--allow-no-face")
        return self.run("encode", clip, stream, *options)[1]

    def frames_option(self) -> list[str]:
        return [] if self.order.frames is None else ["--frames", str(self.order.frames)]


def children_cpu_s() -> float:
    """CPU time of all programs that this process has run to their end, s."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime
