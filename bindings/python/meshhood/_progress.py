# SPDX-License-Identifier: MIT
"""Progress reports of long calls."""

from __future__ import annotations

import contextlib
import warnings
from collections.abc import Callable
from typing import Union

Progress = Union[bool, Callable[[int, int], object], None]


@contextlib.contextmanager
def reporter(progress):
    """The function that a long call reports its progress to, or None."""
    if progress is True:
        with _bar() as report:
            yield report
    elif progress is None or progress is False:
        yield None
    elif callable(progress):
        yield progress
    else:
        raise TypeError(f"progress: expected True or a function, not {type(progress).__name__}")


@contextlib.contextmanager
def _bar():
    try:
        from tqdm.auto import tqdm
    except ImportError:
        warnings.warn("progress=True needs tqdm, which is not installed", stacklevel=5)
        yield None
        return
    with tqdm() as bar:

        def report(done, total):
            bar.total = total
            bar.update(done - bar.n)

        yield report
