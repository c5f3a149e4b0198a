"""Where tasks run: on this machine, or on an existing Dask cluster."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator

from distributed import Client, LocalCluster

LOCAL = "local"


@contextlib.contextmanager
def connected(
    scheduler: str, *, workers: int | None = None, memory_limit: str = "auto", dashboard: str | None = None
) -> Iterator[Client]:
    """A client of the cluster.

    Parameters
    ----------
    scheduler : str
        Address of a scheduler, or "local": workers are started here, and end with the client.
    workers : int, optional
        Processes of a local cluster, one for each core unless given. Each runs one task at a time, since a task is
        a program of its own.
    memory_limit : str
        Of a local worker without the programs that it runs.
    dashboard : str, optional
        Address of the dashboard of a local cluster, such as ":8787".
    """
    if scheduler != LOCAL:
        with Client(scheduler, set_as_default=False) as client:
            yield client
        return
    # A worker that is killed is started again; its task counts for itself (attempt.py).
    with (
        LocalCluster(
            n_workers=workers,
            threads_per_worker=1,
            processes=True,
            memory_limit=memory_limit,
            dashboard_address=dashboard or "127.0.0.1:0",
        ) as cluster,
        Client(cluster, set_as_default=False) as client,
    ):
        yield client
