"""Rate-distortion curves: envelope, quality at a rate, and the measure of Bjøntegaard, as in ``fbs evaluate``."""

from __future__ import annotations

import bisect
import math
from collections.abc import Iterable

import bjontegaard

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

    Bjøntegaard, *Calculation of Average PSNR Differences between RD-curves*, VCEG-M33, 2001, interpolated by PCHIP as
    in the common test conditions of HEVC and VVC.

    Returns
    -------
    float or None
        None for curves of fewer than four points or without a common range.
    """
    if len(anchor) < MIN_POINTS or len(test) < MIN_POINTS:
        return None
    if min(anchor[-1][1], test[-1][1]) <= max(anchor[0][1], test[0][1]):
        return None
    curves = (*zip(*anchor, strict=True), *zip(*test, strict=True))
    return float(bjontegaard.bd_rate(*curves, method="pchip", require_matching_points=False, min_overlap=0))
