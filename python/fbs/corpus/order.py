"""The request that all tasks of a run share."""

from __future__ import annotations

from dataclasses import dataclass

from fbs.corpus.clip import Clip, short_hash
from fbs.corpus.setting import Setting


@dataclass(frozen=True)
class Order:
    """The request; small, since it travels with each task."""

    program: str
    """What ``fbs --version`` must say on every worker."""
    results: str | None
    """Folder that workers write to; None: results are sent to the client."""
    run: str
    """Tells this run from earlier ones."""
    frames: int | None = None
    """Use at most this many pictures of each clip, from the first on."""
    effort: int = 5
    allow_no_face: bool = False
    keep_streams: bool = False
    attempts: int = 3
    """So often a task may begin; it does so again when its worker was killed."""
    timeout_s: float = 3600
    """Of each call of the program."""
    memory_bytes: int | None = None
    """Address space of each call of the program."""

    def task_key(self, clip: Clip, setting: Setting) -> str:
        """Names the result of a task: another clip, setting or program has another."""
        return short_hash([clip.key, setting.name, self.program, self.frames, self.effort, self.allow_no_face])
