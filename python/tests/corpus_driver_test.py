"""How a corpus is run: what fails, what is killed, what is not done twice. The program is a fake."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

distributed = pytest.importorskip("distributed")
pytest.importorskip("pyarrow")

from corpus_fake import fake, make_clips  # noqa: E402, F401

from fbs.corpus.clip import clips_in  # noqa: E402
from fbs.corpus.cluster import connected  # noqa: E402
from fbs.corpus.driver import Driver  # noqa: E402
from fbs.corpus.order import Order  # noqa: E402
from fbs.corpus.plan import plans_of  # noqa: E402
from fbs.corpus.results_folder import Keys, ResultsFolder  # noqa: E402
from fbs.corpus.setting import settings_of  # noqa: E402

SETTINGS = settings_of([20, 50], ["av1"], [1], [1])


@pytest.fixture(scope="module")
def client(fake):
    with connected("local", workers=2) as client:
        yield client


@pytest.fixture
def order(tmp_path, fake):
    fake.clear()
    return Order(program="fbs 9.9", results=str(tmp_path / "results"), run="this")


def drive(client, clips, order, *, settings=SETTINGS, limit=8, retry=False, on_result=lambda tally: None, store=None):
    """Do what is left to do; give the tally and the tasks."""
    folder = ResultsFolder(store or order.results)
    folder.fold()
    done, failed = folder.finished()
    plans = plans_of(clips_in(clips), settings, order, done, Keys() if retry else failed)
    tally = Driver(client, folder, order, limit, on_result).run(plans)
    folder.fold()
    return tally, folder.tasks().set_index(["clip", "setting"]).sort_index()


def test_each_clip_and_setting_is_a_task_with_its_points(client, order, tmp_path):
    clips = make_clips(tmp_path / "clips", a="ok", b="ok")
    tally, tasks = drive(client, clips, order)
    assert (tally.done, tally.failed) == (6, 0)
    assert tasks["points"].to_dict() == {
        (clip, setting): points
        for clip in ("a.y4m", "b.y4m")
        for setting, points in (("fbs-quality-20", 1), ("fbs-quality-50", 1), ("av1-size-1-rate-1", 5))
    }
    points = ResultsFolder(order.results).points().to_pandas().set_index(["clip", "setting", "crf"]).sort_index()
    best = points.loc[("a.y4m", "fbs-quality-50")].iloc[0]
    assert best["quality"] == 50 and best["kbps"] == 50
    assert best["worst_picture"] == 2 and best["worst_psnr"] == 22
    assert best["face_share"] == pytest.approx(308 / (64 * 48))
    assert best["cuts"] == 1 and best["yaw_range_deg"] == pytest.approx(18)
    assert best["motion"] == pytest.approx(5 / 0.04 / 20)
    assert points.loc[("b.y4m", "av1-size-1-rate-1", 63), "kbps"] == 37
    assert not list(Path(order.results).glob("finished/*/*")) + list(Path(order.results).glob("streams/*"))
    assert not list(Path(order.results).glob("attempts/*"))


def test_a_quarter_of_a_small_picture_is_not_coded(client, order, tmp_path, fake):
    clips = make_clips(tmp_path / "clips", a="ok")
    tally, tasks = drive(client, clips, order, settings=settings_of([50], ["av1"], [1, 4], [1]))
    assert (tally.done, tally.failed) == (3, 0)
    assert tasks.loc["a.y4m", "points"].to_dict() == {"fbs-quality-50": 1, "av1-size-1-rate-1": 5, "av1-size-4-rate-1": 0}
    assert not any("--peer-size 4" in line for line in fake.lines("evaluate"))


def test_a_broken_clip_is_listed_and_the_rest_goes_on(client, order, tmp_path):
    clips = make_clips(tmp_path / "clips", a="ok", b="broken", c="ok")
    tally, tasks = drive(client, clips, order)
    assert (tally.done, tally.failed) == (9, 3)
    failed = tasks[tasks["error"].notna()]
    assert set(failed.index.get_level_values("clip")) == {"b.y4m"}
    assert failed["error"].unique().tolist() == [f"{clips}/b.y4m: not a video"]
    assert failed["attempts"].tolist() == [1, 1, 1]


def test_a_name_that_is_no_text_is_a_name(client, order, tmp_path):
    clips = make_clips(tmp_path / "clips")
    Path(os.fsdecode(os.fsencode(clips) + b"/f\xe9.y4m")).write_text("ok\n")
    _, tasks = drive(client, clips, order)
    assert tasks["error"].isna().all() and set(tasks.index.get_level_values("clip")) == {"f\ufffd.y4m"}


def test_what_is_done_or_failed_is_not_done_again(client, order, tmp_path, fake):
    clips = make_clips(tmp_path / "clips", a="ok", b="broken")
    drive(client, clips, order)
    fake.clear()
    assert drive(client, clips, order)[0].done == 0
    assert fake.lines() == []
    drive(client, clips, order, settings=settings_of([20, 35, 50], ["av1"], [1], [1]))
    # The new quality, and the best one, which says where the face is.
    assert sorted(line.split()[4] for line in fake.lines("encode") if "a.y4m" in line) == ["35", "50"]
    make_clips(clips, b="ok").joinpath("a.y4m").write_text("ok, and changed\n")
    tally, tasks = drive(client, clips, order)
    assert (tally.done, tally.failed) == (6, 0)


def test_what_failed_is_tried_again_when_asked(client, order, tmp_path, fake):
    clips = make_clips(tmp_path / "clips", a="broken")
    drive(client, clips, order)
    fake.clear()
    tally, _ = drive(client, clips, order, retry=True)
    assert (tally.done, tally.failed) == (3, 3) and len(fake.lines("encode")) == 1


def worker_processes(client):
    return list(client.run(os.getpid).values())


@pytest.mark.parametrize("allowed_failures", [3, 0])
def test_a_worker_that_is_killed_loses_nothing(allowed_failures, client, order, tmp_path, fake):
    """Dask gives tasks to other workers; one that it gives up, since too many of them died, is given to it again."""

    def allow(number, dask_scheduler):
        before, dask_scheduler.allowed_failures = dask_scheduler.allowed_failures, number
        return before

    clips = make_clips(tmp_path / "clips", **{f"c{n}": "slow" for n in range(4)})
    killed = []

    def kill_one(tally):
        if tally.done == 3:
            killed.append(worker_processes(client)[0])
            os.kill(killed[0], signal.SIGKILL)

    usual = client.run_on_scheduler(allow, allowed_failures)
    tally, tasks = drive(client, clips, order, on_result=kill_one)
    client.run_on_scheduler(allow, usual)
    assert killed and (tally.done, tally.failed) == (12, 0)
    assert len(tasks) == 12 and tasks["error"].isna().all()
    assert bool(tally.lost) == (allowed_failures == 0)
    # At most what ran on it was done again.
    assert len(fake.lines("encode")) <= 8 + 1


def test_a_clip_that_kills_its_workers_is_given_up(client, order, tmp_path, fake):
    clips = make_clips(tmp_path / "clips", a="ok", b="killer", c="ok")
    tally, tasks = drive(client, clips, order)
    assert (tally.done, tally.failed) == (9, 3)
    failed = tasks[tasks["error"].notna()]
    assert set(failed.index.get_level_values("clip")) == {"b.y4m"}
    assert failed["error"].unique().tolist() == ["its worker was killed, 3 times"]
    assert len([line for line in fake.lines("encode") if "b.y4m" in line]) == 3


def test_the_number_of_tasks_in_flight_is_bounded(client, order, tmp_path):
    clips = make_clips(tmp_path / "clips", **{f"c{n:02}": "ok" for n in range(30)})
    begun, most = [0], [0]
    plans = plans_of(clips_in(clips), SETTINGS, order, Keys(), Keys())

    def counted():
        for plan in plans:
            begun[0] += len(plan.settings)
            yield plan

    def watch(tally):
        most[0] = max(most[0], begun[0] - tally.done)

    folder = ResultsFolder(order.results)
    tally = Driver(client, folder, order, 6, watch).run(counted())
    assert tally.done == 90 and tally.failed == 0
    assert 6 <= most[0] <= 6 + len(SETTINGS)


def test_results_can_go_through_the_client(client, order, tmp_path):
    clips = make_clips(tmp_path / "clips", a="ok", b="broken")
    through = Order(program=order.program, results=None, run="this", keep_streams=True)
    tally, tasks = drive(client, clips, through, store=tmp_path / "here")
    assert (tally.done, tally.failed) == (6, 3) and len(tasks) == 6
    kept = sorted(path.name.split(".")[0] for path in (tmp_path / "here/streams").glob("*/*.fbs"))
    assert kept == ["fbs-quality-20", "fbs-quality-50"]


def test_a_program_that_hangs_or_is_another_one_fails_its_task(client, order, tmp_path):
    clips = make_clips(tmp_path / "clips", a="hang")
    impatient = Order(program=order.program, results=order.results, run="this", timeout_s=0.5)
    _, tasks = drive(client, clips, impatient, settings=SETTINGS[:1])
    assert tasks["error"].tolist() == ["fbs took more than 0.5 s"]
    other = Order(program="fbs 1.0", results=order.results, run="this")
    _, tasks = drive(client, clips, other, settings=SETTINGS[:1])
    assert tasks["error"].tolist()[-1].endswith("has fbs 9.9, and the run began with fbs 1.0")


def test_a_killed_command_goes_on_where_it_was(fake, tmp_path):
    fake.clear()
    clips = make_clips(tmp_path / "clips", **{f"c{n}": "slow" for n in range(4)})
    results = tmp_path / "results"
    command = [
        sys.executable,
        "-m",
        "fbs.corpus",
        clips,
        "--out",
        results,
        "--qualities",
        "20",
        "50",
        "--workers",
        "1",
        "--worst",
        "0",
    ]
    first = subprocess.Popen([*command, "--quiet"], start_new_session=True)
    finished = lambda: [path.stem for path in results.glob("finished/*/*.json")]  # noqa: E731
    end = time.monotonic() + 30
    while len(finished()) < 3 and time.monotonic() < end:
        time.sleep(0.02)
    os.kill(first.pid, signal.SIGKILL)
    first.wait()
    time.sleep(0.6)  # the worker that it leaves behind notices, and takes its program with it
    done = len(finished())
    before = len(fake.lines("evaluate"))
    assert 3 <= done < 8
    again = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert again.returncode == 0, again.stderr
    assert f"{8 - done} tasks, {done} are done already" in again.stderr
    assert len(fake.lines("evaluate")) - before == 8 - done
    assert (results / "report.html").exists() and len(ResultsFolder(results).tasks()) == 8


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["absent", "--out", "r"], "absent"),
        (["clips", "--out", "r", "--peers", "x266"], "x266 is none of x264, x265, av1"),
        (["clips", "--out", "r", "--qualities", "101"], "101 is not from 0 to 100"),
        (["--out", "r"], "DIR is missing"),
        (["--out", "r", "--report-only"], "r: has no results"),
        (["empty", "--out", "r"], "empty: has no clip"),
    ],
)
def test_bad_arguments_are_one_line(arguments, says, fake, tmp_path, monkeypatch, capsys):
    from fbs.corpus.command import main

    make_clips(tmp_path / "clips", a="ok")
    (tmp_path / "empty").mkdir()
    monkeypatch.chdir(tmp_path)
    try:
        code = main(arguments)
    except SystemExit as stopped:
        code = stopped.code
    assert code in (1, 2)
    last = capsys.readouterr().err.splitlines()[-1]
    assert says in last and "Traceback" not in last
    assert not (tmp_path / "r").exists()
