# SPDX-License-Identifier: MIT
"""Files that appear whole or not at all."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator
from typing import Any, Union

import numpy as np

from . import _convert, _core


class _File:
    """What NumPy and zipfile need to write to, in bytes."""

    def __init__(self, writer: Any) -> None:
        self._writer = writer

    def write(self, data: Any) -> int:
        size = memoryview(data).nbytes
        if size:
            self._writer.write(np.frombuffer(data, np.uint8))
        return size

    def tell(self) -> int:
        return self._writer.position

    def seek(self, position: int) -> None:
        self._writer.seek(position)

    def flush(self) -> None:
        pass


@contextlib.contextmanager
def atomic_file(path: Union[str, os.PathLike[str]]) -> Iterator[_File]:
    """A file to write that appears under `path` when the block ends, as `MeshIndex.save` writes its file. Raises OSError,
    with errno and filename; an old file is then unchanged."""
    writer = _core.FileWriter(_convert.path(path))
    try:
        yield _File(writer)
        writer.commit()
    finally:
        writer.close()
