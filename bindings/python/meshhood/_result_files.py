# SPDX-License-Identifier: MIT
"""The folder of results of a call of `distributed`, and its files."""

from __future__ import annotations

import contextlib
import errno
import fnmatch
import hashlib
import json
import os
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from . import _core

try:
    import fcntl
except ImportError:  # Windows: two calls are not kept apart
    fcntl = None  # type: ignore[assignment]

_RESULT = "result.json"
_LEFT = ".*.meshhood-*.tmp"  # of a file or store that is being written, or whose writer was killed


@contextlib.contextmanager
def result_folder(folder: str, described: dict[str, Any]) -> Iterator[str]:
    """Creates the folder, or checks that it has results of the same call. Meanwhile no other call writes into it. Yields
    what its files know of the call."""
    os.makedirs(folder, exist_ok=True)
    with _lock(folder):
        path = os.path.join(folder, _RESULT)
        if os.path.exists(path):
            _check_same(path, described)
        elif any(not fnmatch.fnmatchcase(name, _LEFT) for name in os.listdir(folder)):
            raise ValueError(f"{folder}: expected an empty folder, or one with results of the same call")
        else:
            with _core.FileWriter(path) as target:
                target.write(json.dumps(described, indent=1).encode())
        for left in Path(folder).glob(_LEFT):
            with contextlib.suppress(OSError):  # it is gone meanwhile, or open on Windows, and left to the next call
                _remove(left)
        yield _digest(folder)


def _remove(left: Path) -> None:
    """A task of a call that was stopped may still write. So a folder is renamed first, at once with all that it has."""
    if left.is_dir():
        shutil.rmtree(left.rename(f"{left}.tmp"))
    else:
        left.unlink()


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


class ResultFile(NamedTuple):
    """A file, or a store, of the results of a call."""

    path: str
    call: str

    @contextlib.contextmanager
    def writer(self) -> Iterator[Any]:
        with _core.FileWriter(self.path) as target:
            yield target
            self.check()

    def check(self) -> None:
        """Raises unless the folder has results of this call, before the file is synced and gets its name. If the call was
        stopped, another may have begun meanwhile in a new folder of the same name."""
        folder = os.path.dirname(self.path)
        if _digest(folder) != self.call:
            raise ValueError(f"{folder}: has results of another call")


def _digest(folder: str) -> str:
    """Of the description of the call, which may be long."""
    return hashlib.sha256(Path(folder, _RESULT).read_bytes()).hexdigest()


def _check_same(path: str, described: dict[str, Any]) -> None:
    try:
        with open(path, encoding="utf-8") as file:
            found = json.load(file)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None
    if found != described:
        different = [key for key in described if not isinstance(found, dict) or found.get(key) != described[key]]
        raise ValueError(f"{path}: the folder has results of another call, which differs in {', '.join(different)}")


def _save_npz(file: ResultFile, arrays: Any) -> None:
    import zipfile

    with file.writer() as target, zipfile.ZipFile(target, "w", zipfile.ZIP_STORED) as archive:
        for name, dtype, count, pieces in arrays:
            header = {"descr": np.dtype(dtype).str, "fortran_order": False, "shape": (count,)}
            with archive.open(f"{name}.npy", "w", force_zip64=True) as member:
                np.lib.format.write_array_header_1_0(member, header)
                for piece in pieces():
                    member.write(np.ascontiguousarray(piece, dtype).data)


def _save_zarr(file: ResultFile, arrays: Any) -> None:
    import zarr

    path = file.path
    folder = tempfile.mkdtemp(dir=os.path.dirname(path), prefix=f".{os.path.basename(path)}.meshhood-", suffix=".tmp")
    whole = Path(folder, "whole")
    try:
        whole.touch()
        group = zarr.open_group(os.path.join(folder, "zarr"), mode="w")
        for name, dtype, count, pieces in arrays:
            array = group.create_array(name, shape=(count,), dtype=np.dtype(dtype), chunks=(max(1, min(count, 2**20)),))
            begin = 0
            for piece in pieces():
                array[begin : begin + len(piece)] = piece
                begin += len(piece)
        file.check()
        whole.unlink()  # fails if another call has removed the folder, which zarr makes again, with the rest of the store
        os.rename(os.path.join(folder, "zarr"), path)
    except OSError as error:
        # A task of a call that failed may still have been running, and have written the same, whole.
        if error.errno not in (errno.EEXIST, errno.ENOTEMPTY) or not os.path.isdir(path):
            if error.filename is None:
                error.filename = path
            raise
    finally:
        shutil.rmtree(folder, ignore_errors=True)


SAVERS = {"npz": _save_npz, "zarr": _save_zarr}
