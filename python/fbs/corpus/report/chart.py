"""Charts as SVG: curves over rate, and rows that show how values are distributed."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from markupsafe import Markup, escape

from fbs.corpus.report.axis import Axis, axis_over, tick_text

_WIDTH = 480
_MOST_DOTS = 150
"""Values that are drawn one by one; more are drawn as a density."""


@dataclass
class Series:
    """A curve with a band round it."""

    name: str
    css_class: str
    x: list[float]
    y: list[float]
    low: list[float] = field(default_factory=list)
    """Lower edge of the band; empty: none."""
    high: list[float] = field(default_factory=list)
    has_points: bool = False


@dataclass
class Row:
    """Values of one kind: a density or dots, quartiles, median."""

    name: str
    css_class: str
    values: np.ndarray
    interval: tuple[float, float] | None = None
    """Confidence interval of the median."""


def curve_chart(series: list[Series], x_name: str, y_name: str, label: str) -> Markup:
    """Curves over a logarithmic rate, each with its name at its end."""
    height, left, right, top, bottom = 320, 42, 72, 12, 40
    xs = [v for s in series for v in s.x]
    ys = [v for s in series for v in (*s.y, *s.low, *s.high)]
    x = axis_over(xs, left, _WIDTH - right, is_log=True)
    y = axis_over(ys, height - bottom, top)
    parts = [_grid(x, y, x_name, y_name, height - bottom)]
    ends = []
    for s in series:
        band = ""
        if s.low:
            edge = [*zip(s.x, s.high, strict=True), *reversed([*zip(s.x, s.low, strict=True)])]
            band = f'<polygon points="{_points(edge, x, y)}"/>'
        line = [*zip(s.x, s.y, strict=True)]
        dots = (
            "".join(f'<circle cx="{x.at(a):.1f}" cy="{y.at(b):.1f}" r="3.5"/>' for a, b in line) if s.has_points else ""
        )
        parts.append(f'<g class="series {s.css_class}">{band}<polyline points="{_points(line, x, y)}"/>{dots}</g>')
        if line:
            ends.append([x.at(line[-1][0]) + 7, y.at(line[-1][1]) + 4, s])
    parts += [
        f'<text class="name {s.css_class}" x="{at_x:.1f}" y="{at_y:.1f}">{escape(s.name)}</text>'
        for at_x, at_y, s in _apart(ends)
    ]
    return _svg(parts, height, label)


def row_chart(rows: list[Row], x_name: str, label: str, *, is_log: bool = False, mark: float | None = None) -> Markup:
    """One row for each kind of values.

    Parameters
    ----------
    mark : float, optional
        A value to draw a line at, such as 0.
    """
    row_height, left, right, top, bottom = 46, 84, 14, 8, 38
    height = top + row_height * len(rows) + bottom
    values = np.concatenate([r.values for r in rows]) if rows else np.array([])
    x = axis_over([*values.tolist(), *([] if mark is None else [mark])], left, _WIDTH - right, is_log=is_log)
    parts = [_grid(x, None, x_name, "", height - bottom, top)]
    if mark is not None:
        parts.append(
            f'<line class="axis" x1="{x.at(mark):.1f}" x2="{x.at(mark):.1f}" y1="{top}" y2="{height - bottom}"/>'
        )
    for n, row in enumerate(rows):
        parts.append(_row(row, x, top + row_height * (n + 0.5), row_height))
    return _svg(parts, height, label)


def _row(row: Row, x: Axis, middle: float, height: float) -> str:
    name = (
        f'<text class="row-name" x="{x.begin - 8:.1f}" y="{middle + 4:.1f}" text-anchor="end">{escape(row.name)}</text>'
    )
    values = row.values[np.isfinite(row.values)]
    if not len(values):
        return name + f'<text class="tick" x="{x.begin + 4:.1f}" y="{middle + 4:.1f}">none</text>'
    low, median, high = np.percentile(values, [25, 50, 75])
    shape = _dots(values, x, middle, height) if len(values) <= _MOST_DOTS else _density(values, x, middle, height)
    box = (
        f'<rect class="box" x="{x.at(low):.1f}" width="{max(0.5, x.at(high) - x.at(low)):.1f}" '
        f'y="{middle - height * 0.22:.1f}" height="{height * 0.44:.1f}"/>'
        f'<line class="median" x1="{x.at(median):.1f}" x2="{x.at(median):.1f}" '
        f'y1="{middle - height * 0.3:.1f}" y2="{middle + height * 0.3:.1f}"/>'
    )
    if row.interval is not None:
        (a, b), y = (x.at(v) for v in row.interval), middle + height * 0.36
        box += f'<line class="interval" x1="{a:.1f}" x2="{b:.1f}" y1="{y:.1f}" y2="{y:.1f}"/>'
    return f'{name}<g class="row {row.css_class}">{shape}{box}</g>'


def _dots(values: np.ndarray, x: Axis, middle: float, height: float) -> str:
    """Places dots beside each other where they would overlap."""
    ordered = np.sort(values)
    offsets = (np.arange(len(ordered)) * 7 % 5 - 2) * height * 0.075
    return "".join(
        f'<circle cx="{x.at(v):.1f}" cy="{middle + o:.1f}" r="2"/>' for v, o in zip(ordered, offsets, strict=True)
    )


def _density(values: np.ndarray, x: Axis, middle: float, height: float) -> str:
    """A violin: a histogram of narrow bins, smoothed."""
    places = np.array([x.at(v) for v in np.clip(values, x.low, x.high)])
    counts, edges = np.histogram(places, bins=96, range=(x.begin, x.end))
    kernel = np.exp(-0.5 * (np.arange(-6, 7) / 2.2) ** 2)
    smooth = np.convolve(counts, kernel / kernel.sum(), mode="same")
    widths = smooth / smooth.max() * height * 0.44
    centres = (edges[:-1] + edges[1:]) / 2
    shown = widths > 0.15
    upper = [f"{c:.1f},{middle - w:.1f}" for c, w in zip(centres[shown], widths[shown], strict=True)]
    lower = [f"{c:.1f},{middle + w:.1f}" for c, w in zip(centres[shown], widths[shown], strict=True)]
    return f'<polygon class="density" points="{" ".join(upper + lower[::-1])}"/>'


def _points(line: list[tuple[float, float]], x: Axis, y: Axis) -> str:
    return " ".join(f"{x.at(a):.1f},{y.at(b):.1f}" for a, b in line)


def _apart(ends: list[list]) -> list[list]:
    """Names one below the other where curves end close together."""
    ends.sort(key=lambda e: e[1])
    for above, below in zip(ends, ends[1:], strict=False):
        below[1] = max(below[1], above[1] + 14)
    return ends


def _grid(x: Axis, y: Axis | None, x_name: str, y_name: str, bottom: float, top: float = 12) -> str:
    out = []
    for tick in x.ticks():
        at = x.at(tick)
        out.append(f'<line class="grid" x1="{at:.1f}" x2="{at:.1f}" y1="{top}" y2="{bottom}"/>')
        out.append(f'<text class="tick" x="{at:.1f}" y="{bottom + 15}" text-anchor="middle">{tick_text(tick)}</text>')
    for tick, at in [(t, y.at(t)) for t in y.ticks()] if y else []:
        out.append(f'<line class="grid" x1="{x.begin}" x2="{x.end}" y1="{at:.1f}" y2="{at:.1f}"/>')
        out.append(f'<text class="tick" x="{x.begin - 6}" y="{at + 4:.1f}" text-anchor="end">{tick_text(tick)}</text>')
    out.append(f'<line class="axis" x1="{x.begin}" x2="{x.end}" y1="{bottom}" y2="{bottom}"/>')
    out.append(f'<text class="axis-name" x="{x.end}" y="{bottom + 32}" text-anchor="end">{escape(x_name)}</text>')
    if y_name:
        out.append(f'<text class="axis-name" x="{x.begin + 5}" y="{top + 10}">{escape(y_name)}</text>')
    return "".join(out)


def _svg(parts: list[str], height: float, label: str) -> Markup:
    return Markup(
        f'<svg viewBox="0 0 {_WIDTH} {height:g}" role="img" aria-label="{escape(label)}">{"".join(parts)}</svg>'
    )
