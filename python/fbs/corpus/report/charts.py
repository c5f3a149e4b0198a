"""The charts of a report, from the tables."""

from __future__ import annotations

import numpy as np
import pandas as pd
from markupsafe import Markup

from fbs.corpus.bd_rate import Curve, quality_at
from fbs.corpus.clip_table import ENVELOPE, bd_column, clip_curves
from fbs.corpus.report.chart import Row, Series, curve_chart, row_chart
from fbs.corpus.setting import PEERS
from fbs.corpus.statistics import median_interval

NAMES = {"fbs": "fbs", "x264": "x264", "x265": "x265", "av1": "AV1", ENVELOPE: "best of all"}
_GRID_POINTS = 40
_MOST_CLIPS = 3000
"""Clips that curves of other codecs are interpolated for, evenly chosen of more: medians hardly change."""


def peers_of(points: pd.DataFrame) -> list[str]:
    """Other codecs that have points."""
    there = set(points["codec"])
    return [p for p in PEERS if p in there]


def rate_chart(points: pd.DataFrame, area: str) -> Markup:
    """Median and quartiles of luma PSNR: of fbs at each quality, of others at rates that most clips have."""
    clips = points["clip"].unique()
    some = points[points["clip"].isin(clips[:: -(-len(clips) // _MOST_CLIPS)])]
    curves = [curves for _, curves in clip_curves(some, area)]
    series = [_own_series(points[points["codec"] == "fbs"], area)]
    series += [_peer_series([c[p] for c in curves if c.get(p)], p) for p in peers_of(points)]
    label = f"Median luma PSNR of the {area} over bitrate"
    return curve_chart([s for s in series if s.x], "kbit/s", f"{area}, dB", label)


def _own_series(points: pd.DataFrame, area: str) -> Series:
    groups = points.dropna(subset=[f"psnr_{area}"]).groupby("quality")
    rate = groups["kbps"].median()
    low, middle, high = (groups[f"psnr_{area}"].quantile(q) for q in (0.25, 0.5, 0.75))
    return Series("fbs", "fbs", rate.tolist(), middle.tolist(), low.tolist(), high.tolist(), has_points=True)


def _peer_series(curves: list[Curve], peer: str) -> Series:
    series = Series(NAMES[peer], peer, [], [])
    if not curves:
        return series
    lowest, highest = (float(np.median([curve[end][0] for curve in curves])) for end in (0, -1))
    for kbps in np.geomspace(lowest, highest, _GRID_POINTS).tolist():
        values = [q for curve in curves if (q := quality_at(curve, kbps)) is not None]
        if 2 * len(values) >= len(curves):  # else it would be the median of easy clips
            series.x.append(kbps)
            series.y.append(float(np.median(values)))
    return series


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
