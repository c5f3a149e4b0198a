"""Tasks: what a worker does with one clip and one setting. Only bytes of streams and numbers leave it."""

from __future__ import annotations

import json
import time
from pathlib import Path

from fbs.corpus import work
from fbs.corpus.attempt import Attempt
from fbs.corpus.child import Calls
from fbs.corpus.clip import Clip
from fbs.corpus.measures import Row
from fbs.corpus.order import Order
from fbs.corpus.result import Reference, Result
from fbs.corpus.results_folder import ResultsFolder
from fbs.corpus.setting import FbsSetting, PeerSetting, Setting


def make_reference(clip: Clip, setting: FbsSetting, order: Order) -> Reference:
    """Encode a clip at the highest quality, unless a worker has done so in an earlier run."""
    key = order.task_key(clip, setting)
    folder = _folder_of(order)
    if folder is not None and (kept := _kept_reference(folder, clip, stream_name(setting, key))):
        return kept
    attempt = Attempt(f"{key}.reference", order, folder)
    reference = Reference(setting.quality)

    def encode(calls: Calls, scratch: Path) -> None:
        stream = scratch / "reference.fbs"
        reference.encode_s = calls.encode(clip.path, stream, setting.quality)
        reference.stream = stream.read_bytes()

    _, reference.error = attempt.run(encode)
    reference.attempts = attempt.number
    reference.host = attempt.host
    reference.seconds = attempt.seconds
    reference.cpu_s = attempt.cpu_s
    reference.notes = attempt.notes
    if folder is not None and reference.error is None:
        name = stream_name(setting, key)
        folder.keep_stream(clip.key, name, reference.stream)
        folder.keep_stream(clip.key, f"{name}.json", reference.to_json().encode())
    return reference


def _kept_reference(folder: ResultsFolder, clip: Clip, name: str) -> Reference | None:
    facts = folder.stream_path(clip.key, f"{name}.json")  # written last
    if not facts.exists():
        return None
    return Reference(stream=folder.stream_path(clip.key, name).read_bytes(), **json.loads(facts.read_text()))


def measure(setting: Setting, clip: Clip, order: Order, reference: Reference) -> Result:
    """Encode a clip, decode the stream, measure its pictures.

    Returns
    -------
    Result
        Where `order.results` is a folder, the result is in there, too, and has no streams.
    """
    folder = _folder_of(order)
    key = order.task_key(clip, setting)
    if folder is not None and (kept := folder.find(key)):  # the worker died before the client asked for it
        return kept
    result = failed_result(clip, setting, order, reference.error or "", reference.attempts)
    if reference.error is None:
        _measure(result, clip, setting, order, reference, folder)
    else:
        result.task |= {"host": reference.host, "task_s": reference.seconds}
    if folder is not None:
        folder.keep(result)
        result.streams = {}
    return result


def failed_result(clip: Clip, setting: Setting, order: Order, error: str, attempts: int) -> Result:
    """Result for a task that returned none."""
    return Result(
        {
            "clip": clip.shown_name,
            "clip_key": clip.key,
            "setting": setting.name,
            "task_key": order.task_key(clip, setting),
            "error": error,
            "points": 0,
            "attempts": attempts,
            "finished": round(time.time() * 1000),
        }
    )


def _measure(
    result: Result,
    clip: Clip,
    setting: Setting,
    order: Order,
    reference: Reference,
    folder: ResultsFolder | None,
) -> None:
    is_own = isinstance(setting, FbsSetting) and setting.quality == reference.quality

    def rows_of(calls: Calls, scratch: Path) -> list[Row]:
        region = scratch / "reference.fbs"
        region.write_bytes(reference.stream)
        if isinstance(setting, PeerSetting):
            return work.measure_peer(calls, clip, setting, region)
        own: Row = {"quality": setting.quality}
        if is_own:
            stream = region
            own |= work.measure_stream(calls, clip, stream, region, reference.encode_s, scratch)
            own |= work.measure_pose(calls, stream, scratch)
        else:
            stream = scratch / "stream.fbs"
            own |= work.encode_and_measure(calls, clip, setting, region, stream, scratch)
        if order.keep_streams:
            result.streams[stream_name(setting, result.key)] = stream.read_bytes()
        return [own]

    attempt = Attempt(result.key, order, folder)
    rows, error = attempt.run(rows_of)
    names = ("clip", "clip_key", "setting", "task_key")
    common = {name: result.task[name] for name in names} | {"program": order.program}
    result.points = [common | row for row in rows or []]
    cpu_s = attempt.cpu_s
    if is_own and cpu_s is not None:
        cpu_s = None if reference.cpu_s is None else cpu_s + reference.cpu_s
    result.task |= {
        "error": error,
        "points": len(result.points),
        "attempts": max(attempt.number, reference.attempts if is_own else 1),
        "host": attempt.host,
        "task_s": attempt.seconds + (reference.seconds if is_own else 0),
        "cpu_s": cpu_s,
        "note": "; ".join(dict.fromkeys(reference.notes + attempt.notes)) or None,
        "finished": round(time.time() * 1000),
    }


def stream_name(setting: FbsSetting, key: str) -> str:
    """File name of a stream in the folder of results."""
    return f"{setting.name}.{key}.fbs"


def _folder_of(order: Order) -> ResultsFolder | None:
    return None if order.results is None else ResultsFolder(order.results)
