# SPDX-License-Identifier: MIT
"""The index of a mesh, with an interface like that of SciPy's trees."""

from __future__ import annotations

import copyreg
import os
import pickle
from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, Optional, Union, overload

import numpy as np
from numpy.typing import NDArray

from . import _convert, _core
from ._aggregate import Aggregates
from ._held import Held
from ._instance import NeedsInstance
from ._mesh import (
    kept_faces,
    mesh_arrays,
    moved_positions,
    placed,
    warn_if_coarse,
    warn_if_no_faces,
    warn_if_unwelded,
)
from ._methods import Method
from ._optional import optional
from ._patches import Patches
from ._progress import Progress, in_parts, reporter
from ._queries import Queries
from ._regions import Regions
from ._repr import shown_in_a_line
from ._rows import Rows, check_size, needed_sort, read_rows, result_dtype, sorted_rows
from ._shape import Shape
from ._surface_queries import SurfaceQueries
from ._types import (
    AnyVertices,
    Counts,
    Floats,
    Ids,
    Mask,
    Metric,
    Offsets,
    Radii,
    Scales,
    Sort,
    Unit,
    Vertex,
    Vertices,
)

if TYPE_CHECKING:
    from numpy.typing import DTypeLike
    from scipy.sparse import csr_array

Order = Literal["query", "index"]

_FOR_ONE = "; neighborhood(start, r) answers one"


@shown_in_a_line
class Chunk(NamedTuple):
    """Some rows of a batch: row i is the neighborhood of vertices[i] (see `MeshIndex.iter_neighborhoods`).

    >>> chunk = next(meshhood.MeshIndex(V, F).iter_neighborhoods(0.3, chunk=100))
    >>> first = chunk.indices[chunk.indptr[0] : chunk.indptr[1]]
    """

    vertices: Ids
    indptr: Offsets
    indices: Ids
    distances: Optional[Floats]


class Quality(NamedTuple):
    """How well the leaves of an index fit the positions (see `MeshIndex.quality`).

    >>> mean_radius, rebuilt_radius, gain = meshhood.MeshIndex(V, F).quality()
    """

    mean_radius: float
    rebuilt_radius: float
    gain: float


class MeshIndex(Queries, SurfaceQueries, Patches, Aggregates, Shape, Regions, metaclass=NeedsInstance):
    """An index of a mesh that finds the neighborhood of a vertex v with a radius r: the part of the mesh inside the
    ball of radius r around v that is connected to v within the ball.

    V : (#V, 3) float32 or float64, the positions, in any unit. Or a mesh without F: of
        trimesh, PyVista, VTK (vtkPolyData), vedo, meshio, Open3D, nilearn, or a GIFTI surface of nibabel.
        A vertex with a NaN, as scanners and depth cameras mark holes, is a wall of all calls if no face has it, with a
        warning. `positions` has it where another vertex is, and the index is not saved, pickled or refitted.
    F : the faces, of any integer type; one of
        (#F, 3) triangles, (#F, 4) quads, (#F, k);
        a tuple (offsets, corners): polygon i has the corners corners[offsets[i]:offsets[i + 1]];
        one dimension, VTK's padded faces: each face begins with the number of its corners;
        a scipy.sparse matrix (#V, #V): a graph. Each stored entry is an edge, in either direction, whatever its value.
    cut : edges that no search crosses, as pairs of vertices (#cut, 2) in either order. Vertices of a line of cut edges
        stay joined to both of its sides: to separate two sides, cut the edges that cross the line between them. Areas,
        patches and gaps are those of the faces, and cross a cut edge.
    keep_faces : keep a copy of the faces, 4 bytes for each corner and, unless all are triangles, for each face. Without
        it, or from a graph, the calls that need faces need them as their argument F: the faces, or a mesh. Faces
        with edges that the index does not have are refused.
    workers : number of threads, -1 for one per processor. The index does not depend on it.
    progress : True shows a bar of tqdm. A function is called as progress(done, total); an exception from it ends the
        call.

    Calls on one start have it first: `neighborhood(start, r)`. Those on many vertices have them last:
    `counts(r, vertices=None)`. Their arguments mean the same everywhere:

    vertices : the rows: a sequence of vertices, a bool mask (#V,), or None for all. Or one vertex where the result is a
        number or an array of numbers for each; it then has no axis of vertices. An array of #V numbers that are 0 or one
        other is refused, because it may be meant as a mask; a list is not.
    r : the radius, >= 0 or inf, or one for each row. A vertex at exactly `r` is inside.
    scales : several radii for all rows, instead of `r`. The result has a leading axis of scales. Lists of neighborhoods
        have the rows of all scales, scale after scale.
    walls, ignored : bool masks (#V,), or sequences of vertices. A search does not pass walls, as if they were not in
        the mesh; it passes ignored vertices. Neither belong to a neighborhood, and that of a wall is empty. The last
        masks are kept as an index of their own, O(#V) once; a call with the same masks compares them. See `masked`.
    metric : "straight", the neighborhood in the ball of radius `r`; "path", the vertices whose shortest path along
        edges is at most `r` long. Distances, and the weights that follow from them, are then the lengths of these
        paths. "surface", the same for paths that also run straight over two triangles that share a side: nearer to
        geodesics than paths along edges (docs/queries.md). The index must have faces. What is made of them is
        kept, about 260 bytes a vertex. "rings", the vertices that at most `r` edges separate from the vertex; distances
        are then numbers of edges. "space", the vertices within `r` in space, connected or not; k nearest, discs, and
        the nearest connected and unconnected vertices refuse it.
    unit : of `r` and `scales`: "mesh" is that of V, "edge" is `mean_edge_length`.
    F : other faces than those that the index keeps, or a mesh. What is made of them, such as normals, is kept for the
        next call with the same faces.
    max_bytes : refuse a larger result with MemoryError; by default, one larger than the memory that is free.
    workers, progress : as above. Progress is over all scales. The result does not depend on `workers`.

    Vertices are numbered as in V, with int32 ids; at most 2^31 - 1 vertices. V and F are copied: later changes have no
    effect. V and F may have any memory layout, and be anything that offers its memory to NumPy (`__array__`,
    `__array_interface__`) or by DLPack, as tensors of PyTorch on the CPU do. Other integers are converted, and
    positions of float16 or integers to float64, if that is exact. Cost: O(#V log #V + #E).

    Warns if faces whose corners coincide, or differ by rounding, are not connected (an unwelded mesh), and if float32
    positions are only some 64 times as fine as the mean edge: then edges are off by a percent, or vertices coincide.

    An exact answer depends on the index, the vertex, the radius and the masks alone. Its ids are in index order:
    ascending places of `permutation`.

    Immutable. Any number of threads may use it at the same time; the interpreter lock is released during calls. An
    index can be saved, pickled (the same bytes), and used in a forked process. Every method raises ValueError or
    TypeError, naming the argument and the element, MemoryError for a result that does not fit, and KeyboardInterrupt on
    Ctrl-C.

    >>> index = meshhood.MeshIndex(V, F)
    >>> index
    <meshhood.MeshIndex: 642 vertices, mean edge not computed yet, 45.05 kB>
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
        mesh, no_position = placed(mesh_arrays(V, F), stacklevel=3)
        options = {"cut": _convert.edges(cut, "cut"), "threads": _convert.threads(workers)}
        with reporter(progress, "MeshIndex") as report:
            exact = _core.exact(mesh, **options, progress=report)
        has_faces = keep_faces and not hasattr(F, "tocoo")
        self._hold(exact, kept_faces(mesh[1:]) if has_faces else None)
        if no_position is not None:
            self._hold_without(no_position)
        if not hasattr(F, "tocoo"):
            warn_if_no_faces(mesh, stacklevel=3)
        warn_if_unwelded(mesh, stacklevel=3)
        warn_if_coarse(mesh, stacklevel=3)

    @classmethod
    def _holding(cls, exact: Any, faces: Any = None) -> MeshIndex:
        self = cls.__new__(cls)
        self._hold(exact, faces)
        return self

    def __len__(self) -> int:
        """The number of vertices."""
        return self._count

    def __repr__(self) -> str:
        length = self._methods.known_mean_edge_length
        edge = "not computed yet" if length is None else f"{length:.4g}"
        return f"<meshhood.MeshIndex: {self._count} vertices, mean edge {edge}, {_as_size(self.nbytes)}>"

    def __reduce_ex__(self, protocol: Any) -> tuple[Any, ...]:
        """The bytes of an index file, which are verified when they are loaded, the faces, and the attributes of a
        subclass. With protocol 5 the bytes may be sent out of band."""
        saved = _core.to_bytes(self._placed("pickled"))
        buffer = pickle.PickleBuffer(saved) if protocol >= 5 else saved.tobytes()
        return _unpickled, (type(self), buffer, self._faces), self.__getstate__()

    def __getstate__(self) -> Any:
        """The attributes that a subclass has added; None if there are none."""
        attributes = {name: value for name, value in vars(self).items() if name not in Held.__annotations__}
        names = copyreg._slotnames(type(self))
        slots = {name: getattr(self, name) for name in names if hasattr(self, name)}
        return (attributes, slots) if slots else attributes or None

    def _with_attributes(self, other: MeshIndex) -> MeshIndex:
        """`other`, with the attributes that a subclass has added to this one."""
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
        return self._methods.positions

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
    def neighborhoods(
        self, r: Optional[Radii] = None, vertices: Vertices = None, *, scales: Optional[Scales] = None,
        return_distance: Literal[False] = False, sort: Optional[Sort] = None, metric: Metric = "straight",
        walls: Mask = None, ignored: Mask = None, unit: Unit = "mesh", method: Method = "exact",
        dtype: Optional[DTypeLike] = None, max_bytes: Optional[int] = None, workers: int = -1, progress: Progress = None,
    ) -> tuple[Offsets, Ids]: ...  # fmt: skip

    @overload
    def neighborhoods(
        self, r: Optional[Radii] = None, vertices: Vertices = None, *, scales: Optional[Scales] = None,
        return_distance: Literal[True], sort: Optional[Sort] = None, metric: Metric = "straight",
        walls: Mask = None, ignored: Mask = None, unit: Unit = "mesh", method: Method = "exact",
        dtype: Optional[DTypeLike] = None, max_bytes: Optional[int] = None, workers: int = -1, progress: Progress = None,
    ) -> tuple[Offsets, Ids, Floats]: ...  # fmt: skip

    def neighborhoods(
        self,
        r: Optional[Radii] = None,
        vertices: Vertices = None,
        *,
        scales: Optional[Scales] = None,
        return_distance: bool = False,
        sort: Optional[Sort] = None,
        metric: Metric = "straight",
        walls: Mask = None,
        ignored: Mask = None,
        unit: Unit = "mesh",
        method: Method = "exact",
        dtype: Optional[DTypeLike] = None,
        max_bytes: Optional[int] = None,
        workers: int = -1,
        progress: Progress = None,
    ) -> Any:
        """The vertices of the neighborhood of each vertex, itself included: `indptr, indices` or, with
        `return_distance`, `indptr, indices, distances`. Row i is indices[indptr[i]:indptr[i + 1]].

        r, vertices, scales, metric, walls, ignored, unit, workers, progress : see `MeshIndex`.
        return_distance, sort, method, dtype : see `neighborhood`.
        max_bytes : see `MeshIndex`. A sample of the rows usually shows within a second that a result is larger.

        `indptr` is int32 if it fits, else int64; `indices` are int32. The arrays are new. All rows are in memory at
        once; to avoid that, use `iter_neighborhoods`.

        >>> index = meshhood.MeshIndex(V, F)
        >>> indptr, indices, distances = index.neighborhoods(
        ...     [0.3, 0.5], [42, 43], return_distance=True, sort="distance"
        ... )
        >>> int(indices[indptr[1]])
        43
        """
        _convert.refuse_one(vertices, self._count, _FOR_ONE)
        rows = read_rows(self, vertices, r, scales, metric, walls, ignored, unit, workers, progress)
        searched = rows.index._method(method, metric)
        sort = needed_sort(sort, method, metric)
        indptr, indices, distances = self._rows_of(
            searched, rows, return_distance, sort, dtype, max_bytes, "neighborhoods"
        )
        return (indptr, indices, distances) if return_distance else (indptr, indices)

    @overload
    def counts(
        self, r: Optional[Radii] = None, vertices: Vertices = None, *, scales: Optional[Scales] = None,
        metric: Metric = "straight", walls: Mask = None, ignored: Mask = None, unit: Unit = "mesh",
        method: Method = "exact", workers: int = -1, progress: Progress = None,
    ) -> Counts: ...  # fmt: skip

    @overload
    def counts(
        self, r: Optional[Radii] = None, vertices: Vertex = ..., *, scales: Optional[Scales] = None,
        metric: Metric = "straight", walls: Mask = None, ignored: Mask = None, unit: Unit = "mesh",
        method: Method = "exact", workers: int = -1, progress: Progress = None,
    ) -> Union[int, Counts]: ...  # fmt: skip

    def counts(
        self,
        r: Optional[Radii] = None,
        vertices: AnyVertices = None,
        *,
        scales: Optional[Scales] = None,
        metric: Metric = "straight",
        walls: Mask = None,
        ignored: Mask = None,
        unit: Unit = "mesh",
        method: Method = "exact",
        workers: int = -1,
        progress: Progress = None,
    ) -> Any:
        """The number of vertices of each neighborhood: int64, (#rows,) or (#scales, #rows); an int for one vertex and
        one radius. The arguments are those of `neighborhoods`.

        >>> index = meshhood.MeshIndex(V, F)
        >>> index.counts(scales=[0.2, 0.4]).shape
        (2, 642)
        """
        rows = read_rows(self, vertices, r, scales, metric, walls, ignored, unit, workers, progress)
        counts = rows.shaped(rows.ask(rows.index._method(method, metric).counts))
        return counts if counts.ndim else int(counts)

    def radius_neighbors_graph(
        self,
        r: Optional[Radii] = None,
        vertices: Vertices = None,
        *,
        scales: Optional[Scales] = None,
        mode: Literal["connectivity", "distance"] = "connectivity",
        metric: Metric = "straight",
        walls: Mask = None,
        ignored: Mask = None,
        unit: Unit = "mesh",
        method: Method = "exact",
        dtype: Optional[DTypeLike] = None,
        max_bytes: Optional[int] = None,
        workers: int = -1,
        progress: Progress = None,
    ) -> csr_array:
        """Neighborhoods as a scipy.sparse.csr_array (#rows, #V), all unless `vertices` are given: a row holds the
        neighborhood of its vertex, itself included. With scales, (#scales * #rows, #V), scale after scale.

        mode : "connectivity", 1.0 for each vertex of the neighborhood; or "distance", the distances, with zeros stored.
            Both are float64, as in scikit-learn, unless `dtype` says otherwise.
        The other arguments are those of `neighborhoods`; the ids of a row ascend. The matrix is not quite symmetric: what
        connects two vertices in the ball around one may leave that around the other. Needs SciPy. As `edge_index` of
        PyTorch Geometric, (2, #edges), from each neighbor (column) to the vertex of its row: see the second example.

        >>> index = meshhood.MeshIndex(V, F)
        >>> index.radius_neighbors_graph(0.3, [42, 43], mode="distance").shape
        (2, 642)
        >>> graph = index.radius_neighbors_graph(0.3).tocoo()
        >>> edge_index = np.stack([graph.col, graph.row]).astype(np.int64)
        """
        csr_array = optional("scipy.sparse", "radius_neighbors_graph").csr_array
        with_distances = _convert.choice(mode, "mode", ("connectivity", "distance")) == "distance"
        _convert.refuse_one(vertices, self._count, _FOR_ONE)
        rows = read_rows(self, vertices, r, scales, metric, walls, ignored, unit, workers, progress)
        numbers, limit = result_dtype(dtype), rows.limit(max_bytes, self._count)
        searched = rows.index._method(method, metric)
        indptr, indices, distances = self._rows_of(
            searched, rows, with_distances, "id", numbers, limit, "radius_neighbors_graph"
        )
        if not with_distances:
            check_size(indices.shape, indices.itemsize + numbers.itemsize, limit)
        data = distances if with_distances else np.ones(len(indices), numbers)
        graph = csr_array((data, indices, indptr), shape=(len(indptr) - 1, self._count))
        graph.has_sorted_indices = graph.has_canonical_format = True
        return graph

    def iter_neighborhoods(
        self,
        r: Optional[Radii] = None,
        vertices: Vertices = None,
        *,
        scales: Optional[Scales] = None,
        chunk: int = 4096,
        order: Order = "query",
        return_distance: bool = False,
        sort: Optional[Sort] = None,
        metric: Metric = "straight",
        walls: Mask = None,
        ignored: Mask = None,
        unit: Unit = "mesh",
        method: Method = "exact",
        dtype: Optional[DTypeLike] = None,
        max_bytes: Optional[int] = None,
        workers: int = -1,
    ) -> Iterator[Chunk]:
        """As `neighborhoods`, `chunk` rows at a time, so that memory stays bounded. Masks are read
        once, O(#V).

        order : of the rows: "query", that of `vertices`; "index", that of `permutation`, in which near vertices follow
            each other. The rows of a chunk are then computed together, which is up to ten times as fast where the
            vertices of a mesh are numbered at random. Rows of the same vertex stay in their order.

        Yields `Chunk(vertices, indptr, indices, distances)`; `distances` is None unless `return_distance`. The
        arguments are checked and copied when this is called: later changes have no effect.

        >>> index = meshhood.MeshIndex(V, F)
        >>> sum(len(part.vertices) for part in index.iter_neighborhoods(0.3, chunk=100))
        642
        """
        chunk = _convert.integer(chunk, "chunk")
        in_index_order = _convert.choice(order, "order", ("query", "index")) == "index"
        _convert.refuse_one(vertices, self._count, _FOR_ONE)
        rows = read_rows(self, vertices, r, scales, metric, walls, ignored, unit, workers, None)
        numbers = result_dtype(dtype)
        if max_bytes is not None:
            rows.limit(max_bytes, self._count)
        searched = rows.index._method(method, metric)
        sort = needed_sort(sort, method, metric)
        all_rows = np.arange(self._count, dtype=np.int32) if rows.vertices is None else rows.vertices
        by_place = np.argsort(self._places()[all_rows], kind="stable") if in_index_order else slice(None)

        def chunks() -> Iterator[Chunk]:
            for radius in rows.radii:
                ids, radii = all_rows[by_place], radius if isinstance(radius, float) else radius[by_place]
                for begin in range(0, len(ids), chunk):
                    part = slice(begin, begin + chunk)
                    of_part = {"count": len(ids[part]), "vertices": ids[part]}
                    some = replace(rows, **of_part, radii=[radii if isinstance(radii, float) else radii[part]])
                    found = self._rows_of(searched, some, return_distance, sort, numbers, max_bytes, "")
                    yield Chunk(ids[part].copy(), *found)

        return chunks()

    def _rows_of(
        self, searched: Any, rows: Rows, return_distance: bool, sort: Any, dtype: Any, max_bytes: Any, title: str
    ) -> Any:
        """indptr, indices, and distances or None; the rows of all scales. `searched`: the method; `sort`: see `needed_sort`."""
        dtype = result_dtype(dtype)
        left = rows.limit(max_bytes, self._count)
        with_distances = return_distance or sort == "distance"
        order = _core.RowSort.none if sort in (None, "index") else getattr(_core.RowSort, sort)

        def search(radius: Any, report: Any) -> Any:
            nonlocal left
            call = rows.call(report, radius, left)
            indptr, indices, distances = searched.neighborhoods(call, distances=with_distances, sort=order)
            left = max(0, left - indices.nbytes - (distances.nbytes if return_distance else 0))
            return indptr, indices, distances if return_distance else None

        with rows.reporter(title) as report:  # scale after scale, as the library lists those of one radius alone
            found = map(search, rows.radii, in_parts(report, len(rows.radii)))
            indptr, indices, distances = _joined(list(found))
        if sort == "index":
            indices, distances = sorted_rows(self, sort, indptr, indices, distances)
        if len(indices) <= np.iinfo(np.int32).max:
            indptr = indptr.astype(np.int32)  # or SciPy would widen the indices to the same type
        return indptr, indices, distances.astype(dtype, copy=False) if return_distance else None

    def masked(self, *, walls: Mask = None, ignored: Mask = None) -> MeshIndex:
        """The same index with masks: every call of it leaves out walls and ignored vertices (see `MeshIndex`), and takes
        no such arguments. For loops of calls: the masks are read once, O(#V). What patches (`invariants`, `gaps`,
        `measure`, `clip`) and metric="surface" need of the faces is made anew for each set of walls, which takes as long
        as a build. Shares the memory of this index; an index with masks is not saved, refitted, pickled or masked again.
        `closest_point` is that of the whole mesh.

        >>> index = meshhood.MeshIndex(V, F)
        >>> lower = index.masked(walls=V[:, 2] > 0)
        >>> sizes = [lower.count(v, 0.3) for v in (42, 43)]
        """
        masks = _convert.mask(walls, "walls", self._count), _convert.mask(ignored, "ignored", self._count)
        return self._with_attributes(self._masked(*masks, self))

    def refit(
        self,
        V: Any,
        changed: Vertices = None,
        *,
        workers: int = -1,
        progress: Progress = None,
    ) -> MeshIndex:
        """The index of the mesh after its vertices have moved: the same edges, other positions. In about an eighth
        of the time of a build.

        V : (#V, 3), or a mesh as for the class. Its faces are not read.
        changed : the vertices that have moved, as `vertices` of other calls; None for all. Rows of V of other vertices
            are not read. The time is that of a copy of the positions, plus a part that grows with the number of vertices
            that have moved. With `changed`, V must not be float64 if the index has float32.
        workers, progress : as for the class.

        Returns a new index, with the attributes of a subclass. This one stays as it is, and threads may search it
        meanwhile. The two share all memory but positions and bounds. With `changed`, what this index has made of its
        faces is kept for the first call of the new one that needs it, and renewed then; but edge lengths of paths and
        lines of metric="surface" are all made again. Answers are exact whatever the positions; `quality` says when a new
        index would answer faster.

        >>> moved = meshhood.MeshIndex(V, F).refit(2 * V)
        """
        whole = self._placed("refitted")
        moved = None if changed is None else _convert.vertices(changed, self._count, "changed")
        positions = moved_positions(V)
        if len(positions) != self._count:
            raise ValueError(f"V: {len(positions)} positions, but the index has {self._count} vertices")
        positions = _copied(positions, moved)
        with reporter(progress, "refit") as report:
            exact = _core.refit(whole, positions, changed=moved, threads=_convert.threads(workers), progress=report)
        index = type(self)._holding(exact, self._faces)
        if moved is not None:
            index._follow(self, moved)
        return self._with_attributes(index)

    def quality(self) -> Quality:
        """How well the leaves of the index, its smallest parts, fit the positions after `refit`.

        Returns `Quality(mean_radius, rebuilt_radius, gain)`: the mean radius of the leaves at some places of the mesh,
        what it would be in a new index, and their ratio. The time of a query is about proportional to the radius of the
        leaves around it. After a build, `gain` is about 1; at 1.5 and above a new index pays off if many queries
        follow. Takes some milliseconds, and a pass over the positions.

        >>> meshhood.MeshIndex(V, F).quality().gain < 1.5
        True
        """
        return Quality(*self._exact.quality())

    def save(self, path: Union[str, os.PathLike[str]], *, faces: bool = False, progress: Progress = None) -> None:
        """Writes the index to a file for `load`. The same mesh gives the same bytes on every machine.

        faces : also write the faces that the index keeps, so that the loaded index has them: 4 bytes for each corner
            and, unless all are triangles, for each face. ValueError if the index has none.
        progress : as for the class, in bytes; each byte is counted twice, for its checksum and for writing it.

        The file holds the positions and the graph of the mesh, and its faces if `faces`. It appears whole or not at
        all: it is written to the same folder under another name, synchronized to disk and renamed. Raises OSError, with
        errno and filename, and KeyboardInterrupt on Ctrl-C; an old file of that name is then unchanged.

        >>> meshhood.MeshIndex(V, F).save("hand.mhi", faces=True)
        """
        path = _convert.path(path)
        arrays = self._own_faces("faces: True, but") if faces else None
        exact = self._placed("saved")
        with reporter(progress, "save", "bytes") as report:
            _core.save(exact, path, faces=arrays, progress=report)


def _copied(positions: Any, rows: Any) -> Any:
    """A copy, because another thread may write to `positions` once they are checked. With `rows`, only these are set:
    the system provides no memory for pages that nothing is written to."""
    if rows is None:
        return np.array(positions)
    copy = np.empty_like(positions)
    copy[rows] = positions[rows]
    return copy


def _joined(scales: list[Any]) -> tuple[Any, Any, Any]:
    """The rows of all scales as those of one call."""
    if len(scales) == 1:
        return scales[0]
    offsets, indices, distances = zip(*scales)
    begins = np.cumsum([0, *(int(each[-1]) for each in offsets[:-1])])
    joined = [offsets[0][:1], *(begin + each[1:] for begin, each in zip(begins, offsets))]
    whole = None if distances[0] is None else np.concatenate(distances)
    return np.concatenate(joined), np.concatenate(indices), whole


def _as_size(count: float) -> str:
    for unit in ("bytes", "kB", "MB"):
        if count < 1000:
            return f"{count:.4g} {unit}"
        count /= 1000
    return f"{count:.4g} GB"


def _unpickled(cls: type[MeshIndex], saved: Any, faces: Any) -> MeshIndex:
    # A copy, because arrays that were sent out of band are memory of the caller.
    kept = faces and kept_faces([None if array is None else np.array(array) for array in faces])
    return cls._holding(_core.from_bytes(np.frombuffer(saved, np.uint8)), kept)
