"""Results of tasks: rows for the tables."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, field


@dataclass
class Result:
    """Result of one task."""

    task: dict[str, object]
    """Its row in the table of tasks."""
    points: list[dict[str, object]] = field(default_factory=list)
    """Its rows in the table of points."""
    streams: dict[str, bytes] = field(default_factory=dict)
    """By file name, those to be kept, where results go through the client."""

    @property
    def key(self) -> str:
        return str(self.task["task_key"])

    @property
    def clip_key(self) -> str:
        return str(self.task["clip_key"])

    @property
    def failed(self) -> bool:
        return self.task["error"] is not None

    def to_json(self) -> str:
        fields = asdict(self)
        del fields["streams"]
        return json.dumps(fields)

    @classmethod
    def from_json(cls, text: str) -> Result:
        return cls(**json.loads(text))


@dataclass
class Reference:
    """The best stream of a clip, whose mesh says where the face is for all its tasks."""

    quality: int
    stream: bytes = b""
    encode_s: float = 0
    cpu_s: float | None = None
    notes: list[str] = field(default_factory=list)
    attempts: int = 1
    error: str | None = None
    """Why there is no stream: then no task of the clip can be done."""
    host: str | None = None
    seconds: float = 0
    """Wall time of making it."""

    def to_json(self) -> str:
        fields = asdict(self)
        del fields["stream"]
        return json.dumps(fields)
