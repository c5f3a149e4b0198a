"""Charts as SVG, drawn by Matplotlib: curves over rate, and rows that show how values are distributed."""

from __future__ import annotations

import io
import math
import re
from dataclasses import dataclass, field

import numpy as np
from markupsafe import Markup, escape
from matplotlib import rc_context, ticker
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.mlab import GaussianKDE

_WIDTH = 480
_MOST_DOTS = 150
"""Values that are drawn one by one; more are drawn as a density."""

_COLOURS = {name: f"#0f0f{n:02d}" for n, name in enumerate("text quiet grid fbs x264 x265 av1 envelope".split())}
"""What Matplotlib draws in the place of the page's colours, which differ by day, by night and on paper."""

_STYLE = {
    "svg.fonttype": "none",
    "font.size": 12,
    "axes.spines.left": False,
    "axes.spines.right": False,
    "axes.spines.top": False,
    "axes.edgecolor": _COLOURS["quiet"],
    "axes.labelcolor": _COLOURS["quiet"],
    "axes.labelpad": 3,
    "axes.axisbelow": True,
    "axes.grid": True,
    "axes.grid.axis": "x",
    "grid.color": _COLOURS["grid"],
    "xtick.labelcolor": _COLOURS["quiet"],
    "ytick.labelcolor": _COLOURS["quiet"],
    "xtick.major.size": 0,
    "ytick.major.size": 0,
    "text.color": _COLOURS["quiet"],
    "figure.facecolor": "none",
    "axes.facecolor": "none",
}

_LEFT_OUT = re.compile(
    r"(?<=<svg)[^>]*(?= viewBox)|<metadata>.*?</metadata>|<style.*?</style>| xmlns(:\w+)?=\"[^\"]*\""
    r"| clip-path=\"[^\"]*\"| id=\"\w+_\d+\"|font(-size|-family)?: [^;\"]*;? ?",
    re.DOTALL,
)
"""What the page has a say in, or would be there twice."""


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
    with rc_context(_STYLE | {"axes.grid.axis": "both", "svg.hashsalt": label}):
        axes = _axes(320, left=42, right=72, top=12, bottom=40)
        for s in series:
            colour = _COLOURS[s.css_class]
            if s.low:
                axes.fill_between(s.x, s.low, s.high, color=colour, alpha=0.15, linewidth=0)
            width = 2.5 if s.css_class == "fbs" else 1.75
            axes.plot(s.x, s.y, color=colour, linewidth=width, marker="o" if s.has_points else None, markersize=7)
        _scale(axes, x_name, is_log=True)
        axes.text(0.01, 0.99, y_name, transform=axes.transAxes, va="top")
        lowest = math.inf
        for s in sorted((s for s in series if s.x), key=lambda s: -s.y[-1]):
            x, y = axes.transData.transform((s.x[-1], s.y[-1]))
            lowest = min(y, lowest - 14)  # names one below the other where curves end close together
            axes.text(x + 7, lowest, s.name, transform=None, va="center", color=_COLOURS[s.css_class], weight="bold")
        return _svg(axes, label)


def row_chart(rows: list[Row], x_name: str, label: str, *, is_log: bool = False, mark: float | None = None) -> Markup:
    """One row for each kind of values.

    Parameters
    ----------
    mark : float, optional
        A value to draw a line at, such as 0.
    """
    with rc_context(_STYLE | {"ytick.labelcolor": _COLOURS["text"], "svg.hashsalt": label}):
        axes = _axes(46 * len(rows) + 46, left=84, right=14, top=8, bottom=38)
        axes.set_ylim(len(rows) - 0.5, -0.5)
        axes.set_yticks(range(len(rows)), [row.name for row in rows])
        if mark is not None:
            axes.axvline(mark, color=_COLOURS["quiet"], linewidth=1)
        for y, row in enumerate(rows):
            _draw_row(axes, y, row, is_log)
        _scale(axes, x_name, is_log)
        return _svg(axes, label)


def _draw_row(axes: Axes, y: float, row: Row, is_log: bool) -> None:
    colour = _COLOURS[row.css_class]
    values = np.sort(row.values[np.isfinite(row.values)])
    if not len(values):
        axes.text(0.01, y, "none", transform=axes.get_yaxis_transform(), va="center")
        return
    if len(values) <= _MOST_DOTS:
        beside = (np.arange(len(values)) * 7 % 5 - 2) * 0.075  # where they would cover each other
        axes.scatter(values, y + beside, s=16, color=colour, alpha=0.6, linewidth=0)
    elif values[0] < values[-1]:
        places = np.log(values) if is_log else values
        at = np.linspace(places[0], places[-1], 96)
        density = GaussianKDE(places)(at)
        half = 0.44 * density / density.max()
        axes.fill_between(np.exp(at) if is_log else at, y - half, y + half, color=colour, alpha=0.35, linewidth=0)
    low, median, high = np.percentile(values, [25, 50, 75])
    axes.barh(y, high - low, left=low, height=0.44, fill=False, edgecolor=colour, linewidth=1.25)
    axes.vlines(median, y - 0.3, y + 0.3, color=colour, linewidth=3)
    if row.interval is not None:
        axes.hlines(y + 0.36, *row.interval, color=colour, linewidth=3, alpha=0.7)


def _axes(height: int, left: int, right: int, top: int, bottom: int) -> Axes:
    """Margins are in SVG units, of which a figure has 72 to the inch."""
    figure = Figure(figsize=(_WIDTH / 72, height / 72), dpi=72)
    inner = (left / _WIDTH, bottom / height, (_WIDTH - left - right) / _WIDTH, (height - top - bottom) / height)
    return figure.add_axes(inner)


def _scale(axes: Axes, x_name: str, is_log: bool) -> None:
    axes.set_xlabel(x_name, loc="right")
    if not is_log:
        axes.xaxis.set_major_locator(ticker.MaxNLocator(6))
        return
    axes.set_xscale("log")
    low, high = axes.get_xlim()
    decades = math.log10(high / low)
    steps = (1,) if decades > 4 else (1, 3) if decades > 2 else (1, 2, 5)
    axes.xaxis.set_major_locator(ticker.LogLocator(subs=steps) if decades > 0.7 else ticker.MaxNLocator(6))
    axes.xaxis.set_major_formatter(ticker.StrMethodFormatter("{x:g}"))
    axes.xaxis.set_minor_locator(ticker.NullLocator())


def _svg(axes: Axes, label: str) -> Markup:
    """The drawing in the colours and letters of the page."""
    out = io.StringIO()
    axes.figure.savefig(out, format="svg")
    svg = _LEFT_OUT.sub("", out.getvalue()[out.getvalue().index("<svg") :])
    for name, colour in _COLOURS.items():
        svg = svg.replace(colour, f"var(--{name})")
    return Markup(svg.replace("<svg", f'<svg role="img" aria-label="{escape(label)}"', 1))
