"""The remaining work: clips with the settings whose tasks have neither been done nor failed."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from fbs.corpus.clip import Clip
from fbs.corpus.order import Order
from fbs.corpus.results_folder import Keys
from fbs.corpus.setting import FbsSetting, Setting


@dataclass(frozen=True)
class ClipPlan:
    """One clip."""

    clip: Clip
    reference: FbsSetting
    """Whose stream says where the face is."""
    settings: tuple[Setting, ...]
    """To be done."""


def plans_of(
    clips: Iterable[Clip], settings: list[Setting], order: Order, done: Keys, failed: Keys
) -> Iterator[ClipPlan]:
    """Clips with something left to do.

    Parameters
    ----------
    settings : list
        Those of all clips; the first is that of the reference.
    failed : Keys
        Tasks that are not tried again.
    """
    reference = settings[0]
    assert isinstance(reference, FbsSetting)
    for clip in clips:
        keys = [order.task_key(clip, setting) for setting in settings]
        left = tuple(s for s, key in zip(settings, keys, strict=True) if key not in done and key not in failed)
        if left:
            yield ClipPlan(clip, reference, left)
