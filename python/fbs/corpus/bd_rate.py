"""Rate-distortion curves: envelope, quality at a rate, and the measure of Bjøntegaard, as in ``fbs evaluate``."""

from __future__ import annotations

import bisect
import math
from collections.abc import Iterable

import numpy as np

MIN_POINTS = 4
"""Of a curve that BD-rate is taken of."""

Curve = list[tuple[float, float]]
"""Rate in kbit/s and quality in dB; both rise strictly."""


def envelope(points: Iterable[tuple[float, float]]) -> Curve:
    """The points that no other beats at the same or a lower rate; those without a number are left out."""
    out: Curve = []
    valid = (p for p in points if p[0] > 0 and math.isfinite(p[0]) and math.isfinite(p[1]))
    for kbps, quality in sorted(valid, key=lambda p: (p[0], -p[1])):
        if not out or quality > out[-1][1]:
            out.append((kbps, quality))
    return out


def quality_at(curve: Curve, kbps: float) -> float | None:
    """Quality at a rate, linear over its logarithm between two points; None outside the curve's rates."""
    if not curve or not curve[0][0] <= kbps <= curve[-1][0]:
        return None
    after = min(bisect.bisect_right(curve, (kbps, math.inf)), len(curve) - 1)
    if after == 0:
        return curve[0][1]
    (low, worse), (high, better) = curve[after - 1], curve[after]
    return worse + math.log(kbps / low) / math.log(high / low) * (better - worse)


def bd_rate(anchor: Curve, test: Curve) -> float | None:
    """How much more rate `test` takes for the same quality, percent; below 0 it takes less.

    Bjøntegaard, *Calculation of Average PSNR Differences between RD-curves*, VCEG-M33, 2001: the mean distance of
    the logarithms of rate over the common range of quality, interpolated by PCHIP as in the common test conditions
    of HEVC and VVC.

    Returns
    -------
    float or None
        None for curves of fewer than four points or without a common range.
    """
    if len(anchor) < MIN_POINTS or len(test) < MIN_POINTS:
        return None
    low = max(anchor[0][1], test[0][1])
    high = min(anchor[-1][1], test[-1][1])
    if high <= low:
        return None
    mean = (_integral(test, low, high) - _integral(anchor, low, high)) / (high - low)
    return float(100 * np.expm1(mean))


def _integral(curve: Curve, low: float, high: float) -> float:
    """Of log rate over quality. Simpson's rule has no error on a cubic."""
    y, x = np.log([p[0] for p in curve]), np.array([p[1] for p in curve])
    slopes = _pchip_slopes(x, y)
    limits = np.concatenate([[low], x[(x > low) & (x < high)], [high]])
    a, b = limits[:-1], limits[1:]
    values = [_hermite(x, y, slopes, at) for at in (a, (a + b) / 2, b)]
    return float(np.sum((b - a) / 6 * (values[0] + 4 * values[1] + values[2])))


def _pchip_slopes(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Fritsch and Butland 1984; at the ends the parabola through three points, kept monotone."""
    h = np.diff(x)
    d = np.diff(y) / h
    out = np.zeros_like(y)
    w1, w2 = 2 * h[1:] + h[:-1], h[1:] + 2 * h[:-1]
    rising = d[:-1] * d[1:] > 0
    with np.errstate(divide="ignore", invalid="ignore"):
        out[1:-1] = np.where(rising, (w1 + w2) / (w1 / d[:-1] + w2 / d[1:]), 0)
    out[0] = _end_slope(h[0], h[1], d[0], d[1])
    out[-1] = _end_slope(h[-1], h[-2], d[-1], d[-2])
    return out


def _end_slope(h0: float, h1: float, d0: float, d1: float) -> float:
    slope = ((2 * h0 + h1) * d0 - h0 * d1) / (h0 + h1)
    if slope * d0 <= 0:
        return 0.0
    if d0 * d1 <= 0 and abs(slope) > 3 * abs(d0):
        return 3 * d0
    return slope


def _hermite(x: np.ndarray, y: np.ndarray, slopes: np.ndarray, at: np.ndarray) -> np.ndarray:
    i = np.clip(np.searchsorted(x, at, side="right") - 1, 0, len(x) - 2)
    h = x[i + 1] - x[i]
    t = (at - x[i]) / h
    return (
        (1 + 2 * t) * (1 - t) ** 2 * y[i]
        + t * (1 - t) ** 2 * h * slopes[i]
        + t**2 * (3 - 2 * t) * y[i + 1]
        + t**2 * (t - 1) * h * slopes[i + 1]
    )
