"""Stills of the worst clips: encoded once more, and kept in the folder of results."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from fbs.corpus import work
from fbs.corpus.attempt import Attempt
from fbs.corpus.child import Calls
from fbs.corpus.clip import Clip
from fbs.corpus.order import Order
from fbs.corpus.results_folder import write_atomically
from fbs.corpus.setting import FbsSetting

KINDS = ("source", "fbs", "difference")

Submit = Callable[..., Any]
"""Of a client of Dask, or of any executor: gives a future."""


@dataclass(frozen=True)
class Stills:
    """The worst picture of a clip as JPEG."""

    images: dict[str, bytes]
    """By kind; empty where they could not be made."""
    error: str | None = None


def render(clip: Clip, reference: FbsSetting, setting: FbsSetting, order: Order) -> Stills:
    """Encode a clip, and take its worst picture. Runs on a worker."""

    def take(calls: Calls, scratch: Path) -> dict[str, bytes]:
        region, stream = scratch / "reference.fbs", scratch / "stream.fbs"
        calls.encode(clip.path, region, reference.quality)
        calls.encode(clip.path, stream, setting.quality)
        work.make_stills(calls, clip, stream, region, scratch / "stills")
        return {kind: (scratch / f"stills/worst-{kind}.jpg").read_bytes() for kind in KINDS}

    images, error = Attempt("stills", order, None).run(take)
    return Stills(images or {}, error)


def stills_of(
    folder: Path,
    wanted: list[tuple[str, Clip, FbsSetting, FbsSetting]],
    order: Order | None,
    submit: Submit | None,
) -> list[Stills]:
    """Those of several clips at the same time, from `folder` where they have been made before.

    Parameters
    ----------
    wanted : list
        Of key, clip, setting of the reference, setting to show.
    order, submit
        None: no more are made.
    """
    futures = {
        key: submit(render, clip, reference, setting, order)
        for key, clip, reference, setting in wanted
        if submit is not None and not _are_there(folder / key)
    }
    return [_kept(folder / key, futures.get(key)) for key, *_ in wanted]


def _kept(folder: Path, made: Any) -> Stills:
    """Stills as they are in their folder, where those that have just been made are put first."""
    if made is None and not _are_there(folder):
        return Stills({}, "there is no program to make them")
    if made is None:
        return Stills({kind: (folder / f"{kind}.jpg").read_bytes() for kind in KINDS})
    stills: Stills = made.result()
    for kind, image in stills.images.items():
        write_atomically(folder / f"{kind}.jpg", image)
    return stills


def _are_there(folder: Path) -> bool:
    return all((folder / f"{kind}.jpg").exists() for kind in KINDS)
