"""Axes of charts: from values to places, with ticks at round numbers."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass


@dataclass(frozen=True)
class Axis:
    """Maps values from `low` to `high` onto places from `begin` to `end`, SVG units."""

    low: float
    high: float
    begin: float
    end: float
    is_log: bool = False

    def at(self, value: float) -> float:
        low, high, v = (math.log(x) if self.is_log else x for x in (self.low, self.high, value))
        return self.begin + (v - low) / (high - low) * (self.end - self.begin)

    def ticks(self) -> list[float]:
        """Four to nine round numbers within the axis."""
        return _log_ticks(self.low, self.high) if self.is_log else _linear_ticks(self.low, self.high)


def axis_over(values: Iterable[float], begin: float, end: float, *, is_log: bool = False) -> Axis:
    """An axis with a little room beside the values; logarithmic ones need values above 0."""
    finite = [v for v in values if math.isfinite(v) and (v > 0 or not is_log)]
    low, high = (min(finite), max(finite)) if finite else (1, 2)
    if is_log:
        room = max((high / low) ** 0.04, 1.05)
        return Axis(low / room, high * room, begin, end, True)
    room = 0.04 * (high - low) or max(0.05 * abs(high), 1e-6)
    return Axis(low - room, high + room, begin, end)


def _linear_ticks(low: float, high: float) -> list[float]:
    rough = (high - low) / 5
    power = 10 ** math.floor(math.log10(rough))
    step = next(s * power for s in (1, 2, 2.5, 5, 10) if s * power >= rough)
    first = math.ceil(low / step - 1e-9)
    last = math.floor(high / step + 1e-9)
    return [n * step for n in range(first, last + 1)]


def _log_ticks(low: float, high: float) -> list[float]:
    decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    for steps in ((1,), (1, 3), (1, 2, 5), (1, 1.5, 2, 3, 5, 7)):
        ticks = [s * 10.0**d for d in decades for s in steps]
        inside = [t for t in ticks if low <= t <= high]
        if len(inside) >= 4:
            return inside
    return _linear_ticks(low, high)


def tick_text(value: float) -> str:
    """ "20", "0.5", "1500": without trailing zeros."""
    text = f"{value:.6g}"
    if "e" in text:
        text = f"{value:.0f}"
    return text.replace("-", "\N{MINUS SIGN}")
