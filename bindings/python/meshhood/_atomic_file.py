# SPDX-License-Identifier: MIT
"""Files that appear whole or not at all."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator
from typing import Any, Union

from . import _convert, _core


@contextlib.contextmanager
def atomic_file(path: Union[str, os.PathLike[str]]) -> Iterator[Any]:
    """A file to write that appears under `path` when the block ends, as `MeshIndex.save` writes its file. Raises OSError,
    with errno and filename; an old file is then unchanged."""
    writer = _core.FileWriter(_convert.path(path))
    try:
        yield writer
        writer.commit()
    finally:
        writer.close()
