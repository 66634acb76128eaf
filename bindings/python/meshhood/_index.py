# SPDX-License-Identifier: MIT
"""The index of a mesh, with an interface like that of SciPy's trees."""

from __future__ import annotations

import copyreg
import os
import pickle
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, Optional, Union, overload

import numpy as np
from numpy.typing import NDArray

from . import _convert, _core
from ._aggregate import Aggregates
from ._held import Held
from ._mesh import kept_faces, mesh_arrays, moved_positions, warn_if_no_faces, warn_if_unwelded
from ._methods import Method
from ._progress import Progress, reporter
from ._queries import Queries
from ._shape import Shape
from ._surface_queries import SurfaceQueries
from ._types import (
    BallOptions,
    CountOptions,
    Counts,
    Ids,
    Metric,
    Number,
    Offsets,
    Radii,
    Reals,
    Unit,
    Vertex,
    Vertices,
)

if TYPE_CHECKING:
    from scipy.sparse import csr_array
    from typing_extensions import Unpack

Order = Literal["query", "index"]


class Chunk(NamedTuple):
    """Some rows of a batch: row i is the neighborhood of vertices[i] (see `MeshIndex.query_ball`)."""

    vertices: Ids
    indptr: Offsets
    indices: Ids
    distances: Optional[Reals]


class Quality(NamedTuple):
    """How well the leaves of an index fit the positions (see `MeshIndex.quality`)."""

    mean_radius: float
    rebuilt_radius: float
    gain: float


class MeshIndex(Queries, SurfaceQueries, Aggregates, Shape):
    """An index of a mesh that finds the neighborhood of a vertex v with a radius r: the part of the mesh inside the
    ball of radius r around v that is connected to v within the ball.

    V : (#V, 3) float32 or float64, the positions, in any unit. Or a mesh without F: of
        trimesh, PyVista, VTK (vtkPolyData), vedo, meshio, Open3D, or a GIFTI surface of nibabel.
    F : the faces, of any integer type; one of
        (#F, 3) triangles, (#F, 4) quads, (#F, k);
        a tuple (offsets, corners): polygon i has the corners corners[offsets[i]:offsets[i + 1]];
        one dimension, VTK's padded faces: each face begins with the number of its corners;
        a scipy.sparse matrix (#V, #V): a graph. Each stored entry is an edge, in either direction, whatever its value.
    cut : edges that no search crosses, as pairs of vertices (#cut, 2) in either order.
    keep_faces : keep a copy of the faces, 4 bytes for each corner and, unless all are triangles, for each face. Without
        it, or from a graph, the calls that need faces need them as their argument F.
    workers : number of threads, -1 for one per processor. The index does not depend on it.
    progress : True shows a bar of tqdm. A function is called as progress(done, total); an exception from it ends the
        call.

    Vertices are numbered as in V, with int32 ids; at most 2^31 - 1 vertices. V and F are copied: later changes have no
    effect. V and F may have any memory layout, and be anything that offers its memory to NumPy (`__array__`,
    `__array_interface__`) or by DLPack, as tensors of PyTorch on the CPU do. Types other than float32, float64, int32,
    int64, uint32 and uint64 are converted. Cost: O(#V log #V + #E).

    Warns if faces with coinciding corners are not connected (an unwelded mesh).

    An exact answer depends on the index, the vertex and the radius alone. Its ids are in index order: ascending places
    of `permutation`.

    Immutable. Any number of threads may use it at the same time; the interpreter lock is released during calls. An
    index can be saved, pickled (the same bytes), and used in a forked process. Every method raises ValueError or
    TypeError, naming the argument and the element, and KeyboardInterrupt on Ctrl-C.
    """

    def __init__(
        self,
        V: Any,
        F: Any = None,
        *,
        cut: Any = None,
        keep_faces: bool = True,
        workers: int = -1,
        progress: Progress = None,
    ) -> None:
        positions, corners, offsets = mesh_arrays(V, F)
        options = {"cut": _convert.edges(cut, "cut"), "threads": _convert.threads(workers)}
        with reporter(progress) as report:
            exact = _core.exact(positions, corners, offsets=offsets, **options, progress=report)
        has_faces = keep_faces and not hasattr(F, "tocoo")
        self._hold(exact, kept_faces(corners, offsets) if has_faces else None)
        if not hasattr(F, "tocoo"):
            warn_if_no_faces(positions, corners, stacklevel=3)
        warn_if_unwelded(positions, corners, offsets, stacklevel=3)

    @classmethod
    def _holding(cls, exact: Any, faces: Any = None) -> MeshIndex:
        self = cls.__new__(cls)
        self._hold(exact, faces)
        return self

    def __len__(self) -> int:
        """The number of vertices."""
        return self._count

    def __repr__(self) -> str:
        return f"<meshhood.MeshIndex: {self._count} vertices, {_as_size(self.nbytes)}>"

    def __reduce_ex__(self, protocol: Any) -> tuple[Any, ...]:
        """The bytes of an index file, which are verified when they are loaded, the faces, and the attributes of a
        subclass. With protocol 5 the bytes may be sent out of band."""
        saved = _core.to_bytes(self._exact)
        buffer = pickle.PickleBuffer(saved) if protocol >= 5 else saved.tobytes()
        return _unpickled, (type(self), buffer, self._faces), self.__getstate__()

    def __getstate__(self) -> Any:
        """The attributes that a subclass has added; None if there are none."""
        attributes = {name: value for name, value in vars(self).items() if name not in Held.__annotations__}
        names = copyreg._slotnames(type(self))
        slots = {name: getattr(self, name) for name in names if hasattr(self, name)}
        return (attributes, slots) if slots else attributes or None

    def _like_this(self, exact: Any) -> MeshIndex:
        """An index of this class, with the attributes that a subclass has added."""
        other = type(self)._holding(exact, self._faces)
        state = self.__getstate__()
        attributes, slots = state if isinstance(state, tuple) else (state, None)
        for name, value in {**(attributes or {}), **(slots or {})}.items():
            setattr(other, name, value)
        return other

    def __copy__(self) -> MeshIndex:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> MeshIndex:
        return self

    @property
    def n_vertices(self) -> int:
        """The number of vertices."""
        return self._count

    @property
    def nbytes(self) -> int:
        """Memory of the index in bytes, including its copies of the positions and of the faces. The other methods,
        `positions` and `mean_edge_length` need additional memory once they are used."""
        return self._exact.nbytes + sum(array.nbytes for array in self._faces or () if array is not None)

    @property
    def positions(self) -> Union[NDArray[np.float32], NDArray[np.float64]]:
        """The positions: (#V, 3), in the numbering and precision of V, read-only. Extracted at the first use, then
        kept."""
        return self._methods.graph().positions

    @property
    def faces(self) -> Union[Ids, tuple[NDArray[np.signedinteger[Any]], Ids], None]:
        """The faces: (#F, 3) int32, or a tuple (offsets, corners) unless all are triangles; read-only, not copied. None
        if the index has none: it was built with keep_faces=False or from a graph, or loaded from a file without them."""
        if self._faces is None:
            return None
        corners, offsets = self._faces
        return corners.reshape(-1, 3) if offsets is None else (offsets, corners)

    @property
    def mean_edge_length(self) -> float:
        """The mean length of the edges, each counted once, in the unit of the positions; 0 if there are none. O(#V +
        #E)."""
        return self._methods.mean_edge_length

    @property
    def permutation(self) -> Ids:
        """The vertices in index order: (#V,) int32, read-only, not copied. It keeps the index alive. Vertices that are
        near each other in the mesh are near each other here, and exact answers list them in this order."""
        return self._exact.permutation

    @overload
    def query_ball(
        self, v: Vertex, r: Number, *, return_distance: Literal[False] = False, **options: Unpack[BallOptions]
    ) -> Ids: ...

    @overload
    def query_ball(
        self, v: Vertex, r: Number, *, return_distance: Literal[True], **options: Unpack[BallOptions]
    ) -> tuple[Ids, Reals]: ...

    @overload
    def query_ball(
        self, v: Vertices, r: Radii, *, return_distance: Literal[False] = False, **options: Unpack[BallOptions]
    ) -> tuple[Offsets, Ids]: ...

    @overload
    def query_ball(
        self, v: Vertices, r: Radii, *, return_distance: Literal[True], **options: Unpack[BallOptions]
    ) -> tuple[Offsets, Ids, Reals]: ...

    def query_ball(
        self,
        v: Any,
        r: Any,
        *,
        return_distance: bool = False,
        sort: bool = False,
        method: Method = "exact",
        metric: Metric = "straight",
        unit: Unit = "mesh",
        workers: int = -1,
        max_bytes: Optional[int] = None,
        progress: Progress = None,
    ) -> Any:
        """The vertices of the neighborhood of each `v`, itself included.

        v : a vertex, a sequence of vertices, a bool mask (#V,), or None for all.
        r : the radius, >= 0 or inf; for many vertices optionally one per vertex. A vertex at exactly `r` is inside.
        return_distance : also return the straight-line distance of each vertex from its `v` (float64).
        sort : the ids of a neighborhood ascend. Otherwise those of "exact" are in index order: ascending places of
            `permutation`; those of another method have an order of its own, which is always the same.
        method : "exact", the exact neighborhood, by the index;
                 "paper", the approximate neighborhood of the paper, a superset of "exact" and a subset of "ball", or
                 `Paper` with other parameters;
                 "bfs", the exact neighborhood by breadth-first search, for comparison;
                 "ball", every vertex within `r` in space, connected or not.
            "paper" builds an index of its own at the first use.
        metric : "straight", the neighborhood in the ball of radius `r`; "path", the vertices whose shortest path along
            edges is at most `r` long. Distances are then the lengths of these paths, and the vertices of one
            neighborhood are sorted by them. "path" needs method "exact".
        unit : of `r`: "mesh" is that of V, "edge" is `mean_edge_length`.
        max_bytes : refuse a larger result of many vertices; by default, one larger than the memory of the machine. A
            sample of the rows usually shows this within a second.
        workers, progress : as for the class, for many vertices. The result does not depend on `workers`.

        Returns for one vertex `indices` (int32) or `indices, distances`; for many vertices `indptr, indices` or
        `indptr, indices, distances`: row i is indices[indptr[i]:indptr[i + 1]] (indptr int64). The arrays are new.

        The cost of "exact" grows with the part of the mesh at the surface of each ball rather than with the size of the
        neighborhood. All rows are in memory at once; to avoid that, use `iter_neighborhoods`.
        """
        searched, scale = self._method(method, metric), self._scale(unit)
        if v is not None and _convert.is_single(v):
            v, r = _convert.vertex(v, self._count), scale * _convert.radius(r)
            return _query_one(searched, v, r, return_distance, sort)
        rows, radius, threads = self._batch(v, r, scale, workers)
        options = {"distances": bool(return_distance), "sorted": bool(sort), "threads": threads}
        with reporter(progress) as report:
            indptr, indices, distances = searched.neighborhoods(
                rows, radius, **options, max_bytes=_convert.max_bytes(max_bytes), progress=report
            )
        return (indptr, indices, distances) if return_distance else (indptr, indices)

    @overload
    def count(self, v: Vertex, r: Number, **options: Unpack[CountOptions]) -> int: ...

    @overload
    def count(self, v: Vertices, r: Radii, **options: Unpack[CountOptions]) -> Counts: ...

    def count(
        self,
        v: Any,
        r: Any,
        *,
        method: Method = "exact",
        metric: Metric = "straight",
        unit: Unit = "mesh",
        workers: int = -1,
        progress: Progress = None,
    ) -> Any:
        """The number of vertices of each neighborhood: an int for one vertex, else an int64 array. See `query_ball`."""
        searched, scale = self._method(method, metric), self._scale(unit)
        if v is not None and _convert.is_single(v):
            return searched.count(_convert.vertex(v, self._count), scale * _convert.radius(r))
        rows, radius, threads = self._batch(v, r, scale, workers)
        with reporter(progress) as report:
            return searched.counts(rows, radius, threads=threads, progress=report)

    def radius_neighbors_graph(
        self,
        r: Radii,
        *,
        mode: Literal["connectivity", "distance"] = "connectivity",
        method: Method = "exact",
        metric: Metric = "straight",
        unit: Unit = "mesh",
        workers: int = -1,
        max_bytes: Optional[int] = None,
        progress: Progress = None,
    ) -> csr_array:
        """All neighborhoods as a scipy.sparse.csr_array (#V, #V): row v holds the neighborhood of v, itself included.

        r : one radius, or one per vertex (the matrix is then not symmetric).
        mode : "connectivity", 1.0 for each vertex of the neighborhood; or "distance", the straight-line distances, with
            zeros stored. Both are float64, as in scikit-learn.
        Needs SciPy. See `query_ball` for the other arguments.
        """
        from scipy.sparse import csr_array

        with_distances = _convert.choice(mode, "mode", ("connectivity", "distance")) == "distance"
        indptr, indices, *distances = self.query_ball(
            None,
            r,
            return_distance=with_distances,
            sort=True,
            method=method,
            metric=metric,
            unit=unit,
            workers=workers,
            max_bytes=max_bytes,
            progress=progress,
        )
        if len(indices) <= np.iinfo(np.int32).max:
            indptr = indptr.astype(np.int32)  # or SciPy would widen the indices to the same type
        data = distances[0] if with_distances else np.ones(len(indices))
        graph = csr_array((data, indices, indptr), shape=(self._count, self._count))
        graph.has_sorted_indices = graph.has_canonical_format = True
        return graph

    def iter_neighborhoods(
        self,
        v: Vertices,
        r: Radii,
        *,
        chunk: int = 4096,
        order: Order = "query",
        return_distance: bool = False,
        sort: bool = False,
        method: Method = "exact",
        metric: Metric = "straight",
        unit: Unit = "mesh",
        workers: int = -1,
    ) -> Iterator[Chunk]:
        """As `query_ball` for many vertices, `chunk` rows at a time, so that memory stays bounded.

        order : of the rows: "query", that of `v`; "index", that of `permutation`, in which near vertices follow each
            other. The rows of a chunk are then computed together, which is up to ten times as fast where the vertices
            of a mesh are numbered at random. Rows of the same vertex stay in their order.

        Yields `Chunk(vertices, indptr, indices, distances)`; `distances` is None unless `return_distance`. The
        arguments are checked and copied when this is called: later changes to `v` or `r` have no effect.
        """
        chunk = _convert.positive(chunk, "chunk")
        in_index_order = _convert.choice(order, "order", ("query", "index")) == "index"
        searched = self._method(method, metric)
        rows, radius, threads = self._batch(v, r, self._scale(unit), workers)
        if rows is None:
            rows = np.arange(self._count, dtype=np.int32)
        if in_index_order:
            places = np.empty(self._count, np.int32)
            places[self.permutation] = np.arange(self._count, dtype=np.int32)
            by_place = np.argsort(places[rows], kind="stable")
            rows = rows[by_place]
            radius = radius if isinstance(radius, float) else radius[by_place]
        options = {"distances": bool(return_distance), "sorted": bool(sort), "threads": threads}
        options |= {"max_bytes": _convert.max_bytes(None), "progress": None}

        def chunks() -> Iterator[Chunk]:
            for begin in range(0, len(rows), chunk):
                part = slice(begin, begin + chunk)
                vertices = rows[part].copy()
                radii = radius if isinstance(radius, float) else radius[part]
                indptr, indices, distances = searched.neighborhoods(rows[part], radii, **options)
                yield Chunk(vertices, indptr, indices, distances if return_distance else None)

        return chunks()

    def refit(
        self,
        V: Any,
        changed: Vertices = None,
        *,
        workers: int = -1,
        progress: Progress = None,
    ) -> MeshIndex:
        """The index of the mesh after its vertices have moved: the same edges, other positions. About a third of the
        time of a build.

        V : (#V, 3), or a mesh as for the class. Its faces are not read.
        changed : the vertices that have moved, as `v` of `query_ball`; None for all. Rows of V of other vertices are
            not read. The time is that of a copy of the positions, plus a part that grows with the number of vertices
            that have moved. With `changed`, V must not be float64 if the index has float32.
        workers, progress : as for the class.

        Returns a new index, with the attributes of a subclass. This one stays as it is, and threads may search it
        meanwhile. The two share all memory but positions and bounds. Answers are exact whatever the positions; `quality`
        says when a new index would answer faster.
        """
        moved = None if changed is None else _convert.vertices(changed, self._count, "changed")
        positions = moved_positions(V)
        if len(positions) != self._count:
            raise ValueError(f"V: {len(positions)} positions, but the index has {self._count} vertices")
        positions = _copied(positions, moved)
        with reporter(progress) as report:
            exact = _core.refit(
                self._exact, positions, changed=moved, threads=_convert.threads(workers), progress=report
            )
        return self._like_this(exact)

    def quality(self) -> Quality:
        """How well the leaves of the index, its smallest parts, fit the positions after `refit`.

        Returns `Quality(mean_radius, rebuilt_radius, gain)`: the mean radius of the leaves at some places of the mesh,
        what it would be in a new index, and their ratio. The time of a query is about proportional to the radius of the
        leaves around it. After a build, `gain` is about 1; at 1.5 and above a new index pays off if many queries
        follow. Takes some milliseconds for any mesh.
        """
        return Quality(*self._exact.quality())

    def save(
        self, path: Union[str, os.PathLike[str]], *, faces: bool = False, progress: Progress = None
    ) -> None:
        """Writes the index to a file for `load`. The same mesh gives the same bytes on every machine.

        faces : also write the faces that the index keeps, so that the loaded index has them: 4 bytes for each corner
            and, unless all are triangles, for each face. ValueError if the index has none.
        progress : as for the class, in bytes; each byte is counted twice, for its checksum and for writing it.

        The file holds the positions and the graph of the mesh, and its faces if `faces`. It appears whole or not at
        all: it is written to the same folder under another name, synchronized to disk and renamed. Raises OSError, with
        errno and filename, and KeyboardInterrupt on Ctrl-C; an old file of that name is then unchanged.
        """
        path = _convert.path(path)
        arrays = self._own_faces("faces: True, but") if faces else None
        with reporter(progress) as report:
            _core.save(self._exact, path, faces=arrays, progress=report)

def _copied(positions: Any, rows: Any) -> Any:
    """A copy, because another thread may write to `positions` once they are checked. With `rows`, only these are set:
    the system provides no memory for pages that nothing is written to."""
    if rows is None:
        return np.array(positions)
    copy = np.empty_like(positions)
    copy[rows] = positions[rows]
    return copy


def _query_one(searched: Any, v: int, r: float, return_distance: bool, sort: bool) -> Any:
    if not return_distance:
        indices = searched.neighborhood(v, r)
        if sort:
            indices.sort()
        return indices
    indices, distances = searched.neighborhood_and_distances(v, r)
    if not sort:
        return indices, distances
    order = np.argsort(indices)
    return indices[order], distances[order]


def _as_size(count: float) -> str:
    for unit in ("bytes", "kB", "MB"):
        if count < 1000:
            return f"{count:.4g} {unit}"
        count /= 1000
    return f"{count:.4g} GB"


def _unpickled(cls: type[MeshIndex], saved: Any, faces: Any) -> MeshIndex:
    # A copy, because arrays that were sent out of band are memory of the caller.
    kept = faces and kept_faces(*(None if array is None else np.array(array) for array in faces))
    return cls._holding(_core.from_bytes(np.frombuffer(saved, np.uint8)), kept)
