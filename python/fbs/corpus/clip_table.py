"""The tables of clips and of streams, with what follows from the curves of all codecs."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pandas as pd

from fbs.corpus.bd_rate import Curve, bd_rate, envelope, quality_at
from fbs.corpus.results_folder import ResultsFolder
from fbs.corpus.setting import PEERS, Setting

AREAS = ("face", "frame")
ENVELOPE = "envelope"
"""The best of all peers at each rate."""

_COLUMNS = """clip clip_key task_key codec quality width height fps pictures seconds bytes bytes_startup bytes_patterns
bytes_motion bytes_geometry kbps psnr_face psnr_frame face_pictures face_share worst_picture worst_psnr cuts patterns
yaw_range_deg pitch_range_deg motion encode_s decode_s""".split()
_OF_BEST_STREAM = """clip clip_key width height fps pictures seconds face_pictures face_share cuts yaw_range_deg
pitch_range_deg motion""".split()
_OF_SHOWN_STREAM = """quality kbps psnr_face psnr_frame bytes bytes_patterns bytes_motion patterns worst_picture
worst_psnr gain_face gain_frame""".split()
_WHOLE_NUMBERS = ["quality", "cuts", "patterns", "worst_picture"]


def current(tasks: pd.DataFrame, settings: list[Setting]) -> pd.DataFrame:
    """The last task of each clip and setting: a clip that has changed, or a newer program, replaces older ones.

    Parameters
    ----------
    settings : list
        Others, of earlier runs, are left out: not every clip need have them.
    """
    asked = tasks[tasks["setting"].isin([s.name for s in settings])]
    in_order = asked.sort_values("finished", kind="stable")
    return in_order.drop_duplicates(["clip", "setting"], keep="last", ignore_index=True)


def read_points(folder: ResultsFolder, tasks: pd.DataFrame) -> pd.DataFrame:
    """Points of current tasks, with the columns that a report needs."""
    points = folder.points(_COLUMNS).to_pandas()
    points = points[points["task_key"].isin(tasks["task_key"])]
    return points.astype({name: "Int32" for name in _WHOLE_NUMBERS})  # NumPy's integers have no null


def clip_curves(points: pd.DataFrame, area: str) -> Iterator[tuple[str, dict[str, Curve]]]:
    """For each clip, in order of name, the envelope of luma PSNR over rate of each codec that it has."""
    ordered = points.sort_values(["clip", "codec"], kind="stable")
    clip, codec = ordered["clip"].to_numpy(), ordered["codec"].to_numpy()
    pairs = list(zip(ordered["kbps"].tolist(), ordered[f"psnr_{area}"].tolist(), strict=True))
    is_new = np.append(True, (clip[1:] != clip[:-1]) | (codec[1:] != codec[:-1])) if len(pairs) else np.array([], bool)
    edges = np.append(np.flatnonzero(is_new), len(pairs))
    curves: dict[str, Curve] = {}
    for begin, end in zip(edges, edges[1:], strict=False):
        curves[codec[begin]] = envelope(pairs[begin:end])
        if end == len(pairs) or clip[end] != clip[begin]:
            yield clip[begin], curves
            curves = {}


def best_of_peers(curves: dict[str, Curve]) -> Curve:
    return envelope(point for codec, curve in curves.items() if codec != "fbs" for point in curve)


def bd_column(peer: str, area: str) -> str:
    return f"bd_rate_{area}_{peer}"


def rival_column(peer: str, area: str) -> str:
    return f"rival_{area}_{peer}"


def table_of_streams(points: pd.DataFrame) -> pd.DataFrame:
    """Points of fbs in order of clip and quality, with what is measured in another unit, or against other codecs.

    Columns that are added: ``rival_face_x264`` and so on, luma PSNR of another codec at the rate of the stream, NaN
    where it does not go so low; ``gain_face`` and ``gain_frame``, dB over the best of them; ``encode_speed`` and
    ``decode_speed``, pictures per second.
    """
    streams = points[points["codec"] == "fbs"].sort_values(["clip", "quality"], ignore_index=True)
    streams["encode_speed"] = streams["pictures"] / streams["encode_s"]
    streams["decode_speed"] = streams["pictures"] / streams["decode_s"]
    for area in AREAS:
        curves = {clip: codecs | {ENVELOPE: best_of_peers(codecs)} for clip, codecs in clip_curves(points, area)}
        for peer in (*PEERS, ENVELOPE):
            theirs = [
                quality_at(curves[c].get(peer, []), r) for c, r in zip(streams["clip"], streams["kbps"], strict=True)
            ]
            streams[rival_column(peer, area)] = np.array(theirs, dtype=float)
        streams[f"gain_{area}"] = streams[f"psnr_{area}"] - streams[rival_column(ENVELOPE, area)]
    return streams


def table_of_clips(points: pd.DataFrame, streams: pd.DataFrame) -> pd.DataFrame:
    """A row for each clip that has a stream of fbs.

    Columns are those of the clip, the values of its shown stream, that of the middle quality, and BD-rates in percent,
    ``bd_rate_face_x265`` and so on, NaN where there is none.
    """
    groups = streams.groupby("clip", sort=True)
    first, count = groups.ngroup().drop_duplicates().index.to_numpy(), groups.size().to_numpy()
    best = streams.iloc[first + count - 1][_OF_BEST_STREAM].reset_index(drop=True)
    shown = streams.iloc[first + (count - 1) // 2][_OF_SHOWN_STREAM].reset_index(drop=True)
    clips = pd.concat([best, shown], axis=1)
    for area in AREAS:
        found = {clip: _differences(curves) for clip, curves in clip_curves(points, area)}
        for n, peer in enumerate((*PEERS, ENVELOPE)):
            clips[bd_column(peer, area)] = [found[clip][n] for clip in clips["clip"]]
    return clips


def _differences(curves: dict[str, Curve]) -> list[float]:
    """BD-rates against each peer, and against the best of them."""
    anchors = [curves.get(peer, []) for peer in PEERS]
    there = [anchor for anchor in anchors if anchor]
    anchors.append(there[0] if len(there) == 1 else best_of_peers(curves))
    found = (bd_rate(anchor, curves.get("fbs", [])) for anchor in anchors)
    return [np.nan if difference is None else difference for difference in found]
