"""What ``python -m fbs.corpus`` does."""

from __future__ import annotations

import argparse
import functools
import sys
import uuid
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from distributed import Client

from fbs.corpus.arguments import order_facts, parse
from fbs.corpus.child import program_version
from fbs.corpus.clip import clips_in, names_in
from fbs.corpus.clip_table import current
from fbs.corpus.cluster import connected
from fbs.corpus.driver import Driver, Tally
from fbs.corpus.order import Order
from fbs.corpus.plan import ClipPlan, plans_of
from fbs.corpus.progress import Progress
from fbs.corpus.report.page import ReportOptions, write_report
from fbs.corpus.results_folder import Keys, ResultsFolder
from fbs.corpus.setting import asked_settings
from fbs.corpus.stills import Submit
from fbs.errors import Error, ProgramMissingError

COMPLETE, FAILED, PARTIAL, INTERRUPTED = 0, 1, 2, 130
_IN_FLIGHT_PER_THREAD = 4
_IN_FLIGHT_LEAST = 64


def main(arguments: list[str] | None = None) -> int:
    """Run the command; give its exit code."""
    options = parse(arguments)
    try:
        if not options.report_only and next(names_in(options.folder), None) is None:
            raise Error(f"{options.folder}: has no clip")
        folder = ResultsFolder(Path(options.out).absolute())
        if options.report_only and not folder.asked():
            raise Error(f"{options.out}: has no results")
        with folder.locked():
            return _report(options, folder) if options.report_only else _run(options, folder)
    except KeyboardInterrupt:
        print(f"\nfbs.corpus: stopped; the same command goes on from there, in {options.out}", file=sys.stderr)
        return INTERRUPTED
    except (Error, OSError, ValueError) as problem:
        print(f"fbs.corpus: {problem}", file=sys.stderr)
        return FAILED


def _run(options: argparse.Namespace, folder: ResultsFolder) -> int:
    folder.begin_run(order_facts(options))
    folder.fold()
    with connected(
        options.scheduler,
        workers=options.workers,
        memory_limit=options.memory_limit,
        dashboard=options.dashboard,
    ) as client:
        version = client.submit(program_version, pure=False).result()
        order = _order_of(options, folder, version)
        tally = _drive(options, folder, order, client)
        folder.fold()
        _say(options, "making the report")
        code = _write(options, folder, order, functools.partial(client.submit, pure=False))
    if tally.lost:
        _say(options, f"{tally.lost} tasks were lost with their workers, and given out again")
    return code


def _drive(options: argparse.Namespace, folder: ResultsFolder, order: Order, client: Client) -> Tally:
    done, failed = folder.finished()
    settings = asked_settings(folder.asked())
    skipped = Keys() if options.retry_failed else failed

    def plans() -> Iterator[ClipPlan]:
        return plans_of(clips_in(options.folder), settings, order, done, skipped)

    left = sum(len(plan.settings) for plan in plans())
    count = sum(1 for _ in names_in(options.folder))
    finished = count * len(settings) - left
    _say(options, f"{count} clips with {len(settings)} settings each: {left} tasks, {finished} are done already")
    threads = sum(client.nthreads().values())
    limit = options.in_flight or max(_IN_FLIGHT_LEAST, _IN_FLIGHT_PER_THREAD * threads)
    return Driver(client, folder, order, limit, Progress(left, options.quiet)).run(plans())


def _report(options: argparse.Namespace, folder: ResultsFolder) -> int:
    folder.fold()
    try:
        order = _order_of(options, folder, program_version())
    except ProgramMissingError:
        return _write(options, folder, None, None)
    with ThreadPoolExecutor(1) as executor:
        return _write(options, folder, order, executor.submit)


def _write(options: argparse.Namespace, folder: ResultsFolder, order: Order | None, submit: Submit | None) -> int:
    """Write report and failures; without a program the report has the pictures that are there."""
    tasks = current(folder.tasks(), asked_settings(folder.asked()))
    failed = folder.write_failures(tasks)
    title = Path(folder.asked()["folder"]).name
    report = write_report(folder, tasks, order, submit, ReportOptions(title, options.worst))
    print(report)
    if not failed:
        return COMPLETE
    print(f"fbs.corpus: {failed} tasks failed: {folder.path / 'failures.parquet'}", file=sys.stderr)
    return PARTIAL


def _say(options: argparse.Namespace, text: str) -> None:
    if not options.quiet:
        print(f"fbs.corpus: {text}", file=sys.stderr, flush=True)


def _order_of(options: argparse.Namespace, folder: ResultsFolder, version: str) -> Order:
    asked = folder.asked()  # a report alone is made with what the run was asked for
    return Order(
        program=version,
        results=None if options.through_client else str(folder.path),
        run=uuid.uuid4().hex,
        frames=asked["frames"],
        effort=asked["effort"],
        allow_no_face=asked["allow_no_face"],
        keep_streams=options.keep_streams,
        attempts=options.attempts,
        timeout_s=options.timeout,
        memory_bytes=options.task_memory,
    )
