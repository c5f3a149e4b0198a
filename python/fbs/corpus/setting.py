"""Settings: what a clip is encoded with. One clip and one setting make a task."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

PEERS = ("x264", "x265", "av1")
SIZES = (1, 2, 4)
RATES = (1, 2, 3)


@dataclass(frozen=True)
class FbsSetting:
    """A stream of fbs: one point of the rate-distortion curve."""

    quality: int

    @property
    def name(self) -> str:
        return f"fbs-quality-{self.quality}"


@dataclass(frozen=True)
class PeerSetting:
    """Another codec at one size and picture rate: points of rising rate, until fbs's best stream is covered."""

    codec: str
    size: int
    """Divisor of width and height."""
    rate: int
    """Every how many pictures one is coded."""

    @property
    def name(self) -> str:
        return f"{self.codec}-size-{self.size}-rate-{self.rate}"


Setting = FbsSetting | PeerSetting


def asked_settings(asked: dict[str, Any]) -> list[Setting]:
    """The settings recorded in run.json."""
    return settings_of(*(asked[name] for name in ("qualities", "peers", "peer_sizes", "peer_rates")))


def settings_of(qualities: list[int], peers: list[str], sizes: list[int], rates: list[int]) -> list[Setting]:
    """All settings of a clip, the highest quality first: its stream says where the face is."""
    streams = [FbsSetting(q) for q in sorted(set(qualities), reverse=True)]
    return streams + [PeerSetting(p, s, r) for p in peers for s in sizes for r in rates]
