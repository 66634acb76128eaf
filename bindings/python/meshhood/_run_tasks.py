# SPDX-License-Identifier: MIT
"""Runs tasks on the threads of this machine, or on the cluster of the current `dask.distributed.Client`."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ._optional import optional
from ._progress import Progress, reporter


def run_all(tasks: list[tuple[Callable[[Any], Any], Any]], progress: Progress) -> list[Any]:
    """The results of `function(argument)` for all tasks: on the cluster of the current client, else on threads."""
    client = _client()
    with reporter(progress, "parts", "tasks") as report:
        if report:
            report(0, len(tasks))
        if client is None:
            return _run_here(tasks, report)
        return _run_on(client, tasks, report)


def _client() -> Any:
    try:
        from distributed import get_client
    except ImportError:
        return None
    try:
        return get_client()
    except ValueError:
        return None


def _run_here(tasks: Any, report: Any) -> list[Any]:
    dask = optional("dask", "a task for each part")
    from dask.callbacks import Callback

    class Count(Callback):
        done = 0

        def _posttask(self, *_: Any) -> None:
            Count.done += 1
            if report:
                report(min(Count.done, len(tasks)), len(tasks))

    with Count():
        return list(dask.compute(*(dask.delayed(function)(argument) for function, argument in tasks)))


def _run_on(client: Any, tasks: Any, report: Any) -> list[Any]:
    from distributed import as_completed

    futures = [client.submit(function, argument, pure=False) for function, argument in tasks]
    try:
        for done, _ in enumerate(as_completed(futures), 1):
            if report:
                report(done, len(tasks))
        return list(client.gather(futures))
    finally:
        client.cancel(futures)
