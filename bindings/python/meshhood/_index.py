# SPDX-License-Identifier: MIT
"""The index, as SciPy would have it."""

from __future__ import annotations

import os
import pickle
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _convert, _core
from ._mesh import mesh_arrays
from ._methods import Method, Methods
from ._progress import Progress, watcher

if TYPE_CHECKING:
    from scipy.sparse import csr_array

Ids = NDArray[np.int32]
Vertices = Union[int, ArrayLike, None]
Radius = Union[float, ArrayLike]


class Chunk(NamedTuple):
    """Some rows of all neighborhoods: row i is that of vertices[i] (see `MeshIndex.query_ball`)."""

    vertices: Ids
    indptr: NDArray[np.int64]
    indices: Ids
    distances: Optional[NDArray[np.float64]]


class MeshIndex:
    """Neighborhoods on a mesh: what lies within a distance of a vertex *and* hangs together with it there.

    V : (#V, 3) float32 or float64, the positions, in any unit. Or a mesh of trimesh, PyVista or meshio, F left out.
    F : the faces, of any integer type; one of
        (#F, 3) triangles, (#F, 4) quads, (#F, k);
        a tuple (offsets, corners): polygon i has the corners corners[offsets[i]:offsets[i + 1]];
        one dimension, VTK's padded faces: the number of corners before each face;
        a scipy.sparse matrix (#V, #V): a graph, every stored entry an edge, in either direction, whatever its value.
    workers : threads, -1 for all processors. The index does not depend on it.
    progress : True for a bar of tqdm, or a function called with how many of how many equal parts are done; what it
        raises ends the call.

    Vertices are int32, in the numbering of V, and at most 2^31 - 1. V and F are copied, and may change afterwards, but
    must not during the call; before that they are converted only where they are not in C order, of another byte order,
    or of a type that is not read as it is (float32, float64; int32, int64, uint32, uint64).

    Immutable. Any number of threads may ask at the same time; the interpreter lock is released. It can be saved, and
    pickled as the same bytes. Every method raises ValueError or TypeError, naming the argument and the element, and
    KeyboardInterrupt on Ctrl-C.
    """

    def __init__(self, V: Any, F: Any = None, *, workers: int = -1, progress: Progress = None):
        positions, corners, offsets = mesh_arrays(V, F)
        threads = _convert.threads(workers)
        with watcher(progress) as watch:
            self._hold(_core.exact(positions, corners, offsets=offsets, threads=threads, progress=watch))

    @classmethod
    def _holding(cls, exact):
        self = cls.__new__(cls)
        self._hold(exact)
        return self

    def _hold(self, exact):
        self._exact = exact
        self._methods = Methods(exact)
        self._count = exact.vertex_count

    def __len__(self) -> int:
        """#V."""
        return self._count

    def __repr__(self) -> str:
        return f"<meshhood.MeshIndex of {self._count} vertices>"

    def __reduce_ex__(self, protocol: int) -> tuple:
        """The bytes of an index file, verified when they are loaded. With protocol 5 they may travel out of band."""
        saved = _core.to_bytes(self._exact)
        return _unpickled, (type(self), pickle.PickleBuffer(saved) if protocol >= 5 else saved.tobytes())

    def __copy__(self) -> MeshIndex:
        return self

    def __deepcopy__(self, memo: dict) -> MeshIndex:
        return self

    @property
    def nbytes(self) -> int:
        """Memory of the index, in bytes, its copy of the positions included. What other methods need comes on top."""
        return self._exact.nbytes

    @property
    def permutation(self) -> Ids:
        """The vertices in index order: (#V,) int32, read-only, not copied. Outlives the index."""
        return self._exact.permutation

    def query_ball(
        self,
        v: Vertices,
        r: Radius,
        *,
        return_distance: bool = False,
        sort: bool = False,
        method: Method = "exact",
        workers: int = -1,
        progress: Progress = None,
    ) -> Any:
        """The vertices of the neighborhood of each `v`, itself included.

        v : a vertex, a sequence of vertices, or None for all.
        r : the radius, >= 0 or inf, in the unit of V; for many vertices also one for each. A vertex at exactly `r`
            counts.
        return_distance : also the distance of each from its `v`, in a straight line (float64, by any method).
        sort : vertices of a neighborhood ascend; otherwise in no stated order, but always the same.
        method : "exact", what breadth-first search gives, by the index;
                 "paper", the approximate answer of the paper, between exact and ball, or `Paper` with other parameters;
                 "bfs", breadth-first search;
                 "ball", every vertex within `r` in space.
            "paper" builds an index of its own when first asked; "bfs" and "ball" use one thread.
        workers, progress : as for the class, for many vertices. Answers do not depend on `workers`.

        Returns for one vertex `indices` (int32) or `indices, distances`; for many `indptr, indices` or
        `indptr, indices, distances`: row i is indices[indptr[i]:indptr[i + 1]] (indptr int64). The arrays are the
        caller's own. Cost: about that of the rim of each answer ("exact"); all answers are in memory at once, see
        `iter_neighborhoods`.
        """
        asked = self._method(method)
        if v is not None and _convert.is_single(v):
            return self._query_one(asked, v, r, return_distance, sort)
        rows, radius, threads = self._batch(v, r, workers)
        with watcher(progress) as watch:
            indptr, indices, distances = asked.neighborhoods(
                rows, radius, distances=bool(return_distance), sorted=bool(sort), threads=threads, progress=watch
            )
        return (indptr, indices, distances) if return_distance else (indptr, indices)

    def query_ball_count(
        self, v: Vertices, r: Radius, *, method: Method = "exact", workers: int = -1, progress: Progress = None
    ) -> Any:
        """How many vertices each neighborhood has: an int for one vertex, else int64 for each. See `query_ball`."""
        asked = self._method(method)
        if v is not None and _convert.is_single(v):
            return asked.count(_convert.vertex(v, self._count), _convert.radius(r))
        rows, radius, threads = self._batch(v, r, workers)
        with watcher(progress) as watch:
            return asked.counts(rows, radius, threads=threads, progress=watch)

    def query_ranges(self, v: int, r: float) -> NDArray[np.int32]:
        """The exact neighborhood of one vertex as ranges in index order, (#ranges, 2) int32: its vertices are
        permutation[begin:end] for each row `begin, end`, without copying them. Disjoint, in no stated order."""
        return self._exact.ranges(_convert.vertex(v, self._count), _convert.radius(r))

    def radius_neighbors_graph(
        self,
        r: Radius,
        *,
        mode: Literal["connectivity", "distance"] = "connectivity",
        method: Method = "exact",
        workers: int = -1,
        progress: Progress = None,
    ) -> csr_array:
        """All neighborhoods as a scipy.sparse.csr_array, (#V, #V): row i is that of vertex i, itself included, sorted.

        r : one radius, or one for each vertex (the matrix is then not symmetric).
        mode : "connectivity", True for every neighbor, or "distance", the distances (float64; stored where 0).
        Needs SciPy. See `query_ball` for the rest.
        """
        from scipy.sparse import csr_array

        if mode not in ("connectivity", "distance"):
            raise ValueError(f"mode: {mode!r}, expected 'connectivity' or 'distance'")
        with_distances = mode == "distance"
        indptr, indices, *distances = self.query_ball(
            None, r, return_distance=with_distances, sort=True, method=method, workers=workers, progress=progress
        )
        if len(indices) <= np.iinfo(np.int32).max:
            indptr = indptr.astype(np.int32)  # or SciPy would widen the indices to the same type
        data = distances[0] if with_distances else np.ones(len(indices), bool)
        graph = csr_array((data, indices, indptr), shape=(self._count, self._count))
        graph.has_sorted_indices = graph.has_canonical_format = True
        return graph

    def iter_neighborhoods(
        self,
        r: Radius,
        v: Vertices = None,
        *,
        chunk: int = 4096,
        return_distance: bool = False,
        sort: bool = False,
        method: Method = "exact",
        workers: int = -1,
    ) -> Iterator[Chunk]:
        """The same as `query_ball` on many vertices, `chunk` of them at a time, so that memory stays bounded.

        Yields `Chunk(vertices, indptr, indices, distances)`, `distances` None unless asked for.
        """
        chunk = _convert.positive(chunk, "chunk")
        rows = np.arange(self._count, dtype=np.int32) if v is None else _convert.vertices(v, self._count)
        radii = _convert.radii(r, len(rows))
        options = {"return_distance": return_distance, "sort": sort, "method": method, "workers": workers}

        def chunks():
            for begin in range(0, len(rows), chunk):
                part = slice(begin, begin + chunk)
                radius = radii if isinstance(radii, float) else radii[part]
                answer = self.query_ball(rows[part], radius, **options)
                yield Chunk(rows[part], *answer, *(() if return_distance else (None,)))

        return chunks()

    def save(self, path: str | os.PathLike, *, progress: Progress = None) -> None:
        """Writes the index to a file, for `load`: the same bytes on every machine for the same mesh.

        progress : as for the class; parts are bytes, each of which is gone through twice.

        Positions and graph of the mesh are in it, faces are not. The file appears whole or not at all: it is written
        beside the target under another name, brought to the disk and renamed. Raises OSError, and KeyboardInterrupt on
        Ctrl-C; the old file, if any, is then still there.
        """
        with watcher(progress) as watch:
            _core.save(self._exact, path, progress=watch)

    def _method(self, method):
        try:
            return self._methods[method]
        except TypeError:
            if method.__hash__ is not None:
                raise
            raise TypeError(f"method: expected a name or a Paper, not {type(method).__name__}") from None

    def _query_one(self, asked, v, r, return_distance, sort):
        v, r = _convert.vertex(v, self._count), _convert.radius(r)
        if not return_distance:
            indices = asked.neighborhood(v, r)
            if sort:
                indices.sort()
            return indices
        indices, distances = asked.neighborhood_and_distances(v, r)
        if not sort:
            return indices, distances
        order = np.argsort(indices)
        return indices[order], distances[order]

    def _batch(self, v, r, workers):
        rows = None if v is None else _convert.vertices(v, self._count)
        radius = _convert.radii(r, self._count if rows is None else len(rows))
        return rows, radius, _convert.threads(workers)


def _unpickled(cls, saved):
    return cls._holding(_core.from_bytes(np.frombuffer(saved, np.uint8)))
