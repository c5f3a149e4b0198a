"""Statistics over clips."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

_RESAMPLES = 2000
_SEED = 1
_ENOUGH_TO_RESAMPLE = 5_000
"""Of more values the interval of the median is taken from order statistics: it would be the same."""


@dataclass(frozen=True)
class Spread:
    """Spread of one value over the clips that have it."""

    count: int
    median: float
    low: float
    """First quartile."""
    high: float
    """Third quartile."""
    worst: float
    """95th percentile, or 5th where more is better."""


def spread(values: np.ndarray, *, more_is_better: bool = True) -> Spread | None:
    """None without a value; NaN is none."""
    values = values[np.isfinite(values)]
    if not len(values):
        return None
    low, median, high = np.percentile(values, [25, 50, 75])
    worst = np.percentile(values, 5 if more_is_better else 95)
    return Spread(len(values), float(median), float(low), float(high), float(worst))


def median_interval(values: np.ndarray) -> tuple[float, float] | None:
    """95 % confidence interval of the median: percentiles of resampled medians (Efron 1979), with a fixed seed.

    Returns
    -------
    tuple or None
        None for fewer than five values, whose interval would say nothing.
    """
    values = np.sort(values[np.isfinite(values)])
    count = len(values)
    if count < 5:
        return None
    if count > _ENOUGH_TO_RESAMPLE:
        reach = 0.98 * np.sqrt(count)  # 1.96 deviations of a binomial of 1/2
        low, high = int(count / 2 - reach), int(np.ceil(count / 2 + reach))
        return float(values[low]), float(values[min(high, count - 1)])
    random = np.random.default_rng(_SEED)
    medians = [np.median(values[random.integers(0, count, count)]) for _ in range(_RESAMPLES)]
    low, high = np.percentile(medians, [2.5, 97.5])
    return float(low), float(high)
