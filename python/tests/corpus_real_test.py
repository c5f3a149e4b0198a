"""A corpus of two generated talkers and a broken clip, with the program itself."""

import json
import os
import pathlib
import shutil
import subprocess
import sys

import pytest

pd = pytest.importorskip("pandas")
pytest.importorskip("pyarrow")
pytest.importorskip("distributed")

BUILD = pathlib.Path(os.environ.get("FBS_BUILD", pathlib.Path(__file__).parents[2] / "build/release"))
FBS = os.environ.get("FBS_PROGRAM", str(BUILD / "fbs"))
TALKER = BUILD / "talker"

pytestmark = pytest.mark.skipif(
    not (pathlib.Path(FBS).exists() and TALKER.exists() and shutil.which("ffmpeg")),
    reason="needs the program, the talker (FBS_BUILD) and ffmpeg",
)

QUALITIES = ["20", "40", "60", "90"]


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """Folder of clips, folder of results, and how it ended."""
    folder = tmp_path_factory.mktemp("real")
    (folder / "clips/more").mkdir(parents=True)
    for name, seed in (("one", "3"), ("more/two", "5")):
        subprocess.run(
            [TALKER, folder / f"clips/{name}.y4m", "--size", "96x80", "--frames", "14", "--seed", seed], check=True
        )
    (folder / "clips/broken.mkv").write_bytes(b"not a video")
    done = subprocess.run(
        [sys.executable, "-m", "fbs.corpus", folder / "clips", "--out", folder / "out", "--qualities", *QUALITIES, "--peers", "x264",
         "--peer-sizes", "1", "--peer-rates", "1", "--frames", "12", "--workers", "2", "--worst", "1"],
        env={**os.environ, "FBS_PROGRAM": FBS}, capture_output=True, text=True, timeout=120,
    )  # fmt: skip
    return folder / "clips", folder / "out", done


def test_clips_are_measured_and_the_broken_one_is_listed(run):
    _, out, done = run
    assert done.returncode == 2, done.stderr
    assert "5 tasks failed" in done.stderr
    failures = pd.read_parquet(out / "failures.parquet")
    assert set(failures["clip"]) == {"broken.mkv"} and failures["error"].str.contains("not a video").all()
    tasks = pd.read_parquet(out / "tasks")
    assert len(tasks) == 3 * 5 and (tasks.loc[tasks["error"].isna(), "cpu_s"] > 0).all()


def test_points_and_bd_rate_are_those_of_evaluate(run):
    clips, out, _ = run
    told = json.loads(
        subprocess.run(
            [FBS, "evaluate", clips / "one.y4m", "--quality", *QUALITIES, "--frames", "12", "--peers", "--peer-codec", "x264",
             "--peer-size", "1", "--peer-rate", "1", "--json", "--quiet"], check=True, capture_output=True,
        ).stdout
    )  # fmt: skip
    points = pd.read_parquet(out / "points").query("clip == 'one.y4m'")
    own = points[points["codec"] == "fbs"].sort_values("quality")
    assert own["bytes"].tolist() == [point["bytes"]["total"] for point in told["points"]]
    for name in ("kbps", "psnr_face", "psnr_frame", "ms_ssim_face"):
        assert own[name].tolist() == pytest.approx([point[name] for point in told["points"]], rel=1e-6), name
    others = points[points["codec"] == "x264"].sort_values("crf", ascending=False)
    assert others["kbps"].tolist() == pytest.approx([point["kbps"] for point in told["peers"]])
    clip = pd.read_parquet(out / "clips.parquet").set_index("clip").loc["one.y4m"]
    assert told["bd_rate"]["face"] and told["bd_rate"]["frame"]
    for area in ("face", "frame"):
        assert clip[f"bd_rate_{area}_x264"] == pytest.approx(told["bd_rate"][area]["percent"], abs=0.01), area


def test_the_report_shows_the_worst_picture(run):
    _, out, _ = run
    page = (out / "report.html").read_text()
    assert page.count('src="data:image/jpeg;base64,/9j/') == 3
    assert "Compared with x264" in page and "broken.mkv" in page
