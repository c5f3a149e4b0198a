"""Columns of the tables: their types, units and meaning, which travel in the Parquet files as metadata."""

from __future__ import annotations

import pyarrow as pa


def _schema(columns: list[tuple[str, pa.DataType, str]]) -> pa.Schema:
    return pa.schema([pa.field(name, kind, metadata={"description": text}) for name, kind, text in columns])


def _quality(area: str) -> list[tuple[str, pa.DataType, str]]:
    return [
        (f"psnr_{area}", pa.float32(), f"PSNR of luma of the {area}, dB, of the mean error over all pictures"),
        (f"psnr_u_{area}", pa.float32(), f"the same of U of the {area}, dB"),
        (f"psnr_v_{area}", pa.float32(), f"the same of V of the {area}, dB"),
        (f"ssim_{area}", pa.float32(), f"SSIM of luma of the {area}, mean over the pictures"),
        (f"ms_ssim_{area}", pa.float32(), f"MS-SSIM of luma of the {area}, mean over the pictures"),
    ]


POINTS = _schema(
    [
        ("clip", pa.string(), "path below the corpus folder"),
        ("clip_key", pa.string(), "changes with path, size and time of change of the clip"),
        ("setting", pa.string(), "what the clip was encoded with; a task is a clip and a setting"),
        ("task_key", pa.string(), "changes with clip, setting and program"),
        ("codec", pa.string(), "fbs, x264, x265, av1"),
        ("quality", pa.int16(), "of fbs, 0 to 100; null of others"),
        ("peer_size", pa.int8(), "divisor of width and height; null of fbs"),
        ("peer_rate", pa.int8(), "every how many pictures one is coded; null of fbs"),
        ("crf", pa.int16(), "constant rate factor; null of fbs"),
        ("width", pa.int16(), "of the clip, samples"),
        ("height", pa.int16(), "of the clip, samples"),
        ("fps", pa.float32(), "of the clip, pictures per second, mean"),
        ("pictures", pa.int32(), "compared with the clip"),
        ("seconds", pa.float32(), "length, s"),
        ("bytes", pa.int64(), "of the stream, without sound and container"),
        ("bytes_startup", pa.int64(), "before the first picture; fbs only, as are all parts"),
        ("bytes_geometry", pa.int64(), "of geometry"),
        ("bytes_patterns", pa.int64(), "of patterns"),
        ("bytes_motion", pa.int64(), "of motion"),
        ("kbps", pa.float64(), "rate, kbit/s"),
        *_quality("face"),
        *_quality("frame"),
        ("vmaf_frame", pa.float32(), "VMAF of the frame; null where ffmpeg has none"),
        ("face_pictures", pa.int32(), "pictures in which a face is believed"),
        ("face_share", pa.float32(), "samples of the face over those of the frame, mean"),
        (
            "worst_picture",
            pa.int32(),
            "number, from 0, of the picture with the least luma PSNR of the face (else frame)",
        ),
        ("worst_psnr", pa.float32(), "of that picture, dB"),
        ("cuts", pa.int32(), "scenes after the first; fbs only"),
        ("patterns", pa.int32(), "pictures that were sent; fbs only"),
        (
            "yaw_range_deg",
            pa.float32(),
            "95th less 5th percentile of yaw; of the best stream of fbs only, as the next two",
        ),
        ("pitch_range_deg", pa.float32(), "the same of pitch"),
        ("motion", pa.float32(), "median path of the head per second, in distances between the eyes"),
        ("encode_s", pa.float32(), "wall time of fbs encode; null of others"),
        ("decode_s", pa.float32(), "wall time of fbs decode with one thread; null of others"),
        ("program", pa.string(), "its version"),
    ]
)
"""One row for each point: a clip, a setting and, of other codecs, a constant rate factor."""

TASKS = _schema(
    [
        ("clip", pa.string(), "path below the corpus folder"),
        ("clip_key", pa.string(), "changes with path, size and time of change of the clip"),
        ("setting", pa.string(), "what the clip was encoded with"),
        ("task_key", pa.string(), "changes with clip, setting and program"),
        ("error", pa.string(), "why it failed, one line; null: it did not"),
        ("points", pa.int16(), "rows in the table of points"),
        ("note", pa.string(), "what the program said of a clip that is cut off or damaged; null: nothing"),
        ("attempts", pa.int16(), "so often the task began in that run"),
        ("host", pa.string(), "of the last attempt; null where nobody knows"),
        ("task_s", pa.float32(), "wall time of the last attempt"),
        ("cpu_s", pa.float32(), "CPU time of its programs; null where a worker has several threads"),
        ("finished", pa.timestamp("ms", tz="UTC"), "when it was finished or given up"),
    ]
)
"""One row for each task, a clip and a setting. Where a clip cannot be encoded at its highest quality, all fail."""


def table_of(rows: list[dict[str, object]], schema: pa.Schema) -> pa.Table:
    """Rows that have come through JSON as a table: what a row does not have is null."""
    columns = []
    for field in schema:
        values = pa.array([row.get(field.name) for row in rows])
        if pa.types.is_timestamp(field.type):  # ms since 1970
            values = values.cast(pa.int64()).cast(pa.timestamp("ms")).cast(field.type)
        columns.append(values.cast(field.type))
    return pa.Table.from_arrays(columns, schema=schema)
