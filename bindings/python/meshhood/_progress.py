# SPDX-License-Identifier: MIT
"""Progress reports of long calls."""

from __future__ import annotations

import contextlib
import functools
import warnings
from collections.abc import Callable, Iterator
from typing import Any, Optional, Union

Progress = Union[bool, Callable[[int, int], object], None]
Report = Optional[Callable[[int, int], object]]


@contextlib.contextmanager
def reporter(progress: Progress, title: str, unit: str = "steps", count: Optional[int] = None) -> Iterator[Report]:
    """The function that a long call reports its progress to, or None. `title`, `unit`, and `count`, how many units
    there are, are those of a bar; without a count, a unit is a part of the call."""
    if progress is True:
        with _bar(title, unit, count) as report:
            yield report
    elif progress is None or isinstance(progress, bool) or callable(progress):
        yield progress if callable(progress) else None
    else:
        raise TypeError(f"progress: expected True or a function, not {type(progress).__name__}")


def in_parts(report: Report, count: int) -> list[Report]:
    """A function for each of `count` calls that follow each other: together they report from 0 to the end once."""
    if report is None or count == 1:
        return [report] * count
    return [functools.partial(_report_part, report, number, count) for number in range(count)]


def _report_part(report: Callable[[int, int], object], number: int, count: int, done: int, total: int) -> None:
    report(number * total + done, count * total)


@contextlib.contextmanager
def _bar(title: str, unit: str, count: Optional[int]) -> Iterator[Report]:
    try:
        from tqdm.auto import tqdm
    except ImportError:
        warnings.warn("progress=True needs tqdm, which is not installed: pip install tqdm", stacklevel=5)
        yield None
        return
    bar: Any
    with tqdm(desc=title, unit=f" {unit}", unit_scale=True) as bar:

        def report(done: int, total: int) -> None:
            bar.total = total if count is None else count
            bar.update((done if count is None or total == 0 else done * count // total) - bar.n)

        yield report
