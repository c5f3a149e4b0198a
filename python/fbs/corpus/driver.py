"""Drives a run: submits tasks while there is room, keeps results, retries lost tasks."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from concurrent.futures import CancelledError
from dataclasses import dataclass

from distributed import Client, Future, KilledWorker

from fbs.corpus import task
from fbs.corpus.order import Order
from fbs.corpus.plan import ClipPlan
from fbs.corpus.result import Result
from fbs.corpus.results_folder import ResultsFolder
from fbs.corpus.setting import Setting
from fbs.corpus.window import Window, unique_key

FOLD_AT = 10_000
"""Finished tasks that are folded into a part of the tables: fewer files against more memory of the client."""


@dataclass(eq=False)
class _OpenClip:
    """A clip with tasks in flight."""

    plan: ClipPlan
    left: int
    reference: Future | None = None


@dataclass
class _Task:
    clip: _OpenClip
    setting: Setting
    tries: int = 1
    """So often it was given to the cluster."""


@dataclass
class Tally:
    """Counts of the results so far."""

    done: int = 0
    failed: int = 0
    lost: int = 0
    """So often the cluster gave up a task whose workers had been killed, and was given it again."""


class Driver:
    """Runs plans on a cluster.

    Parameters
    ----------
    limit : int
        Tasks in flight.
    on_result : callable
        Called with the tally after each result.
    """

    def __init__(
        self,
        client: Client,
        folder: ResultsFolder,
        order: Order,
        limit: int,
        on_result: Callable[[Tally], None] = lambda tally: None,
    ) -> None:
        self.tally = Tally()
        self._folder = folder
        self._order = order
        self._on_result = on_result
        self._window = Window(client, limit)
        self._client = client
        self._handled: list[str] = []

    def run(self, plans: Iterator[ClipPlan]) -> Tally:
        """Do all plans. Whatever leaves this early cancels what is in flight."""
        try:
            self._fill(plans)
            for one, result, problem in self._window.ended():
                self._take(one, result, problem)
                self._fill(plans)
        except BaseException:
            self._window.cancel()
            raise
        self._fold()
        return self.tally

    def _fill(self, plans: Iterator[ClipPlan]) -> None:
        """A clip is begun as a whole, so the limit is passed by the tasks of one clip at most."""
        while self._window.has_room and (plan := next(plans, None)):
            clip = _OpenClip(plan, len(plan.settings))
            self._submit(clip, [_Task(clip, setting) for setting in plan.settings])

    def _submit(self, clip: _OpenClip, tasks: list[_Task]) -> None:
        plan, order = clip.plan, self._order
        if clip.reference is None:
            key = unique_key("make_reference")
            clip.reference = self._client.submit(
                task.make_reference, plan.clip, plan.reference, order, key=key, pure=False
            )
        settings = [one.setting for one in tasks]
        self._window.submit(tasks, task.measure, settings, clip=plan.clip, order=order, reference=clip.reference)

    def _take(self, one: _Task, result: Result | None, problem: BaseException | None) -> None:
        if isinstance(problem, KilledWorker | CancelledError):
            if one.tries < self._order.attempts:
                self.tally.lost += 1
                self._try_again(one)
                return
            result = self._give_up(one, f"the workers that had it were killed, {one.tries} times")
        elif problem is not None:  # a bug, ours or of the machine: one clip must not stop a million
            result = self._give_up(one, f"{type(problem).__name__}: {problem}")
        assert result is not None
        self._keep(one, result)

    def _try_again(self, one: _Task) -> None:
        """Dask gives up a task when workers that had it died too often, even if another task was the cause."""
        one.tries += 1
        reference = one.clip.reference
        if reference is not None and reference.status not in ("finished", "pending"):
            one.clip.reference = None
        self._submit(one.clip, [one])

    def _give_up(self, one: _Task, error: str) -> Result:
        return task.failed_result(one.clip.plan.clip, one.setting, self._order, error, one.tries)

    def _keep(self, one: _Task, result: Result) -> None:
        if self._order.results is None or "host" not in result.task:  # no worker has written it
            self._folder.keep(result)
        self._handled.append(result.key)
        self.tally.done += 1
        self.tally.failed += result.failed
        one.clip.left -= 1
        if one.clip.left == 0:
            self._close(one.clip)
        if len(self._handled) >= FOLD_AT:
            self._fold()
        self._on_result(self.tally)

    def _close(self, clip: _OpenClip) -> None:
        if clip.reference is not None:
            clip.reference.release()
        if not self._order.keep_streams:
            self._folder.drop_streams(clip.plan.clip.key)

    def _fold(self) -> None:
        self._folder.fold(self._handled)
        self._handled.clear()
