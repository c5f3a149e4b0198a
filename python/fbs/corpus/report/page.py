"""Writes the report."""

from __future__ import annotations

import base64
from dataclasses import dataclass
from importlib import resources
from pathlib import Path

import jinja2
import pandas as pd
import pyarrow as pa
import pyarrow.parquet as parquet
from markupsafe import Markup

from fbs.corpus.clip import Clip
from fbs.corpus.clip_table import AREAS, read_points, table_of_clips, table_of_streams
from fbs.corpus.order import Order
from fbs.corpus.progress import duration
from fbs.corpus.report import charts, tables
from fbs.corpus.results_folder import ResultsFolder, write_atomically
from fbs.corpus.setting import FbsSetting
from fbs.corpus.stills import Stills, Submit, stills_of
from fbs.corpus.worst import ranking, worst_clips

_MOST_ROWS = 200
"""Clips in the table of the report; all are in clips.parquet."""
_MOST_FAILURES = 50


@dataclass(frozen=True)
class ReportOptions:
    title: str
    worst: int
    """Clips with pictures."""


def write_report(
    folder: ResultsFolder, tasks: pd.DataFrame, order: Order | None, submit: Submit | None, options: ReportOptions
) -> Path:
    """Write clips.parquet and report.html.

    Parameters
    ----------
    tasks : DataFrame
        Those that the report is about.
    order, submit
        For stills that are not there yet; None: without them.
    """
    points = read_points(folder, tasks)
    streams = table_of_streams(points)
    clips = table_of_clips(points, streams)
    sink = pa.BufferOutputStream()
    parquet.write_table(pa.Table.from_pandas(clips, preserve_index=False), sink, compression="zstd")
    write_atomically(folder.path / "clips.parquet", sink.getvalue().to_pybytes())
    page = _template().render(
        title=options.title,
        style=Markup(_text("report.css")),
        asked=folder.asked(),
        failures=tables.failures(tasks, _MOST_FAILURES),
        counts=tables.counts(tasks, clips),
        **(_measured(folder, order, submit, options, points, streams, clips) if len(clips) else {"clips": []}),
    )
    path = folder.path / "report.html"
    write_atomically(path, page.encode())
    return path


def _measured(
    folder: ResultsFolder,
    order: Order | None,
    submit: Submit | None,
    options: ReportOptions,
    points: pd.DataFrame,
    streams: pd.DataFrame,
    clips: pd.DataFrame,
) -> dict[str, object]:
    """What a report has where a clip could be measured."""
    peers = charts.peers_of(points)
    return {
        "summary": tables.summary(clips, peers),
        "peers": tables.names(peers),
        "rate_charts": {area: charts.rate_chart(streams, peers, area) for area in AREAS},
        "bd_charts": {area: charts.bd_chart(clips, peers, area) for area in AREAS} if peers else {},
        "bd_rows": tables.bd_rows(clips, peers),
        "qualities": tables.quality_rows(streams),
        "value_charts": _value_charts(streams),
        "worst": _worst(folder, order, submit, options, streams, clips),
        "worst_by": ranking(clips)[1],
        "clips": tables.clip_rows(clips, _MOST_ROWS),
        "clip_count": len(clips),
    }


def _value_charts(streams: pd.DataFrame) -> list[tuple[str, Markup]]:
    wanted = (
        ("Rate", "kbps", "kbit/s", True),
        ("Face", "psnr_face", "luma PSNR of the face, dB", False),
        ("Frame", "psnr_frame", "luma PSNR of the frame, dB", False),
        ("Encoding", "encode_speed", "pictures per second", True),
        ("Decoding, one thread", "decode_speed", "pictures per second", True),
        ("Before the first picture", "bytes_startup", "bytes", True),
    )
    return [(name, charts.quality_chart(streams, column, unit, is_log=is_log)) for name, column, unit, is_log in wanted]


def _worst(
    folder: ResultsFolder,
    order: Order | None,
    submit: Submit | None,
    options: ReportOptions,
    streams: pd.DataFrame,
    clips: pd.DataFrame,
) -> list[dict[str, object]]:
    worst = worst_clips(clips, options.worst)
    corpus = folder.asked()["folder"]
    reference = FbsSetting(int(streams["quality"].max()))
    wanted = []
    for _, clip in worst.iterrows():
        key = f"{clip['clip_key']}-quality-{int(clip['quality'])}"
        wanted.append((key, _found(corpus, str(clip["clip"])), reference, FbsSetting(int(clip["quality"]))))
    stills = stills_of(folder.path / "stills", wanted, order, submit)
    return [tables.worst_row(clip, _sources(s), s.error) for (_, clip), s in zip(worst.iterrows(), stills, strict=True)]


def _found(corpus: str, name: str) -> Clip:
    """A clip that may be gone or have changed: its stills are of what is there now."""
    return Clip(corpus, name, 0, 0)


def _sources(stills: Stills) -> dict[str, str]:
    return {kind: "data:image/jpeg;base64," + base64.b64encode(image).decode() for kind, image in stills.images.items()}


def _text(name: str) -> str:
    return resources.files("fbs.corpus.report").joinpath(name).read_text(encoding="utf-8")


def _template() -> jinja2.Template:
    environment = jinja2.Environment(
        autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    environment.filters |= {"number": tables.number, "things": tables.things, "duration": duration}
    return environment.from_string(_text("report.html.jinja"))
