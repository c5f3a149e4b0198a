"""The work of a task: calls of the program that encode a clip and measure it."""

from __future__ import annotations

import json
from pathlib import Path

from fbs.corpus.child import Calls
from fbs.corpus.clip import Clip
from fbs.corpus.measures import Row, crf_of, format_columns, picture_columns, point_row, pose_columns
from fbs.corpus.setting import FbsSetting, PeerSetting


LARGE = 400 * 400
"""Samples of a picture. Larger ones are coded by peers at a quarter of their size, too, as ``fbs evaluate`` does."""


def measure_stream(calls: Calls, clip: Clip, stream: Path, region: Path, encode_s: float, scratch: Path) -> Row:
    """Decode a stream of fbs and compare its pictures with the clip's."""
    row = format_columns(calls.run("inspect", stream, "--json")[0])
    _, row["decode_s"] = calls.run("decode", stream, "null:", "--threads", "1", "--quiet")
    row["encode_s"] = encode_s
    table = scratch / "pictures.csv"
    report = _evaluate(calls, clip, stream, "--region", region, "--csv", table)
    row |= point_row(report["points"][0])
    row |= picture_columns(table.read_text(), int(row["width"]) * int(row["height"]))
    row["face_pictures"] = report["region"]["frames"]
    return row


def measure_pose(calls: Calls, stream: Path, scratch: Path) -> Row:
    """How much the head moves."""
    table = scratch / "pose.csv"
    calls.run("export", stream, table)
    return pose_columns(table.read_text())


def measure_peer(calls: Calls, clip: Clip, setting: PeerSetting, reference: Path) -> list[Row]:
    """Points of another codec, up to a rate above that of the reference. None at a quarter of a small picture's size."""
    shape = format_columns(calls.run("inspect", reference, "--json")[0])
    if setting.size == 4 and int(shape["width"]) * int(shape["height"]) <= LARGE:
        return []
    options = ["--peer-codec", setting.codec, "--peer-size", setting.size, "--peer-rate", setting.rate]
    report = _evaluate(calls, clip, reference, "--peers", *map(str, options))
    columns = {
        "width": shape["width"],
        "height": shape["height"],
        "fps": shape["fps"],
        "peer_size": setting.size,
        "peer_rate": setting.rate,
        "face_pictures": report["region"]["frames"],
    }
    return [{**point_row(p), **columns, "crf": crf_of(p["point"])} for p in report["peers"]]


def encode_and_measure(calls: Calls, clip: Clip, setting: FbsSetting, region: Path, stream: Path, scratch: Path) -> Row:
    """A point of fbs; the stream is left in its file."""
    encode_s = calls.encode(clip.path, stream, setting.quality)
    return measure_stream(calls, clip, stream, region, encode_s, scratch)


def make_stills(calls: Calls, clip: Clip, stream: Path, region: Path, folder: Path) -> None:
    """Write pictures of the clip, of the stream, and their difference."""
    _evaluate(calls, clip, stream, "--region", region, "--stills", folder)


def _evaluate(calls: Calls, clip: Clip, stream: Path, *options: str | Path) -> dict:
    text, _ = calls.run("evaluate", clip.path, stream, "--json", "--quiet", *calls.frames_option(), *options)
    return json.loads(text)
