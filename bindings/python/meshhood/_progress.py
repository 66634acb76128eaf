# SPDX-License-Identifier: MIT
"""What watches a long call."""

from __future__ import annotations

import contextlib
import warnings
from collections.abc import Callable
from typing import Union

Progress = Union[bool, Callable[[int, int], object], None]


@contextlib.contextmanager
def watcher(progress):
    """None, or a function of how many of how many equal parts are done."""
    if progress is True:
        with _bar() as watch:
            yield watch
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

        def watch(done, total):
            bar.total = total
            bar.update(done - bar.n)

        yield watch
