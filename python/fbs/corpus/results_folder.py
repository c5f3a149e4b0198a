"""The folder of results: what is finished, so that it is not done again.

::

    run.json               what was asked for
    finished/ab/KEY.json   tasks that are not yet in the tables
    attempts/KEY           a line for each time that an unfinished task has begun
    streams/CLIP/          the best stream while tasks need it; with --keep-streams all of them, for good
    tasks/part-N.parquet   a row for each task
    points/part-N.parquet  a row for each point that they measured
    failures.parquet       the tasks that failed
    clips.parquet          a row for each clip, made with the report
    report.html
"""

from __future__ import annotations

import contextlib
import fcntl
import json
import os
import shutil
import socket
import tempfile
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.parquet as parquet

from fbs.corpus.result import Result
from fbs.corpus.schema import POINTS, TASKS, table_of


def write_atomically(path: Path, content: bytes) -> None:
    """The file appears under its name when it is complete; its folder is made."""
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        os.chmod(name, 0o644)
        os.replace(name, path)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise


def _write_table(path: Path, table: pa.Table) -> None:
    sink = pa.BufferOutputStream()
    parquet.write_table(table, sink, compression="zstd")
    write_atomically(path, sink.getvalue().to_pybytes())


class Keys:
    """A set of task keys that takes eight bytes for each."""

    def __init__(self, keys: Iterable[str] = ()) -> None:
        self._sorted = np.unique(np.fromiter((int(k, 16) for k in keys), dtype=np.uint64))

    def __contains__(self, key: str) -> bool:
        value = np.uint64(int(key, 16))
        at = int(np.searchsorted(self._sorted, value))
        return at < len(self._sorted) and bool(self._sorted[at] == value)

    def __len__(self) -> int:
        return len(self._sorted)


class ResultsFolder:
    """Results of a run on a disk. Workers write tasks, attempts and streams; only the client writes tables."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = Path(path)

    # Tasks.

    def _finished_path(self, key: str) -> Path:
        return self.path / "finished" / key[:2] / f"{key}.json"

    def keep(self, result: Result) -> None:
        for name, stream in result.streams.items():
            self.keep_stream(result.clip_key, name, stream)
        write_atomically(self._finished_path(result.key), result.to_json().encode())

    def find(self, key: str) -> Result | None:
        """Result of a finished task that is not yet in the tables."""
        try:
            return Result.from_json(self._finished_path(key).read_text())
        except FileNotFoundError:
            return None

    def begin(self, key: str, run: str) -> int:
        """Record that a task begins.

        Returns
        -------
        int
            How often it has begun in this run, this time included.
        """
        path = self.path / "attempts" / key
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open("a+") as file:
            file.write(f"{run} {socket.gethostname()}\n")
            file.flush()
            file.seek(0)
            return sum(line.split(" ", 1)[0] == run for line in file)

    def last_host(self, key: str) -> str:
        """Where a task began the time before last."""
        lines = (self.path / "attempts" / key).read_text().splitlines()
        return lines[-2].split(" ", 1)[1] if len(lines) > 1 else ""

    def end(self, key: str) -> None:
        (self.path / "attempts" / key).unlink(missing_ok=True)

    # Streams.

    def stream_path(self, clip_key: str, name: str) -> Path:
        return self.path / "streams" / clip_key / name

    def keep_stream(self, clip_key: str, name: str, content: bytes) -> None:
        write_atomically(self.stream_path(clip_key, name), content)

    def drop_streams(self, clip_key: str) -> None:
        shutil.rmtree(self.path / "streams" / clip_key, ignore_errors=True)

    # Tables. A part of points counts only beside the part of tasks, which is written after it.

    def _parts(self) -> list[Path]:
        return sorted(self.path.glob("tasks/part-*.parquet"))

    def fold(self, keys: Iterable[str] | None = None) -> int:
        """Put finished tasks into the tables, and remove their files.

        Parameters
        ----------
        keys : iterable of str, optional
            Only of these.

        Returns
        -------
        int
            How many.
        """
        if keys is None:
            paths = sorted(self.path.glob("finished/??/*.json"))
        else:
            paths = [path for path in map(self._finished_path, keys) if path.exists()]
        if not paths:
            return 0
        results = [Result.from_json(path.read_text()) for path in paths]
        parts = self._parts()
        number = int(parts[-1].stem.removeprefix("part-")) + 1 if parts else 0
        points = [row for result in results for row in result.points]
        _write_table(self.path / "points" / f"part-{number:06d}.parquet", table_of(points, POINTS))
        tasks = [result.task for result in results]
        _write_table(self.path / "tasks" / f"part-{number:06d}.parquet", table_of(tasks, TASKS))
        for path in paths:
            path.unlink(missing_ok=True)
        return len(paths)

    def points(self, columns: list[str] | None = None) -> pa.Table:
        """Rows of all points."""
        schema = POINTS if columns is None else pa.schema([POINTS.field(c) for c in columns])
        tables = [
            parquet.read_table(self.path / "points" / part.name, columns=columns).cast(schema) for part in self._parts()
        ]
        return pa.concat_tables([schema.empty_table(), *tables])

    def tasks(self) -> pd.DataFrame:
        """The last row of each task."""
        tables = [parquet.read_table(part) for part in self._parts()]
        frame = pa.concat_tables([TASKS.empty_table(), *tables]).to_pandas()
        return frame.drop_duplicates("task_key", keep="last", ignore_index=True)

    def write_failures(self, tasks: pd.DataFrame) -> int:
        """Write the table of those among `tasks` that failed; give their number."""
        failed = tasks[tasks["error"].notna()].sort_values(["clip", "setting"])
        _write_table(
            self.path / "failures.parquet",
            pa.Table.from_pandas(failed, schema=TASKS, preserve_index=False),
        )
        return len(failed)

    def finished(self) -> tuple[Keys, Keys]:
        """Keys of the tasks in the tables: those that are done, and those that failed."""
        done: list[str] = []
        failed: list[str] = []
        for part in self._parts():
            table = parquet.read_table(part, columns=["task_key", "error"])
            is_done = table["error"].is_null()
            done += table.filter(is_done)["task_key"].to_pylist()
            failed += table.filter(pc.invert(is_done))["task_key"].to_pylist()
        done_keys = Keys(done)
        return done_keys, Keys(k for k in failed if k not in done_keys)

    # The run.

    @contextlib.contextmanager
    def locked(self) -> Iterator[None]:
        """Keep other commands out; the lock goes with the process, however that ends.

        Raises
        ------
        ValueError
            Another command is at work here.
        """
        self.path.mkdir(parents=True, exist_ok=True)
        with (self.path / ".lock").open("w") as file:
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                raise ValueError(f"{self.path}: another command is at work there") from None
            yield

    def begin_run(self, asked: dict[str, Any]) -> None:
        """Note what is asked for.

        Raises
        ------
        ValueError
            The folder has results of another corpus, or of other pictures of this one.
        """
        path = self.path / "run.json"
        if path.exists():
            before = json.loads(path.read_text())
            if before["folder"] != asked["folder"]:
                raise ValueError(f"{self.path}: has results of {before['folder']}; give another --out")
            for name in ("frames", "effort", "allow_no_face"):
                if before[name] != asked[name]:
                    option = "--" + name.replace("_", "-")
                    raise ValueError(f"{self.path}: has results with another {option}; give another --out")
        write_atomically(path, (json.dumps(asked, indent=1) + "\n").encode())

    def asked(self) -> dict[str, Any]:
        """What was asked for; empty before the first run."""
        path = self.path / "run.json"
        return json.loads(path.read_text()) if path.exists() else {}
