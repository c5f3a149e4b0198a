"""Futures in flight: never many more than a limit, so that neither client nor scheduler grows with the corpus."""

from __future__ import annotations

import time
import uuid
from collections.abc import Callable, Iterator
from concurrent.futures import CancelledError
from typing import Any

from distributed import Client, Future, as_completed

_PATIENCE_S = 0.01
"""Between two looks for calls that have ended."""


class Window:
    """Submits calls, and gives back each when it has ended."""

    def __init__(self, client: Client, limit: int) -> None:
        self.limit = limit
        self._client = client
        # Results come along, many in a message: asking for each by itself takes longer than all the rest.
        self._ended = as_completed(loop=client.loop, with_results=True, raise_errors=False)
        self._tags: dict[Future, Any] = {}

    def __len__(self) -> int:
        return len(self._tags)

    @property
    def has_room(self) -> bool:
        return len(self._tags) < self.limit

    def submit(self, tags: list[Any], function: Callable[..., object], *arguments: list[Any], **shared: Any) -> None:
        """Submit a call for each tag, all in one message.

        Parameters
        ----------
        arguments : list
            Each has one value for each call.
        shared
            Arguments that all calls have. A future among them is replaced by its result.
        """
        keys = [unique_key(function.__name__) for _ in tags]
        futures = self._client.map(function, *arguments, key=keys, pure=False, **shared)
        self._tags.update(zip(futures, tags, strict=True))
        self._ended.update(futures)

    def ended(self) -> Iterator[tuple[Any, Any, BaseException | None]]:
        """Calls in the order in which they end, until none is left; others may be submitted meanwhile.

        Yields
        ------
        tag, value, problem
            What a call gave, or the exception that took its place; CancelledError where the cluster lost it.

        Raises
        ------
        ConnectionError
            The client has not found the scheduler for half a minute.
        """
        while self._tags:
            batch = self._ended.next_batch(block=False)
            if self._client.status in ("closing", "closed"):
                raise ConnectionError("the scheduler is gone; the same command goes on from there with another")
            if not batch:
                time.sleep(_PATIENCE_S)
            for future, value in batch:
                status = future.status
                tag = self._tags.pop(future)
                future.release()
                if status == "finished":
                    yield tag, value, None
                else:
                    yield tag, None, value[1] if status == "error" else CancelledError(status)

    def cancel(self) -> None:
        """Forget what has not ended, and stop it where it has not begun."""
        if self._client.status == "running":
            self._client.cancel(list(self._tags), force=True)
        self._tags.clear()


def unique_key(name: str) -> str:
    """A key of Dask: nothing of an earlier client is mistaken for it."""
    return f"{name}-{uuid.uuid4().hex}"
