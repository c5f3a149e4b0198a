"""The table of clips: one row for each, with BD-rates against other codecs."""

from __future__ import annotations

import numpy as np
import pandas as pd

from fbs.corpus.bd_rate import bd_rate, envelope, quality_at
from fbs.corpus.results_folder import ResultsFolder
from fbs.corpus.setting import PEERS

AREAS = ("face", "frame")
ENVELOPE = "envelope"
"""The best of all peers at each rate."""

_COLUMNS = [
    "clip", "clip_key", "task_key", "setting", "codec", "quality", "width", "height", "fps", "pictures",
    "seconds", "bytes", "bytes_startup", "bytes_patterns", "bytes_motion", "bytes_geometry", "kbps", "psnr_face", "psnr_frame",
    "face_pictures", "face_share", "worst_picture", "worst_psnr", "cuts", "patterns", "yaw_range_deg",
    "pitch_range_deg", "motion", "encode_s", "decode_s", "peer_size", "peer_rate", "crf",
]  # fmt: skip

_OF_CLIP = ["width", "height", "fps", "pictures", "seconds", "face_pictures", "face_share", "cuts",
            "yaw_range_deg", "pitch_range_deg", "motion"]  # fmt: skip


_WHOLE_NUMBERS = ["quality", "cuts", "patterns", "worst_picture", "peer_size", "peer_rate", "crf"]


def current(tasks: pd.DataFrame) -> pd.DataFrame:
    """The last task of each clip and setting: a clip that has changed, or a newer program, replaces older ones."""
    in_order = tasks.sort_values("finished", kind="stable")
    return in_order.drop_duplicates(["clip", "setting"], keep="last", ignore_index=True)


def read_points(folder: ResultsFolder, tasks: pd.DataFrame) -> pd.DataFrame:
    """Points of current tasks, with the columns that a report needs."""
    points = folder.points(_COLUMNS).to_pandas()
    points = points.astype({name: "Int32" for name in _WHOLE_NUMBERS})  # NumPy's integers have no null
    return points[points["task_key"].isin(tasks["task_key"])].reset_index(drop=True)


def bd_column(peer: str, area: str) -> str:
    return f"bd_rate_{area}_{peer}"


def table_of_clips(points: pd.DataFrame) -> pd.DataFrame:
    """A row for each clip that has a point of fbs.

    Columns are those of the clip, the values of its shown point, that of the middle quality, with BD-rates in
    percent, ``bd_rate_face_x265`` and so on, and ``gain_face``, dB, over the peers' envelope at its rate; NaN where
    there is none.
    """
    rows = []
    for clip, own in points.groupby("clip", sort=True):
        streams = own[own["codec"] == "fbs"].sort_values("quality")
        if streams.empty:
            continue
        shown = streams.iloc[(len(streams) - 1) // 2]
        row = {"clip": clip, "clip_key": shown["clip_key"]}
        row |= {name: streams.iloc[-1][name] for name in _OF_CLIP}
        row |= {name: shown[name] for name in ("quality", "kbps", "psnr_face", "psnr_frame", "bytes", "bytes_patterns",
                                               "bytes_motion", "patterns", "worst_picture", "worst_psnr")}  # fmt: skip
        rows.append(row | _gains(shown, own) | _differences(streams, own))
    return pd.DataFrame(rows, columns=[*rows[0]] if rows else ["clip"])


def gain(stream: pd.Series, peers: pd.DataFrame, area: str) -> float:
    """How much better a stream of fbs is than the envelope of peers at its rate, dB; NaN where none goes so low."""
    theirs = quality_at(curve_of(peers, area), stream["kbps"])
    return np.nan if theirs is None else stream[f"psnr_{area}"] - theirs


def _gains(shown: pd.Series, own: pd.DataFrame) -> dict[str, float]:
    peers = own[own["codec"] != "fbs"]
    return {f"gain_{area}": gain(shown, peers, area) for area in AREAS}


def _differences(streams: pd.DataFrame, own: pd.DataFrame) -> dict[str, float]:
    out: dict[str, float] = {}
    for area in AREAS:
        test = curve_of(streams, area)
        for peer in (*PEERS, ENVELOPE):
            anchor = curve_of(own[own["codec"] != "fbs"] if peer == ENVELOPE else own[own["codec"] == peer], area)
            difference = bd_rate(anchor, test)
            out[bd_column(peer, area)] = np.nan if difference is None else difference
    return out


def curve_of(points: pd.DataFrame, area: str) -> list[tuple[float, float]]:
    """Envelope of luma PSNR over rate."""
    return envelope(zip(points["kbps"].to_numpy(), points[f"psnr_{area}"].to_numpy(), strict=True))
