# SPDX-License-Identifier: MIT
"""Checks and converts the arguments of queries. Errors name the argument. What is not checked here, the C++ library
checks."""

import operator
import os
from collections.abc import Iterable

import numpy as np

from ._memory import free_bytes

_MOST_THREADS = 1024


def vertices(v, count, name="vertices", single=""):
    """`v` as a new int32 array in C order, each value in [0, count). `v` may be a bool mask of `count` values; a mask of
    numbers is refused, but not a list or tuple: no file or image has a mask as these. `single`: what an error says of a
    call that takes one vertex, too."""
    if not isinstance(v, (list, tuple)):
        _refuse_mask_of_numbers(as_array(v, name), count, name)
    return vertex_rows(v, count, name, single)


def _refuse_mask_of_numbers(array, count, name):
    """Numbers for all vertices that are 0, or one other: as images and files have masks."""
    if array.dtype.kind not in "iuf" or array.shape != (count,) or count <= 2:
        return
    most = max(array.max(), 1)
    if (most == 1 or array.min() == 0) and np.all((array == 0) | (array == most)):
        raise TypeError(
            f"{name}: {count} numbers 0 or {most:g}, expected vertices, or a bool mask: "
            f"{name} == {most:g}; such vertices as a list: {name}.tolist()"
        )


def vertex_rows(v, count, name, single=""):
    """The same where a vertex may occur any number of times."""
    return _numbers_of(v, count, name, "vertex", "vertices", single).astype(np.int32, copy=False)


def faces(f, count, name):
    """The same for faces, as an int64 array."""
    return _numbers_of(f, count, name, "face", "faces").astype(np.int64, copy=False)


def faces_of_points(face, points, count):
    """The same, one for each of the points; a single one may be an integer."""
    numbered = faces(listed(face, "face"), count, "face")
    if len(numbered) != points:
        raise ValueError(f"face: expected one for each of {points} points, not {len(numbered)}")
    return numbered


def numbers(values, name, kinds="iuf"):
    """`values` as an array of numbers, not copied."""
    array = as_array(values, name)
    if array.dtype.kind not in kinds:
        raise TypeError(f"{name}: expected numbers, not {array.dtype}")
    return array


def as_float32(array, name, place):
    """Numbers of vertices as float32 in C order; NaN and inf stay. `place`: what will hold them."""
    if array.dtype.kind == "f" and array.itemsize > 4:  # others are not larger, and need no memory for a check
        most = np.finfo(np.float32).max
        beyond = np.argwhere(np.isfinite(array) & (np.abs(array) > most))
        if beyond.size:
            at = tuple(beyond[0])
            raise ValueError(f"{name}: vertex {at[0]}: {array[at]}, but {place} holds numbers of at most {most:.3g}")
    return np.ascontiguousarray(array, np.float32)


def _numbers_of(values, count, name, one, many, single=""):
    """The result is a copy even if `values` already have the type of ids: another thread, or a `progress` function, may
    write to them during the call."""
    array = np.array(_ids(values, name))
    if array.dtype.kind == "b" and array.ndim:
        if array.shape != (count,):
            raise ValueError(f"{name}: a bool mask of shape {array.shape}, expected ({count},)")
        array = np.flatnonzero(array)
    if array.dtype.kind not in "iu":
        points = array.dtype.kind == "f" and array.ndim == 2 and array.shape[1] == 3
        hint = "; a point is the start of `neighborhood(point, r)`" if points else ""
        raise TypeError(f"{name}: expected integers, not {array.dtype}{hint}")
    if array.ndim == 0:
        raise ValueError(f"{name}: one {one}, expected a list of {many}: [{array}]")
    if array.ndim != 1:
        hint = "; faces are passed as F=" if array.ndim == 2 and array.shape[1] in (3, 4) else ""
        if isinstance(values, tuple) and all(isinstance(part, np.ndarray) for part in values):
            hint = "; np.where(mask) is a tuple of arrays, np.flatnonzero(mask) the list"
        expected = f"{single}a list of {many}, or a bool mask of {count}"
        raise ValueError(f"{name}: expected {expected}, not an array of shape {array.shape}{hint}")
    wrong = np.flatnonzero((array < 0) | (array >= count))
    if wrong.size:
        raise ValueError(f"{name}: row {wrong[0]}: {one} {array[wrong[0]]}, but the mesh has {count} {many}")
    return array


def vertex(v, count, name="vertices"):
    """`v` as an int in [0, count)."""
    if type(v) is not int:
        v = _integer(v, name)
    if not 0 <= v < count:
        raise ValueError(f"{name}: vertex {v}, but the mesh has {count} vertices")
    return v


def is_single(values, name):
    """Whether they are one, as an integer is, rather than a list."""
    return isinstance(values, (int, np.integer)) or as_array(values, name).ndim == 0


def is_point(values, name):
    """Whether they are one point, of those that `points` takes."""
    array = as_array(values, name)
    return array.ndim == 1 and array.size > 0


def listed(values, name):
    """`values`, or an array of it if it is a single one."""
    return as_array(values, name).reshape(1) if is_single(values, name) else values


def one_or_many(v, count):
    """Whether `v` is one vertex, and an array of it or of many."""
    is_one = is_single(v, "vertices")
    if is_one:
        return True, np.array([vertex(v, count)], np.int32)
    return False, vertices(v, count, single="one vertex, ")


def refuse_one(v, count, instead=""):
    """Refuses one vertex where each row is a list, or a row of a matrix. `instead`: what answers one."""
    dimensions = 1 if v is None else as_array(v, "vertices").ndim
    if dimensions == 0:
        raise TypeError(f"vertices: one vertex, expected a list: [{vertex(v, count)}]{instead}")
    if dimensions > 1:
        vertices(v, count)  # refused here, or the error would say that one vertex is taken


def radius(r, name="r"):
    """`r`, one number, as a float >= 0."""
    if r is None:
        raise TypeError(f"{name}: missing, expected a radius")
    if not isinstance(r, float):
        r = _number(r, name)
    if not r >= 0:
        raise ValueError(f"{name}: radius {r}, expected a number >= 0")
    return r


def radii(r, rows, name="r", advice="; several radii for all rows are scales="):
    """`r` as a float, or as a new float64 array in C order with one radius for each row. All are >= 0. `advice` ends
    the error for another shape."""
    array = np.array(as_array(r, name))
    if array.ndim == 0:
        return radius(array, name)
    array = numbers(array, name)
    if array.shape != (rows,):
        raise ValueError(
            f"{name}: expected one number, or one for each of {rows} rows, not an array of shape {array.shape}{advice}"
        )
    check_radii(array, name, "row")
    return array.astype(np.float64, copy=False)


def check_radii(array, name, row):
    """`row`: what the radii are numbered as."""
    wrong = np.flatnonzero(~(array >= 0))
    if wrong.size:
        raise ValueError(f"{name}: {row} {wrong[0]}: radius {array[wrong[0]]}, expected a number >= 0")


def ascending(values, name):
    """`values` as a new float64 array of radii, each larger than the one before."""
    array = numbers(values, name)
    if array.ndim != 1:
        raise ValueError(f"{name}: expected one dimension, not an array of shape {array.shape}")
    array = array.astype(np.float64)
    is_larger = array[1:] > array[:-1]
    if not ((array[:1] >= 0).all() and is_larger.all()):
        check_radii(array, name, "value")
        at = int(np.argmin(is_larger))
        before, value = array[at : at + 2]
        raise ValueError(f"{name}: value {at + 1}: radius {value}, expected more than {before} before it")
    return array


def points(values, name, advice=""):
    """`values`, one point or (n, 3), as a new float64 array (n, 3) of finite numbers. `advice` ends the error if not."""
    array = np.array(numbers(values, name))
    if array.ndim == 1 and array.size == 0:
        array = array.reshape(0, 3)
    if array.ndim not in (1, 2) or array.shape[-1] != 3:
        raise ValueError(f"{name}: expected 3 numbers or an array (n, 3), not an array of shape {array.shape}")
    array = np.ascontiguousarray(array.reshape(-1, 3), dtype=np.float64)
    wrong = np.argwhere(~(np.abs(array) <= 2.0**500))
    if wrong.size:
        row, axis = wrong[0]
        raise ValueError(
            f"{name}: row {row}: coordinate {axis} is {array[row, axis]}, "
            f"expected a finite number of magnitude up to 2^500{advice}"
        )
    return array


def point(value, name, meant):
    """`value`, 3 numbers, as a new float64 array (1, 3), where a vertex would do too. Integers are refused: they may be
    vertices. `meant`: the call for several vertices."""
    given = as_array(value, name)
    if given.dtype.kind in "iu" and given.size:
        raise TypeError(
            f"{name}: integers of shape {given.shape}, expected a vertex, or a point as 3 floats; for vertices: {meant}"
        )
    array = points(given, name, "; a ray that meets nothing has face -1 and no point")
    if len(array) != 1 or given.ndim != 1:
        raise ValueError(f"{name}: expected a vertex or 3 numbers, not an array of shape {given.shape}")
    return array


def seed_rows(values, rows, count):
    """`values`, (rows,) or (rows, k), as a new int32 array (rows, k), each value in [0, count)."""
    given = np.array(_ids(values, "seeds"))
    array = given.reshape(-1, 1) if given.ndim == 1 else given
    if array.ndim != 2 or len(array) != rows:
        raise ValueError(f"seeds: expected ({rows},) or ({rows}, k), not an array of shape {given.shape}")
    return vertex_rows(array.reshape(-1), count, "seeds").reshape(array.shape)


def integers(values, name):
    """`values` as a new array of 32 or 64 bits in C order. A copy, because another thread may write to `values` after
    they are checked."""
    array = _ids(values, name)
    if array.dtype.kind not in "iu":
        raise TypeError(f"{name}: expected integers, not {array.dtype}")
    if array.dtype.itemsize < 4:
        array = array.astype(np.int32)
    return np.array(array, order="C")


def edges(values, name):
    """`values`, (n, 2), as a new flat array of integers; None if there are none."""
    if values is None:
        return None
    array = integers(values, name)
    if array.size == 0 and not isinstance(values, np.ndarray):
        array = array.reshape(0, 2)
    if array.ndim != 2 or array.shape[1] != 2:
        raise ValueError(f"{name}: expected an array (n, 2), not one of shape {array.shape}")
    return array.ravel()


def mask(values, name, count):
    """`values`, a bool mask of `count` values or a sequence of vertices, as bytes; None if there is none. A mask is not
    copied: the library reads each byte by itself."""
    if values is None:
        return None
    array = as_array(values, name)
    if array.dtype != np.bool_:
        chosen = np.zeros(count, np.uint8)
        chosen[vertices(values, count, name)] = 1  # not `array`: an empty list has no integers
        return chosen
    if array.shape != (count,):
        raise ValueError(f"{name}: a bool mask of shape {array.shape}, expected ({count},)")
    return np.ascontiguousarray(array).view(np.uint8)


def threads(workers):
    """`workers` as the C++ library counts threads: 0 for all processors."""
    workers = _integer(workers, "workers")
    if workers == -1:
        return 0
    if not 1 <= workers <= _MOST_THREADS:
        raise ValueError(f"workers: {workers}, expected -1 for all processors or 1 to {_MOST_THREADS}")
    return workers


def max_bytes(value, most, copies=1):
    """`value`, or for None what fits `copies` times into the memory that this process may still take. `most`: the bytes
    that the result has at most. To read the free memory takes longer than a small call."""
    if value is not None:
        return integer(value, "max_bytes", 0, 2**64 - 1)
    return 2**20 if most < 2**20 else free_bytes() // copies


def path(value, name="path"):
    """`value` as str or bytes. Calls `__fspath__` here, because Python code must not run below C++ functions."""
    if not isinstance(value, (str, bytes, os.PathLike)):
        raise TypeError(f"{name}: expected a path, not {type(value).__name__}")
    value = os.fspath(value)
    if ("\0" if isinstance(value, str) else b"\0") in value:
        raise ValueError(f"{name}: {value!r} has a null byte")
    return value


def absolute(value, name):
    """The path as an absolute str."""
    return os.path.abspath(os.fsdecode(path(value, name)))


def choice(value, name, choices):
    """`value`, one of `choices`."""
    if not isinstance(value, str) or value not in choices:
        raise ValueError(f"{name}: {value!r}, expected {' or '.join(map(repr, choices))}")
    return value


def some_choices(values, name, choices):
    """One name of `choices`, or several, as a tuple."""
    if isinstance(values, str):
        return (choice(values, name, choices),)
    if not isinstance(values, Iterable):
        raise TypeError(f"{name}: expected a name or several, not {type(values).__name__}")
    found = tuple(choice(value, name, choices) for value in values)
    if not found:
        raise ValueError(f"{name}: there are none, expected at least one")
    return found


def real_type(dtype):
    try:
        found = np.dtype(dtype)
    except TypeError:
        raise TypeError(f"dtype: {dtype!r}, expected float32 or float64") from None
    if found not in (np.float32, np.float64):
        raise ValueError(f"dtype: {found}, expected float32 or float64")
    return found


def integer(value, name, lowest=1, highest=2**63 - 1):
    value = _integer(value, name)
    if not lowest <= value <= highest:
        expected = f"at least {lowest}" if value < lowest and highest >= 2**63 - 1 else f"{lowest} to {highest}"
        raise ValueError(f"{name}: {value}, expected {expected}")
    return value


def finite(value, name, *, or_zero):
    """`value` as a finite float > 0, or >= 0."""
    value = _number(value, name)
    if not (0 < value < np.inf or (or_zero and value == 0)):
        raise ValueError(f"{name}: {value}, expected a finite number {'>=' if or_zero else '>'} 0")
    return value


def share(value, name):
    """`value` as a float from 0 to 1."""
    value = _number(value, name)
    if not 0 <= value <= 1:
        raise ValueError(f"{name}: {value}, expected 0 to 1")
    return value


def _integer(value, name):
    if isinstance(value, (bool, np.bool_)):  # a subclass of int; older NumPy converts its own with a warning
        raise TypeError(f"{name}: expected an integer, not bool")
    try:
        return operator.index(value)
    except TypeError:
        if _has_only_dlpack(value):
            return _integer(as_array(value, name), name)
        is_one = isinstance(value, np.ndarray) and value.ndim == 0
        raise TypeError(f"{name}: expected an integer, not {value.dtype if is_one else type(value).__name__}") from None


def _number(value, name):
    array = as_array(value, name)
    if array.dtype.kind not in "iuf":
        raise TypeError(f"{name}: expected a number, not {array.dtype}")
    if array.ndim != 0:
        raise ValueError(f"{name}: expected one number, not an array of shape {array.shape}")
    return float(array)


def _ids(values, name):
    """`values` as an array, which for an empty list has the type of ids instead of NumPy's float64."""
    array = as_array(values, name)
    return array.astype(np.int32) if array.size == 0 and not isinstance(values, np.ndarray) else array


def as_array(values, name):
    """`values` as an array in the byte order of this machine."""
    if np.ma.is_masked(values):
        raise TypeError(f"{name}: has masked elements")
    try:
        array = np.from_dlpack(values) if _has_only_dlpack(values) else np.asarray(values)
    except (ValueError, BufferError) as error:
        is_ragged = "inhomogeneous" in str(error)
        raise ValueError(f"{name}: {'rows of different lengths' if is_ragged else error}") from None
    except (TypeError, RuntimeError) as error:  # a tensor on another device, or one that needs a gradient
        raise TypeError(f"{name}: {error}") from None
    if array.dtype.kind in "US":
        raise TypeError(f"{name}: text, expected a number")
    if array.dtype.kind in "iuf" and isinstance(values, (list, tuple)) and _holds_bool(values):
        raise TypeError(f"{name}: has values of type bool among the numbers")
    return array if array.dtype.isnative else array.astype(array.dtype.newbyteorder("="))


def _has_only_dlpack(values):
    """Whether DLPack is the only protocol by which `values` offers its memory. The protocols of NumPy keep more
    types."""
    others = ("__array__", "__array_interface__", "__array_struct__")
    return hasattr(values, "__dlpack__") and not any(hasattr(values, name) for name in others)


def _holds_bool(values):
    """Whether `values` has bools, which NumPy would convert to 1 and 0 among numbers."""
    return any(isinstance(value, (bool, np.bool_)) for value in values)
