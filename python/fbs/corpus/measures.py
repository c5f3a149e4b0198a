"""Rows of the table of points, from the program's output."""

from __future__ import annotations

import csv
import io
import json
import math
from typing import Any

import numpy as np

Row = dict[str, Any]

_AREAS = [f"{m}_{a}" for a in ("face", "frame") for m in ("psnr", "psnr_u", "psnr_v", "ssim", "ms_ssim")]


def point_row(point: Row) -> Row:
    """Columns that a point of ``fbs evaluate --json`` has, of fbs or another codec."""
    parts = point["bytes"]
    row: Row = {
        "codec": str(point["codec"]).lower(),
        "pictures": point["frames"],
        "seconds": point["seconds"],
        "bytes": parts["total"] - parts.get("sound", 0),
        "kbps": point["kbps"],
        "vmaf_frame": point.get("vmaf_frame"),
    }
    row |= {name: point.get(name) for name in _AREAS}
    row |= {f"bytes_{p}": parts.get(p) for p in ("startup", "geometry", "patterns", "motion")}
    return row


def crf_of(label: str) -> int:
    """The crf in a peer's name, such as "x265 1/2 size crf 45"."""
    return int(label.rpartition(" ")[2])


def picture_columns(table: str, samples: int) -> Row:
    """Columns that follow from the pictures of one stream: the worst of them, and the size of the face.

    Parameters
    ----------
    table : str
        What ``fbs evaluate --csv`` writes.
    samples : int
        Of a frame.
    """
    lines = list(csv.DictReader(io.StringIO(table)))
    face = [(float(line["face_psnr_y"]), int(line["picture"])) for line in lines if line["face_psnr_y"]]
    worst = min(face or [(float(line["psnr_y"]), int(line["picture"])) for line in lines])
    sizes = [int(line["face_samples"]) for line in lines if int(line["face_samples"]) > 0]
    return {
        "worst_psnr": worst[0],
        "worst_picture": worst[1],
        "face_share": float(np.mean(sizes)) / samples if sizes else None,
    }


def format_columns(inspected: str) -> Row:
    """Columns that ``fbs inspect --json`` tells of a stream."""
    stream = json.loads(inspected)
    return {
        "width": stream["width"],
        "height": stream["height"],
        "fps": stream["fps"],
        "patterns": stream["pattern_count"],
        "cuts": max(0, len(stream["scenes"]) - 1),
    }


def pose_columns(table: str) -> Row:
    """How much the head moves, from what ``fbs export STREAM OUT.csv`` writes."""
    lines = [line for line in csv.DictReader(io.StringIO(table)) if line["success"] == "1"]
    if not lines:
        return {}

    def column(name: str) -> np.ndarray:
        return np.array([float(line[name]) for line in lines])

    def spread(name: str) -> float:
        low, high = np.percentile(column(name), [5, 95])
        return float(high - low)

    out: Row = {"yaw_range_deg": spread("ry_deg"), "pitch_range_deg": spread("rx_deg")}
    time = np.diff(column("timestamp"))
    # The outer corners of the eyes, landmarks 36 and 45 of 68.
    eyes = np.hypot(column("x45") - column("x36"), column("y45") - column("y36"))
    path = np.hypot(np.diff(column("tx_px")), np.diff(column("ty_px")))
    if len(time) and time.min() > 0 and eyes.min() > 0:
        motion = float(np.median(path / time / eyes[1:]))
        out["motion"] = motion if math.isfinite(motion) else None
    return out
