"""Futures in flight: never more than a limit, so that neither client nor scheduler grows with the corpus."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from distributed import Client, Future, as_completed


class Window:
    """Submits calls and gives back each when it has ended."""

    def __init__(self, client: Client, limit: int) -> None:
        self.limit = limit
        self._client = client
        self._ended = as_completed(loop=client.loop)
        self._tags: dict[Future, Any] = {}

    def __len__(self) -> int:
        return len(self._tags)

    @property
    def has_room(self) -> bool:
        return len(self._tags) < self.limit

    def submit(self, tag: object, key: str, function: Callable[..., object], *arguments: object) -> Future:
        """Submit a call whose end is waited for. A future among the arguments is replaced by its result."""
        future = self._client.submit(function, *arguments, key=key, pure=False)
        self._tags[future] = tag
        self._ended.add(future)
        return future

    def ended(self) -> Iterator[tuple[Any, Future]]:
        """Calls in the order in which they end, until none is left; others may be submitted meanwhile."""
        while self._tags:
            future = next(self._ended)
            yield self._tags.pop(future), future

    def cancel(self) -> None:
        self._client.cancel(list(self._tags), force=True)
        self._tags.clear()
