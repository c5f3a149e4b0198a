"""The charts of a report, from the tables."""

from __future__ import annotations

import numpy as np
import pandas as pd
from markupsafe import Markup

from fbs.corpus.clip_table import ENVELOPE, bd_column, rival_column
from fbs.corpus.report.chart import Row, Series, curve_chart, row_chart
from fbs.corpus.setting import PEERS
from fbs.corpus.statistics import median_interval

NAMES = {"fbs": "fbs", "x264": "x264", "x265": "x265", "av1": "AV1", ENVELOPE: "best of all"}


def peers_of(points: pd.DataFrame) -> list[str]:
    """Other codecs that have points."""
    there = set(points["codec"])
    return [p for p in PEERS if p in there]


def rate_chart(streams: pd.DataFrame, peers: list[str], area: str) -> Markup:
    """Median luma PSNR at each quality of fbs, and of other codecs at the rates that it takes for each clip."""
    groups = streams.groupby("quality")
    rate = groups["kbps"].median()
    psnr = groups[f"psnr_{area}"]
    low, middle, high = (psnr.quantile(q) for q in (0.25, 0.5, 0.75))
    shown = middle.notna()
    own = (values[shown].tolist() for values in (rate, middle, low, high))
    series = [Series("fbs", "fbs", *own, has_points=True)]
    for peer in peers:
        rivals = groups[rival_column(peer, area)]
        shown = 4 * rivals.count() >= 3 * groups.size()  # else it would be the median of easy clips
        series.append(Series(NAMES[peer], peer, rate[shown].tolist(), rivals.median()[shown].tolist(), has_points=True))
    label = f"Median luma PSNR of the {area} over bitrate"
    return curve_chart([s for s in series if s.x], "kbit/s", f"{area}, dB", label)


def bd_chart(clips: pd.DataFrame, peers: list[str], area: str) -> Markup:
    """How BD-rates are distributed over the clips."""
    rows = []
    for peer in (*peers, *([ENVELOPE] if len(peers) > 1 else [])):
        values = clips[bd_column(peer, area)].to_numpy(dtype=float)
        rows.append(Row(NAMES[peer], peer, values[np.isfinite(values)], median_interval(values)))
    return row_chart(rows, "BD-rate, %: left of 0 fbs needs less", f"Distribution of BD-rates of the {area}", mark=0)


def quality_chart(streams: pd.DataFrame, column: str, x_name: str, *, is_log: bool = False) -> Markup:
    """How a column of the streams of fbs is distributed, a row for each quality."""
    rows = []
    for quality, group in streams.groupby("quality"):
        values = group[column].to_numpy(dtype=float)
        rows.append(Row(f"quality {quality}", "fbs", values[np.isfinite(values)]))
    return row_chart(rows, x_name, f"Distribution of {x_name}", is_log=is_log)
