"""Tables, curves, statistics and report of a corpus, from rows made here."""

import os
import re

import numpy as np
import pytest

pd = pytest.importorskip("pandas")
pytest.importorskip("pyarrow")
pytest.importorskip("distributed")
pytest.importorskip("matplotlib")
pytest.importorskip("bjontegaard")

from fbs.corpus.bd_rate import bd_rate, envelope, quality_at  # noqa: E402
from fbs.corpus.clip_table import current, read_points, table_of_clips, table_of_streams  # noqa: E402
from fbs.corpus.report.chart import Row, Series, curve_chart, row_chart  # noqa: E402
from fbs.corpus.report.page import ReportOptions, write_report  # noqa: E402
from fbs.corpus.result import Result  # noqa: E402
from fbs.corpus.results_folder import Keys, ResultsFolder  # noqa: E402
from fbs.corpus.schema import POINTS, TASKS  # noqa: E402
from fbs.corpus.setting import asked_settings  # noqa: E402
from fbs.corpus.statistics import median_interval  # noqa: E402
from fbs.corpus.worst import worst_clips  # noqa: E402


@pytest.fixture(autouse=True)
def without_waiting_for_the_disk(monkeypatch):
    monkeypatch.setattr(os, "fsync", lambda file: None)


def result(clip, setting, points=(), *, error=None, finished=1000, key=None):
    names = {"clip": clip, "clip_key": f"{abs(hash(clip)):016x}"[:16], "setting": setting}
    names["task_key"] = key or f"{abs(hash((clip, setting, finished))):016x}"[:16]
    task = names | {
        "error": error,
        "points": len(points),
        "attempts": 1,
        "host": "here",
        "task_s": 2.0,
        "finished": finished,
    }
    return Result(task, [names | point for point in points])


def stream(quality, kbps, psnr, **more):
    return {
        "codec": "fbs", "quality": quality, "kbps": kbps, "psnr_face": psnr, "psnr_frame": psnr - 2, "width": 64, "height": 48,
        "fps": 25, "pictures": 50, "seconds": 2, "bytes": 100, "bytes_startup": 50, "face_pictures": 50, "face_share": 0.1,
        "worst_picture": 7, "worst_psnr": psnr - 1, "cuts": 0, "patterns": 2, "yaw_range_deg": 10, "pitch_range_deg": 5,
        "motion": 0.1, "encode_s": 1, "decode_s": 0.1,
    } | more  # fmt: skip


def peer(codec, crf, kbps, psnr):
    return {
        "codec": codec,
        "crf": crf,
        "peer_size": 1,
        "peer_rate": 1,
        "kbps": kbps,
        "psnr_face": psnr,
        "psnr_frame": psnr,
    }


ASKED = {
    "folder": "/data/faces", "frames": None, "effort": 1, "allow_no_face": False,
    "qualities": [20, 35, 50, 65, 80], "peers": ["x264"], "peer_sizes": [1], "peer_rates": [1],
}  # fmt: skip


def corpus(folder, clips=12):
    """Clips for which fbs takes half the rate of x264, but the last, which it takes twice as much for."""
    folder.begin_run(ASKED)
    for n in range(clips):
        factor = 2 if n == clips - 1 else 0.5
        more = {"yaw_range_deg": 60} if n == clips - 1 else {"yaw_range_deg": 10 + n % 3}
        for quality in (20, 35, 50, 65, 80):
            folder.keep(
                result(
                    f"c{n:03}.mkv",
                    f"fbs-quality-{quality}",
                    [stream(quality, factor * quality, 20 + quality / 8, **more)],
                )
            )
        rates = [(crf, 80 - crf) for crf in (60, 50, 40, 30, 20, 10)]
        folder.keep(
            result(
                f"c{n:03}.mkv", "x264-size-1-rate-1", [peer("x264", crf, kbps, 20 + kbps / 8) for crf, kbps in rates]
            )
        )
    folder.fold()


def test_bd_rate_is_that_of_the_program():
    # The formula of tests/unit/cli/evaluate/bd_rate_test.cpp: half the rate at each quality is -50 %.
    anchor = [(10.0, 30.0), (20.0, 33.0), (40.0, 35.0), (80.0, 38.0)]
    assert bd_rate(anchor, [(k / 2, q) for k, q in anchor]) == pytest.approx(-50)
    assert bd_rate(anchor, anchor[:3]) is None
    assert bd_rate(anchor, [(k, q + 20) for k, q in anchor]) is None


def test_envelope_leaves_out_what_is_beaten_and_what_is_no_number():
    assert envelope([(2, 31), (1, 30), (3, 29), (2, 30), (4, np.nan), (0, 50)]) == [(1, 30), (2, 31)]
    assert quality_at([(1, 30), (4, 32)], 2) == pytest.approx(31)
    assert quality_at([(1, 30), (4, 32)], 5) is None


def test_interval_of_a_median_holds_it_and_narrows():
    random = np.random.default_rng(3)
    narrow, wide = (np.diff(median_interval(random.normal(size=count)))[0] for count in (4000, 40))
    assert 0 < narrow < wide / 4
    resampled, ordered = (median_interval(np.arange(count) / count) for count in (5000, 5001))
    assert resampled == pytest.approx(ordered, abs=0.004)
    assert median_interval(np.arange(4.0)) is None


def test_keys_are_found():
    keys = Keys(["ffffffffffffffff", "0000000000000000", "00000000000000aa"])
    assert "00000000000000aa" in keys and "ffffffffffffffff" in keys and "00000000000000ab" not in keys
    assert "00" not in Keys()


def test_tables_say_what_their_columns_are(tmp_path):
    folder = ResultsFolder(tmp_path)
    corpus(folder, 1)
    for schema in (POINTS, TASKS):
        assert all(field.metadata[b"description"] for field in schema)
    table = folder.points()
    assert table.schema.field("kbps").metadata == {b"description": b"rate, kbit/s"}
    assert pd.read_parquet(tmp_path / "points")["kbps"].sum() == table["kbps"].to_numpy().sum()


def test_a_fold_that_was_cut_short_counts_nothing_twice(tmp_path):
    folder = ResultsFolder(tmp_path)
    folder.keep(result("a", "fbs-quality-20", [stream(20, 1, 30)]))
    kept = {path: path.read_bytes() for path in tmp_path.glob("finished/*/*")}
    folder.fold()
    next(tmp_path.glob("tasks/*")).unlink()  # killed between the two tables
    for path, content in kept.items():
        path.write_bytes(content)
    assert len(folder.points()) == 0
    assert folder.fold() == 1
    assert len(folder.points()) == 1 and len(folder.tasks()) == 1


def test_results_of_another_corpus_are_not_mixed(tmp_path):
    folder = ResultsFolder(tmp_path)
    corpus(folder, 1)
    asked = folder.asked()
    with pytest.raises(ValueError, match="has results of /data/faces; give another --out"):
        folder.begin_run(asked | {"folder": "/data/other"})
    with pytest.raises(ValueError, match="another --frames"):
        folder.begin_run(asked | {"frames": 10})
    folder.begin_run(asked | {"qualities": [1]})


def test_two_commands_do_not_write_to_one_folder(tmp_path):
    with ResultsFolder(tmp_path / "new").locked():
        with pytest.raises(ValueError, match="another command is at work there"):
            with ResultsFolder(tmp_path / "new").locked():
                pass
    with ResultsFolder(tmp_path / "new").locked():
        pass


def test_a_newer_result_takes_the_place_of_an_older_one(tmp_path):
    folder = ResultsFolder(tmp_path)
    folder.keep(result("a", "fbs-quality-20", [stream(20, 1, 30)], finished=1000))
    folder.keep(result("a", "fbs-quality-20", [stream(20, 2, 31)], finished=2000))
    folder.keep(result("b", "fbs-quality-20", error="no face", key="b" * 16))
    folder.fold()
    folder.keep(result("b", "fbs-quality-20", [stream(20, 3, 32)], key="b" * 16))
    folder.fold()
    folder.keep(result("b", "fbs-quality-21", [stream(21, 4, 33)]))  # of an earlier run with other qualities
    folder.fold()
    points = read_points(folder, current(folder.tasks(), asked_settings(ASKED)))
    assert sorted(points["kbps"]) == [2, 3]
    assert folder.write_failures(folder.tasks()) == 0


def test_the_worst_clip_is_found_and_why(tmp_path):
    folder = ResultsFolder(tmp_path)
    corpus(folder)
    points = read_points(folder, folder.tasks())
    clips = table_of_clips(points, table_of_streams(points))
    assert clips["bd_rate_face_x264"].tolist()[:11] == pytest.approx([-50] * 11, abs=1)
    assert clips["bd_rate_face_x264"].iloc[11] == pytest.approx(100, abs=3)
    assert clips["gain_face"].iloc[0] == pytest.approx(50 / 8 - 25 / 8, abs=0.5)
    worst = worst_clips(clips, 3)
    assert worst["clip"].iloc[0] == "c011.mkv"
    assert worst["reasons"].iloc[0][0] == "the head turns over 60° (median 11°)"
    assert worst["reasons"].iloc[1] == []


def test_what_goes_with_bad_results_is_named_first():
    clips = pd.DataFrame(
        {"motion": np.arange(40) / 100, "face_share": 0.1, "pictures": 50, "face_pictures": 50, "psnr_face": 30.0}
    )
    clips = clips.assign(
        yaw_range_deg=10.0, pitch_range_deg=5.0, cuts=0, fps=25.0, seconds=2.0, gain_face=np.nan, worst_psnr=29.0,
        bd_rate_face_envelope=-clips["motion"], psnr_frame=30.0,
    )  # fmt: skip
    clips.loc[0, "face_share"] = 0.01
    first, second = worst_clips(clips, 2)["reasons"]
    assert first[0].startswith("the head hardly moves, 0.00 eye") and first[1].startswith("the face is 1.0 %")
    assert len(second) == 1 and second[0].startswith("the head hardly moves, 0.01 eye")


def test_the_report_is_one_file_that_stays_small(tmp_path):
    folder = ResultsFolder(tmp_path)
    corpus(folder, 250)
    folder.keep(result("<b>.mkv", "fbs-quality-80", error="cannot read <b>.mkv: not a video"))
    folder.fold()
    page = write_report(folder, folder.tasks(), None, None, ReportOptions("faces", 10)).read_text()
    assert not re.search(r"https?://|<script|@import|url\(|<link|\{\{|nan|None", page)
    assert "250 of 251 clips measured" in page and "; 249 clips</small>" in page
    assert "&lt;b&gt;.mkv" in page and "<b>.mkv" not in page
    assert (
        "50 % less rate for the same face (95\N{NO-BREAK SPACE}% interval \N{MINUS SIGN}50 to \N{MINUS SIGN}50 %; 250 clips)"
        in page
    )
    assert "The first 200 of 250; all are in clips.parquet" in page
    assert page.count("<svg") == 10
    assert len(page) < 300_000
    assert len(pd.read_parquet(tmp_path / "clips.parquet")) == 250


def test_a_report_of_nothing_says_so(tmp_path):
    folder = ResultsFolder(tmp_path)
    folder.begin_run(ASKED)
    folder.keep(result("a.mkv", "fbs-quality-80", error="no face"))
    folder.fold()
    page = write_report(folder, folder.tasks(), None, None, ReportOptions("faces", 10)).read_text()
    assert "No clip could be measured" in page and "no face" in page


@pytest.mark.parametrize(
    ("low", "high", "is_log"), [(3, 9, True), (4.1, 4.2, True), (0.01, 5000, True), (-70, 3, False), (30, 30, False)]
)
def test_axes_have_round_ticks(low, high, is_log):
    chart = row_chart([Row("a", "fbs", np.array([low, high]))], "x", "", is_log=is_log)
    ticks = re.findall(r">([\d.\N{MINUS SIGN}]+)</text>", chart)
    assert 3 <= len(ticks) <= 12
    assert all(len(tick) <= 7 for tick in ticks)


def test_charts_have_the_colours_and_letters_of_the_page():
    series = Series("<best>", "envelope", [3, 9], [30, 31], [29, 30], [31, 32], has_points=True)
    chart = curve_chart([series], "kbit/s", "dB", "<rate>")
    colours = set(re.findall(r"(?:fill|stroke): ([^;\"]+)", chart))
    assert colours == {"none", "var(--envelope)", "var(--grid)", "var(--quiet)"}
    assert 'aria-label="&lt;rate&gt;"' in chart and "&lt;best&gt;</text>" in chart
    assert "font-size" not in chart and "font-family" not in chart
