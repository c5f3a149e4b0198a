"""The worst clips, and how they differ from the others."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pandas as pd

from fbs.corpus.clip_table import ENVELOPE, bd_column

_STANDS_OUT = 1.0
"""Distance from the median, in deviations of a normal distribution with the same quartiles."""
_GOES_ALONG = 0.5
"""Rank correlation of a trait with badness from which on it is named."""
_FIRST = 100.0
"""Added to the distance of such a trait, so that it is told first."""
_LEAST_CLIPS = 4
_LEAST_CLIPS_FOR_RANKS = 20
_MOST_REASONS = 3
_DEVIATIONS_PER_RANGE = 1.349  # of a normal distribution, between its quartiles


@dataclass(frozen=True)
class Trait:
    """Something measured that makes a clip hard."""

    values: Callable[[pd.DataFrame], pd.Series]
    is_hard_when_high: bool
    least: float
    """A deviation that is not worth a word, in the unit of the values."""
    text: str
    """With the clip's value and the median."""


TRAITS = (
    Trait(lambda c: 100 * c["face_pictures"] / c["pictures"], False, 2,
          "a face is believed in {value:.0f} % of its pictures (median {median:.0f} %)"),
    Trait(lambda c: c["yaw_range_deg"], True, 3, "the head turns over {value:.0f}° (median {median:.0f}°)"),
    Trait(lambda c: c["pitch_range_deg"], True, 3, "the head nods over {value:.0f}° (median {median:.0f}°)"),
    Trait(lambda c: c["motion"], True, 0.05,
          "the head moves {value:.2f} eye distances a second (median {median:.2f})"),
    Trait(lambda c: c["motion"], False, 0.02,
          "the head hardly moves, {value:.2f} eye distances a second (median {median:.2f}), which suits other codecs"),
    Trait(lambda c: c["cuts"], True, 0.5, "it has {value:.0f} cuts or new scenes (median {median:.0f})"),
    Trait(lambda c: 100 * c["face_share"], False, 1,
          "the face is {value:.1f} % of the picture (median {median:.1f} %)"),
    Trait(lambda c: c["fps"], False, 5, "{value:.0f} pictures a second are large steps (median {median:.0f})"),
    Trait(lambda c: c["seconds"], False, 0.5,
          "in {value:.1f} s the first picture weighs much (median {median:.1f} s)"),
    Trait(lambda c: c["psnr_face"] - c["worst_psnr"], True, 0.5,
          "its worst picture is {value:.1f} dB below the whole clip (median {median:.1f} dB): one passage fails"),
    Trait(lambda c: c["psnr_face"] - c["gain_face"], True, 0.5,
          "it is easy for other codecs: their best reaches {value:.1f} dB at this rate (median {median:.1f} dB)"),
)  # fmt: skip


def ranking(clips: pd.DataFrame) -> tuple[pd.Series, str]:
    """How bad each clip is, more is worse, and what that is.

    BD-rate of the face against the best of the others where most clips have one, else luma PSNR of the face.
    """
    by_rate = clips[bd_column(ENVELOPE, "face")]
    if len(clips) and by_rate.notna().mean() > 0.5:
        return by_rate, "BD-rate of the face against the best of the other codecs"
    quality = clips["psnr_face"].fillna(clips["psnr_frame"])
    return -quality, "luma PSNR of the face (of the frame, without one) at the middle quality"


def worst_clips(clips: pd.DataFrame, count: int) -> pd.DataFrame:
    """The worst first, with `reasons`, a list of texts for each."""
    badness, _ = ranking(clips)
    worst = clips.loc[badness.dropna().sort_values(ascending=False, kind="stable").index[:count]].copy()
    worst["reasons"] = reasons(clips, worst.index, badness)
    return worst


def reasons(clips: pd.DataFrame, chosen: pd.Index, badness: pd.Series) -> list[list[str]]:
    """What may make each chosen clip hard, the most telling first.

    A trait is named where the clip stands out among all, or is in the hard quarter of a trait that goes with badness
    over all clips.
    """
    found: dict[object, list[tuple[float, str]]] = {index: [] for index in chosen}
    for trait in TRAITS:
        sign = 1 if trait.is_hard_when_high else -1
        hard = sign * trait.values(clips).astype(float)
        if hard.notna().sum() < _LEAST_CLIPS:
            continue
        low, median, high = np.nanpercentile(hard, [25, 50, 75])
        deviation = max((high - low) / _DEVIATIONS_PER_RANGE, trait.least)
        goes_along = hard.rank().corr(badness.rank()) > _GOES_ALONG and len(clips) >= _LEAST_CLIPS_FOR_RANKS
        for index in chosen:
            distance = (hard[index] - median) / deviation
            in_hard_quarter = hard[index] >= high and hard[index] - median >= trait.least
            if distance > _STANDS_OUT or (goes_along and in_hard_quarter):
                told = distance + (_FIRST if goes_along else 0)
                found[index].append((told, trait.text.format(value=sign * hard[index], median=sign * median)))
    return [[text for _, text in sorted(found[index], reverse=True)[:_MOST_REASONS]] for index in chosen]
