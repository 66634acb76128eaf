# SPDX-License-Identifier: MIT
"""What an index holds, and what its queries have in common."""

from __future__ import annotations

import hashlib
import weakref
from types import FunctionType
from typing import TYPE_CHECKING, Any, Optional

import numpy as np

from . import _convert, _core
from ._curvature import normals_of
from ._instance import check_instance
from ._mesh import face_arrays, without_them
from ._methods import Methods, core_metric, is_exact

if TYPE_CHECKING:
    from typing_extensions import Self


class Held:
    """The base of the classes that make up `MeshIndex`."""

    def __init_subclass__(cls) -> None:
        if cls.__module__.startswith(f"{__package__}."):  # not what a user adds to a class of his own
            for name, member in vars(cls).items():
                function = getattr(member, "__func__", member)
                if isinstance(function, FunctionType):  # the error for an unknown argument, and a pickle, say this name
                    function.__module__, function.__qualname__ = f"{__package__}._index", f"MeshIndex.{name}"
                    if function is member and not name.startswith("_"):
                        check_instance(function)

    _exact: Any
    _faces: Any  # corners and offsets, as `face_arrays` returns them, or None
    _checked: bytes  # the key of the faces given last
    _methods: Methods
    _last_surface: tuple[Any, Any]  # the key of its faces, and the surface
    _before_refit: list[Any]  # at most one: the exact index, the key, its surface, and what has moved since
    _count: int
    _whole: Optional[Held]
    _no_position: Any  # the mask of the vertices without a position, or None
    _last_masked: Any  # walls, ignored, and the index of these masks
    _along_surface: Optional[Held]  # the index of metric="surface"

    def _hold(self, exact: Any, faces: Any, whole: Optional[Held] = None) -> None:
        """`whole`: of an index with masks, that without, which has what does not depend on them."""
        self._exact = exact
        self._faces = faces
        self._checked = b""
        self._whole = whole
        self._no_position = None
        self._last_masked = (None, None)
        self._along_surface = None
        self._methods = Methods(exact, None if whole is None else whole._methods)
        self._last_surface = (None, None)
        self._before_refit = []
        self._count = exact.vertex_count

    def _method(self, method: Any, metric: Any) -> Any:
        """What answers the queries of these arguments."""
        exact = is_exact(method)
        if metric == "straight":
            return self._methods[method]
        if not exact:
            raise ValueError(f"method: {method!r}, expected 'exact' with metric={metric!r}")
        return self._methods[core_metric(metric)]

    def _scale(self, unit: Any, metric: str = "straight") -> float:
        """The factor from `unit` to the unit of the positions."""
        if _convert.choice(unit, "unit", ("mesh", "edge")) == "mesh":
            return 1.0
        if metric == "rings":
            raise ValueError("unit: expected 'mesh' with metric='rings', whose radii are numbers of edges")
        length = self._methods.mean_edge_length
        if length == 0:
            raise ValueError("unit: 'edge', but the mesh has no edges of positive length")
        return length

    def _searched(self: Self, metric: str, walls: Any = None, ignored: Any = None) -> Self:
        """The index that a call searches, by the core metric that belongs to it."""
        index = self._with_masks(walls, ignored)
        return index._with_surface_paths() if metric == "surface" else index

    def _with_surface_paths(self: Self) -> Any:
        if self._along_surface is None:
            self._own_faces("metric: 'surface' measures along faces, but")
            whole = weakref.proxy(self) if self._whole is None else self._whole
            self._along_surface = self._derived(self._surface(None).paths(), whole)
        return self._along_surface

    def _with_masks(self: Self, walls: Any, ignored: Any) -> Self:
        """The index of these masks, the last of which is kept: a loop of calls with the same masks makes it once."""
        if walls is None and ignored is None:
            return self
        if self._no_position is not None:
            return self._whole._with_masks(self._all_walls(_convert.mask(walls, "walls", self._count)), ignored)
        if self._whole is not None:
            raise ValueError("walls, ignored: expected None, because this index has masks")
        masks = [_convert.mask(walls, "walls", self._count), _convert.mask(ignored, "ignored", self._count)]
        kept, index = self._last_masked
        if index is None or not all(map(_core.are_same_masks, kept, masks)):
            masks = [None if mask is None else mask.copy() for mask in masks]  # what is kept does not change
            index = self._masked(*masks, weakref.proxy(self))  # without a cycle
            self._last_masked = (masks, index)  # replaced as a whole: no lock, which a fork could copy while it is held
        return index

    def _hold_without(self, no_position: Any) -> None:
        """Makes the vertices without a position walls of all calls."""
        whole = self._derived(self._exact, None)
        self._hold(self._exact.masked(no_position.view(np.uint8), None), self._faces, whole)
        self._no_position = no_position

    def _placed(self, done: str) -> Any:
        """What is saved and refitted: an index of vertices that all have a position."""
        if self._no_position is not None:
            raise ValueError(f"an index with vertices without a position (NaN) is not {done}, {without_them('index')}")
        if self._whole is not None:
            raise ValueError(f"an index with masks is not {done}, expected the index that it was made from")
        return self._exact

    def _all_walls(self, walls: Any) -> Any:
        """`walls`, bytes or None, and the vertices without a position, as a bool mask."""
        return self._no_position if walls is None else walls.view(np.bool_) | self._no_position

    def _masked(self: Self, walls: Any, ignored: Any, whole: Any) -> Self:
        if self._no_position is not None:
            return self._whole._masked(self._all_walls(walls).view(np.uint8), ignored, self._whole)
        return self._derived(self._exact.masked(walls, ignored), whole)

    def _derived(self: Self, exact: Any, whole: Any) -> Self:
        index = type(self).__new__(type(self))
        index._hold(exact, self._faces, whole)
        return index

    def _places(self) -> Any:
        """The place of each vertex in index order."""
        places = np.empty(self._count, np.int32)
        places[self._exact.permutation] = np.arange(self._count, dtype=np.int32)
        return places

    def _face_arrays(self, F: Any, instead: str = "") -> tuple[Any, Any]:
        """Corners and offsets of `F`, or of the faces that the index keeps. `instead`: what else the call takes."""
        return self._keyed_faces(F, instead)[1]

    def _keyed_faces(self, F: Any, instead: str = "") -> tuple[bytes, tuple[Any, Any]]:
        """The same, and what tells them from other faces. Those of another mesh are refused."""
        if self._whole is not None:
            return self._whole._keyed_faces(F, instead)
        if F is None:
            return b"", self._own_faces(f"F: expected the faces{instead}, because")
        arrays = face_arrays(F)
        key = _digest(arrays)
        if key != self._checked:
            _core.check_faces(self._methods.graph(), arrays)
            self._checked = key
        return key, arrays

    def _own_faces(self, wish: str) -> tuple[Any, Any]:
        """Corners and offsets of the faces that the index keeps. `wish`: the beginning of the error if it has none."""
        if self._faces is None:
            raise ValueError(
                f"{wish} this index has none: it was built with keep_faces=False, from a graph or from points, or loaded "
                "from a file that was saved without faces=True"
            )
        return self._faces

    def _surface(self, F: Any, normals: Any = None, needs_faces: bool = False, instead: str = "") -> Any:
        """The surface of the faces, the last of which is kept, or one with these normals."""
        if normals is None:
            return self._surface_of(*self._keyed_faces(F, instead))
        if self._whole is not None:
            return self._whole._surface(F, normals, needs_faces).on(self._exact)
        if F is not None and not needs_faces:
            raise ValueError("F: expected None, because the normals are given")
        arrays = self._face_arrays(F) if needs_faces else None
        return _core.surface_of_normals(self._exact, normals_of(normals, self._count), arrays)

    def _surface_of(self, key: bytes, arrays: tuple[Any, Any]) -> Any:
        """The surface of faces, as `_keyed_faces` returns them."""
        kept, surface = self._last_surface
        if kept != key:
            if self._whole is not None:
                surface = self._whole._surface_of(key, arrays).on(self._exact)
            else:
                surface = self._refitted_surface(key) or _core.surface_of_faces(self._exact, arrays)
            self._last_surface = (key, surface)  # replaced as a whole: no lock, which a fork could copy while it is held
        return surface

    def _follow(self, before: Any, changed: Any) -> None:
        """Lets the surface of the index `before` be renewed where vertices have moved, when it is needed."""
        kept, surface = before._last_surface
        for exact, key, older, moved in [(before._exact, kept, surface, [])] if surface else before._before_refit:
            moved = np.concatenate([moved, changed]).astype(changed.dtype)
            if 4 * len(moved) <= self._count:
                self._before_refit = [(exact, key, older.on(exact), moved)]

    def _refitted_surface(self, key: bytes) -> Any:
        try:
            _, kept, surface, moved = self._before_refit.pop()  # for one thread alone
        except IndexError:
            return None
        if kept != key:
            return None
        surface.refit(self._exact, moved)
        return surface


def _digest(arrays: Any) -> bytes:
    digest = hashlib.blake2b(digest_size=16)
    for array in arrays:
        if array is not None:
            digest.update(f"{array.dtype} {len(array)};".encode())
            digest.update(array)
    return digest.digest()
