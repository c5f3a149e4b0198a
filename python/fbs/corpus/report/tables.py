"""The sentences and tables of a report, from the tables of a run."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd

from fbs.corpus.clip_table import ENVELOPE, bd_column
from fbs.corpus.report.charts import NAMES
from fbs.corpus.statistics import median_interval, spread


def number(value: float | None, digits: int = 1) -> str:
    """A number as text; an en dash where there is none."""
    if value is None or not math.isfinite(value):
        return "\N{EN DASH}"
    return f"{value:.{digits}f}".replace("-", "\N{MINUS SIGN}")


def things(count: int, name: str) -> str:
    """ "1 clip", "12 clips"."""
    return f"{count} {name}" + ("" if count == 1 else "s")


def names(peers: list[str]) -> str:
    """ "x264, x265 and AV1"."""
    shown = [NAMES[p] for p in peers]
    return " and ".join([", ".join(shown[:-1]), shown[-1]] if len(shown) > 1 else shown)


def counts(tasks: pd.DataFrame, clips: pd.DataFrame) -> dict[str, object]:
    """How much there was to do, and what it took."""
    failed = tasks["error"].notna()
    return {
        "tasks": len(tasks),
        "failed_tasks": int(failed.sum()),
        "clips": int(tasks["clip"].nunique()),
        "failed_clips": int(tasks.loc[failed, "clip"].nunique()),
        "measured": len(clips),
        "hosts": int(tasks["host"].nunique()),
        "task_s": float(tasks["task_s"].sum()),
        "cpu_s": float(tasks["cpu_s"].sum()),
        "seconds": float(clips["seconds"].sum()) if len(clips) else 0.0,
        "pictures": int(clips["pictures"].sum()) if len(clips) else 0,
        "again": int((tasks["attempts"] > 1).sum()),
        "noted": int(tasks.loc[tasks["note"].notna(), "clip"].nunique()),
    }


def failures(tasks: pd.DataFrame, most: int) -> dict[str, object]:
    """Failed tasks, those of one clip with one error in one row."""
    failed = tasks[tasks["error"].notna()]
    groups = failed.groupby(["clip", "error"], sort=True)
    rows = [
        {
            "clip": clip,
            "error": error,
            "settings": len(group),
            "attempts": int(group["attempts"].max()),
            "host": next((h for h in group["host"] if isinstance(h, str)), "\N{EN DASH}"),
        }
        for (clip, error), group in groups
    ]
    return {"rows": rows[:most], "left_out": max(0, len(rows) - most)}


def summary(clips: pd.DataFrame, peers: list[str]) -> str:
    """What the run says, in a sentence or two."""
    face = clips["psnr_face"].to_numpy(dtype=float)
    out = (
        f"At the middle quality fbs takes {number(clips['kbps'].median())} kbit/s, with a luma PSNR of "
        f"{number(float(np.nanmedian(face)) if np.isfinite(face).any() else None)} dB for the face and "
        f"{number(clips['psnr_frame'].median())} dB for the frame (medians of {len(clips)} clips)."
    )
    found = []
    for area in ("face", "frame"):
        values = clips[bd_column(ENVELOPE, area)].to_numpy(dtype=float)
        values = values[np.isfinite(values)]
        if not len(values):
            continue
        median = float(np.median(values))
        text = f"{number(abs(median), 0)} % {'less' if median < 0 else 'more'} rate for the same {area}"
        if interval := median_interval(values):
            low, high = (number(end, 0) for end in interval)
            text += f" (95\N{NO-BREAK SPACE}% interval {low} to {high} %; {len(values)} clips)"
        found.append(text)
    if found:
        best = f"the best of {names(peers)}" if len(peers) > 1 else names(peers)
        out += f" Compared with {best} it needs {' and '.join(found)}: medians of BD-rate."
    return out


def bd_rows(clips: pd.DataFrame, peers: list[str]) -> list[dict[str, object]]:
    """BD-rates against each codec, of face and frame."""
    rows = []
    for peer in (*peers, *([ENVELOPE] if len(peers) > 1 else [])):
        row: dict[str, object] = {"name": NAMES[peer]}
        for area in ("face", "frame"):
            values = clips[bd_column(peer, area)].to_numpy(dtype=float)
            values = values[np.isfinite(values)]
            row[area] = {
                "spread": spread(values, more_is_better=False),
                "interval": median_interval(values),
                "better": 100 * float((values < 0).mean()) if len(values) else None,
            }
        rows.append(row)
    return rows


def quality_rows(streams: pd.DataFrame) -> list[dict[str, object]]:
    """Medians and quartiles of each quality."""
    columns = ("kbps", "psnr_face", "psnr_frame", "gain_face", "gain_frame", "encode_speed", "decode_speed")
    rows = []
    for quality, group in streams.groupby("quality"):
        row: dict[str, object] = {"quality": quality, "clips": len(group)}
        rows.append(row | {column: spread(group[column].to_numpy(dtype=float)) for column in columns})
    return rows


def clip_rows(clips: pd.DataFrame, most: int) -> list[dict[str, object]]:
    """Clips in order of name."""
    shown = clips.head(most)
    out = []
    for _, clip in shown.iterrows():
        row = {name: clip[name] for name in ("clip", "width", "height", "pictures", "kbps", "psnr_face", "psnr_frame")}
        row |= {f"gain_{area}": clip[f"gain_{area}"] for area in ("face", "frame")}
        row |= {f"bd_{area}": clip[bd_column(ENVELOPE, area)] for area in ("face", "frame")}
        out.append(row)
    return out


def worst_row(clip: pd.Series, images: dict[str, str], error: str | None) -> dict[str, object]:
    """One of the worst clips."""
    names = (
        "clip",
        "width",
        "height",
        "kbps",
        "quality",
        "psnr_face",
        "psnr_frame",
        "worst_picture",
        "worst_psnr",
        "reasons",
    )
    row = {name: clip[name] for name in names}
    row |= {"gain_face": clip["gain_face"], "bd_face": clip[bd_column(ENVELOPE, "face")]}
    return row | {"images": images, "error": error}
