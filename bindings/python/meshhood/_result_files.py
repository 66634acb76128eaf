# SPDX-License-Identifier: MIT
"""The folder of results of a call of `distributed`, and its files."""

from __future__ import annotations

import contextlib
import errno
import json
import os
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from . import _core

try:
    import fcntl
except ImportError:  # Windows: two calls are not kept apart
    fcntl = None  # type: ignore[assignment]

_RESULT = "result.json"


@contextlib.contextmanager
def result_folder(folder: str, described: dict[str, Any]) -> Iterator[None]:
    """Creates the folder, or checks that it has results of the same call. Meanwhile no other call writes into it."""
    os.makedirs(folder, exist_ok=True)
    with _lock(folder):
        path = os.path.join(folder, _RESULT)
        if os.path.exists(path):
            _check_same(path, described)
        elif os.listdir(folder):
            raise ValueError(f"{folder}: expected an empty folder, or one with results of the same call")
        else:
            with _core.FileWriter(path) as target:
                target.write(json.dumps(described, indent=1).encode())
        for left in Path(folder).glob(".*.tmp"):  # of a worker that was killed
            shutil.rmtree(left) if left.is_dir() else left.unlink()
        yield


@contextlib.contextmanager
def _lock(folder: str) -> Iterator[None]:
    """Locks the folder. The system releases the lock when the process ends, in whatever way."""
    if fcntl is None:
        yield
        return
    descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise BlockingIOError(error.errno, "another call writes into this folder", folder) from None
        try:
            yield
        finally:  # if the file were only closed, a child forked meanwhile would keep the lock
            fcntl.flock(descriptor, fcntl.LOCK_UN)
    finally:
        os.close(descriptor)


def _check_same(path: str, described: dict[str, Any]) -> None:
    try:
        with open(path, encoding="utf-8") as file:
            found = json.load(file)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None
    if found != described:
        different = [key for key in described if not isinstance(found, dict) or found.get(key) != described[key]]
        raise ValueError(f"{path}: the folder has results of another call, which differs in {', '.join(different)}")


def _save_npz(path: str, arrays: Any) -> None:
    import zipfile

    with _core.FileWriter(path) as target, zipfile.ZipFile(target, "w", zipfile.ZIP_STORED) as archive:
        for name, dtype, count, pieces in arrays:
            header = {"descr": np.dtype(dtype).str, "fortran_order": False, "shape": (count,)}
            with archive.open(f"{name}.npy", "w", force_zip64=True) as member:
                np.lib.format.write_array_header_1_0(member, header)
                for piece in pieces():
                    member.write(np.ascontiguousarray(piece, dtype).data)


def _save_zarr(path: str, arrays: Any) -> None:
    import zarr

    folder = tempfile.mkdtemp(dir=os.path.dirname(path), prefix=".", suffix=".tmp")
    try:
        group = zarr.open_group(os.path.join(folder, "zarr"), mode="w")
        for name, dtype, count, pieces in arrays:
            array = group.create_array(name, shape=(count,), dtype=np.dtype(dtype), chunks=(max(1, min(count, 2**20)),))
            begin = 0
            for piece in pieces():
                array[begin : begin + len(piece)] = piece
                begin += len(piece)
        os.rename(os.path.join(folder, "zarr"), path)
    except OSError as error:
        # A task of a call that failed may still have been running, and have written the same.
        if error.errno not in (errno.EEXIST, errno.ENOTEMPTY) or not os.path.isdir(path):
            if error.filename is None:
                error.filename = path
            raise
    finally:
        shutil.rmtree(folder, ignore_errors=True)


SAVERS = {"npz": _save_npz, "zarr": _save_zarr}
