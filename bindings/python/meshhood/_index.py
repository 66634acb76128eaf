# SPDX-License-Identifier: MIT
"""The index of a mesh, with an interface like that of SciPy's trees."""

from __future__ import annotations

import copyreg
import os
import pickle
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, Optional, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _aggregate, _convert, _core, _moments
from ._curvature import Curvature, Surfaces, curvature
from ._mesh import face_arrays, kept_faces, mesh_arrays, moved_positions, warn_if_unwelded
from ._methods import Method, Methods
from ._progress import Progress, reporter
from ._queries import Queries

if TYPE_CHECKING:
    from scipy.sparse import csr_array

Ids = NDArray[np.int32]
Offsets = NDArray[np.int64]
Counts = NDArray[np.int64]
Reals = NDArray[np.float64]
Vertex = Union[int, "np.integer[Any]"]
Vertices = Union[Sequence[int], "NDArray[np.integer[Any]]", NDArray[np.bool_], None]
Number = Union[float, "np.floating[Any]", "np.integer[Any]"]
Radii = Union[Number, Sequence[float], "NDArray[np.floating[Any]]", "NDArray[np.integer[Any]]"]
Unit = Literal["mesh", "edge"]
Metric = Literal["straight", "path"]
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


class MeshIndex(Queries):
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

    _exact: Any
    _faces: Any  # corners and offsets, as `face_arrays` returns them, or None
    _methods: Methods
    _surfaces: Surfaces
    _queries: Any
    _count: int

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
        self._hold(exact, kept_faces(F, corners, offsets) if keep_faces else None)
        warn_if_unwelded(positions, corners, offsets, stacklevel=3)

    @classmethod
    def _holding(cls, exact: Any, faces: Any = None) -> MeshIndex:
        self = cls.__new__(cls)
        self._hold(exact, faces)
        return self

    def _hold(self, exact: Any, faces: Any) -> None:
        self._exact = exact
        self._faces = faces
        self._methods = Methods(exact)
        self._surfaces = Surfaces(exact)
        self._queries = _core.queries(exact)
        self._count = exact.vertex_count

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
        attributes = {name: value for name, value in vars(self).items() if name not in MeshIndex.__annotations__}
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
        """Memory of the index in bytes, including its copies of the positions and of the faces. The other methods, `positions` and
        `mean_edge_length` need additional memory once they are used."""
        return self._exact.nbytes + sum(array.nbytes for array in self._faces or () if array is not None)

    @property
    def positions(self) -> Union[NDArray[np.float32], NDArray[np.float64]]:
        """The positions: (#V, 3), in the numbering and precision of V, read-only. Extracted at the first use, then
        kept."""
        return self._methods.graph().positions

    @property
    def faces(self) -> Union[Ids, tuple[NDArray[np.signedinteger[Any]], Ids], None]:
        """The faces: (#F, 3) int32, or a tuple (offsets, corners) unless all are triangles; read-only, not copied. None
        if the index has none: it was built with keep_faces=False or from a graph, or loaded from a file."""
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
        self,
        v: Vertex,
        r: Number,
        *,
        return_distance: Literal[False] = False,
        sort: bool = False,
        method: Method = "exact",
        metric: Metric = "straight",
        unit: Unit = "mesh",
        workers: int = -1,
        max_bytes: Optional[int] = None,
        progress: Progress = None,
    ) -> Ids: ...

    @overload
    def query_ball(
        self,
        v: Vertex,
        r: Number,
        *,
        return_distance: Literal[True],
        sort: bool = False,
        method: Method = "exact",
        metric: Metric = "straight",
        unit: Unit = "mesh",
        workers: int = -1,
        max_bytes: Optional[int] = None,
        progress: Progress = None,
    ) -> tuple[Ids, Reals]: ...

    @overload
    def query_ball(
        self,
        v: Vertices,
        r: Radii,
        *,
        return_distance: Literal[False] = False,
        sort: bool = False,
        method: Method = "exact",
        metric: Metric = "straight",
        unit: Unit = "mesh",
        workers: int = -1,
        max_bytes: Optional[int] = None,
        progress: Progress = None,
    ) -> tuple[Offsets, Ids]: ...

    @overload
    def query_ball(
        self,
        v: Vertices,
        r: Radii,
        *,
        return_distance: Literal[True],
        sort: bool = False,
        method: Method = "exact",
        metric: Metric = "straight",
        unit: Unit = "mesh",
        workers: int = -1,
        max_bytes: Optional[int] = None,
        progress: Progress = None,
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
    def count(
        self,
        v: Vertex,
        r: Number,
        *,
        method: Method = "exact",
        metric: Metric = "straight",
        unit: Unit = "mesh",
        workers: int = -1,
        progress: Progress = None,
    ) -> int: ...

    @overload
    def count(
        self,
        v: Vertices,
        r: Radii,
        *,
        method: Method = "exact",
        metric: Metric = "straight",
        unit: Unit = "mesh",
        workers: int = -1,
        progress: Progress = None,
    ) -> Counts: ...

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

    def aggregate(
        self,
        values: ArrayLike,
        r: Radii,
        reduce: _aggregate.Reduce = "mean",
        *,
        weights: Union[Literal["area"], ArrayLike, None] = None,
        kernel: Optional[_aggregate.Kernel] = None,
        vertices: Union[Vertex, Vertices] = None,
        nan: Literal["propagate", "omit"] = "propagate",
        nesting: Literal["own", "patch"] = "own",
        ddof: int = 0,
        F: Any = None,
        unit: Unit = "mesh",
        workers: int = -1,
        max_bytes: Optional[int] = None,
        progress: Progress = None,
    ) -> Any:
        """A sum, a mean or another aggregate of values over the exact neighborhood of each vertex.

        values : (#V,) or (#V, ...), numbers or bools; each channel by itself. Copied as float64.
        r : the radius, >= 0 or inf, or several. A vertex at exactly `r` is inside.
        reduce : "sum", "mean", "min", "max", "var", "std" or "count".
        weights : (#V,) finite and >= 0, for sum, mean, var and std; "area" for `vertex_areas`. A vertex of weight 0
            is left out.
        kernel : for sum and mean, how the weight falls with the distance d. None: not at all; "epanechnikov":
            1 - (d/r)^2; "biweight": (1 - (d/r)^2)^2, which is close to a Gaussian of the standard deviation 0.4 r.
        vertices : a vertex, a sequence of vertices, a bool mask (#V,), or None for all.
        nan : "propagate", a neighborhood with a NaN gives NaN; "omit", NaN marks a missing value, which is left out.
        nesting : what several radii mean. "own": each has its own neighborhoods. "patch": the neighborhoods of the
            largest, and of them the vertices within each smaller radius.
        ddof : "var" and "std" divide by the number of values minus this, 0 or 1.
        F : other faces than those that the index keeps, for weights="area".
        unit, workers, max_bytes, progress : as for `query_ball`. The result does not depend on `workers`.

        Returns float64: an axis of radii if `r` is a sequence, one of vertices unless `vertices` is a single one, then
        the axes of `values` but the first. NaN where a neighborhood has no values; 0 for their sum.

        No ids are listed. The cost is that of `count` for all vertices and a little for each channel. Sums
        are exact to 1e-14 of the sum of the absolute terms, with a kernel to 1e-13 of the sum without it. A result does
        not depend on the other vertices of the call, bit for bit.
        """
        return _aggregate.aggregate(
            self,
            values,
            r,
            self._scale(unit),
            vertices,
            F,
            reduce=reduce,
            weights=weights,
            kernel=kernel,
            nan=nan,
            nesting=nesting,
            ddof=ddof,
            workers=workers,
            max_bytes=max_bytes,
            progress=progress,
        )

    def smooth(
        self,
        values: ArrayLike,
        fwhm: Number,
        *,
        weights: Union[Literal["area"], ArrayLike, None] = None,
        nan: Literal["propagate", "omit"] = "propagate",
        F: Any = None,
        unit: Unit = "mesh",
        workers: int = -1,
        max_bytes: Optional[int] = None,
        progress: Progress = None,
    ) -> Reals:
        """The values smoothed by a biweight that is close to a Gaussian of this full width at half maximum.

        fwhm : > 0, a straight-line distance in `unit`. Vertices farther away than 1.06 fwhm, or not connected within
            that distance, have no influence: nothing is smoothed across a gap.
        weights : None counts each vertex once; "area" weighs it by its area, and makes the result independent of how
            densely the surface is sampled.
        See `aggregate`, which this calls with reduce="mean" and kernel="biweight". Returns float64 of the shape of
        `values`.
        """
        fwhm = _convert.finite(fwhm, "fwhm", or_zero=False)
        return self.aggregate(
            values,
            _core.smoothing_radius(fwhm),
            kernel="biweight",
            weights=weights,
            nan=nan,
            F=F,
            unit=unit,
            workers=workers,
            max_bytes=max_bytes,
            progress=progress,
        )

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

    def curvature(
        self,
        r: Union[Radii, Sequence[float]],
        vertices: Vertices = None,
        *,
        F: Any = None,
        normals: Any = None,
        like: Literal[None, "libigl"] = None,
        fit: Literal["quadric", "jet"] = "quadric",
        filter: bool = True,
        unit: Unit = "mesh",
        workers: int = -1,
        progress: Progress = None,
    ) -> Curvature:
        """Principal curvatures of `vertices` by a quadric that is fitted to their neighborhoods of radius `r`.

        r : a radius, or a list of radii: the arrays of the result then have a leading axis.
        vertices : a list of vertices, a bool mask, or None for all.
        F : other faces than those that the index keeps. The normals are kept for the next call with the same faces.
        normals : (#V, 3), instead of those of the faces; of any length. NaN where a vertex has none.
        like : "libigl" gives the values of igl.principal_curvature. Its shape operator is wrong where the fitted
            quadric is tilted against the normal, and its neighborhoods have the vertices nearer than `r`.
        fit : "quadric", through the vertex and over its tangent plane, or "jet", over the plane of the principal
            components of the neighborhood: with filter=False CGAL's Monge_via_jet_fitting of degrees 2 and 2.
        filter : fit only vertices whose normal makes an angle of less than 90 degrees with that of the query vertex, if
            there are at least six.
        unit, workers, progress : as for `query_ball`. The result does not depend on `workers`.

        Returns a `Curvature`: k1, k2, d1, d2, state, and as properties mean, gaussian, shape_index, curvedness, ok.
        Raises ValueError without faces and normals. See docs/curvature.md for what the numbers mean.
        """
        if like is not None:
            _convert.choice(like, "like", ("libigl",))
        rows = None if vertices is None else _convert.vertices(vertices, self._count)
        radii = np.array(_convert.as_array(r, "r"))
        several = radii.ndim > 0
        radii = self._scale(unit) * _convert.radii(radii, len(radii) if several else 1)
        options = {"libigl": like == "libigl", "jet": _convert.choice(fit, "fit", ("quadric", "jet")) == "jet"}
        options |= {"filter": bool(filter), "threads": _convert.threads(workers)}
        return curvature(self._surface(F, normals), rows, radii, several, options, progress)

    def corrected_curvature(
        self,
        r: Number,
        vertices: Vertices = None,
        *,
        F: Any = None,
        normals: Any = None,
        unit: Unit = "mesh",
        workers: int = -1,
        progress: Progress = None,
    ) -> _moments.CorrectedCurvature:
        """Curvatures by the interpolated corrected curvature measures (Lachaud et al. 2020; in CGAL 6
        `interpolated_corrected_curvatures`): sums over the faces, without a fit.

        r : the radius of all rows. normals : (#V, 3), instead of those that follow from the faces. The faces are needed
        in any case. The other arguments are as for `curvature`. Returns a `CorrectedCurvature`: area, mean, gaussian, k1, k2, d1,
        d2, measures.
        """
        rows = None if vertices is None else _convert.vertices(vertices, self._count)
        radius = self._scale(unit) * _convert.radius(r)
        return _moments.corrected_curvature(self, radius, rows, F, normals, workers, progress)

    def moments(
        self,
        r: Radii,
        vertices: Vertices = None,
        *,
        degree: int = 2,
        weights: Union[Literal["area"], ArrayLike, None] = None,
        F: Any = None,
        unit: Unit = "mesh",
        workers: int = -1,
        progress: Progress = None,
    ) -> Reals:
        """Sums of w x^i y^j z^k over each neighborhood for i + j + k <= degree, where x, y, z are the coordinates
        relative to the query vertex, and w the weights.

        r : a radius, or one for each row. degree : 0 to 4. weights, F : as for `aggregate`.
        Returns (#rows, 1, 4, 10, 20 or 35) float64: 1, x, y, z, x^2, xy, xz, y^2, yz, z^2, x^3, ..., the order of
        scikit-learn's PolynomialFeatures. They are accurate to 1e-13 of the sum of w |p|^(i + j + k). With other rows
        in the call, the last bits of a row may differ.
        """
        rows, radii, _ = self._batch(vertices, r, self._scale(unit), workers)
        return _moments.moments(self, rows, radii, degree, weights, F, workers, progress)

    def principal_components(
        self,
        r: Radii,
        vertices: Vertices = None,
        *,
        weights: Union[Literal["area"], ArrayLike, None] = None,
        F: Any = None,
        unit: Unit = "mesh",
        workers: int = -1,
        progress: Progress = None,
    ) -> _moments.PrincipalComponents:
        """The mean and the covariance of the positions of each neighborhood: normals, surface variation, and with
        weights="area" the integral invariants area, barycenter and covariance. The arguments are those of `moments`."""
        rows, radii, _ = self._batch(vertices, r, self._scale(unit), workers)
        return _moments.principal_components(self, rows, radii, weights, F, workers, progress)

    def features(
        self,
        r: Union[Number, Sequence[float], ArrayLike],
        vertices: Vertices = None,
        *,
        F: Any = None,
        kinds: Union[str, Sequence[str]] = "crease",
        filter: bool = True,
        unit: Unit = "mesh",
        workers: int = -1,
        progress: Progress = None,
    ) -> Reals:
        """Feature vectors over several radii, without unit, so that scales can be compared.

        r : radii, > 0, for example `geometric_radii(a, b, count)`.
        kinds : one name or several of crease, mean, gaussian, k1, k2, curvedness, shape_index, area, height, variation.
            See docs/curvature.md for what they mean.
        F, filter, unit, workers, progress : as for `curvature`.

        Returns (#radii, #rows, #kinds) float64, without the last axis if `kinds` is one name. NaN where there is no
        result. `persistence` finds over how many radii a feature lasts.
        """
        rows = None if vertices is None else _convert.vertices(vertices, self._count)
        array = np.atleast_1d(np.array(_convert.as_array(r, "r")))
        radii = self._scale(unit) * _convert.radii(array, len(array))
        return _moments.features(self, np.atleast_1d(radii), rows, kinds, F, filter, workers, progress)

    def save(self, path: Union[str, os.PathLike[str]], *, progress: Progress = None) -> None:
        """Writes the index to a file for `load`. The same mesh gives the same bytes on every machine.

        progress : as for the class, in bytes; each byte is counted twice, for its checksum and for writing it.

        The file holds the positions and the graph of the mesh, but not its faces. It appears whole or not at all: it is
        written to the same folder under another name, synchronized to disk and renamed. Raises OSError, with errno and
        filename, and KeyboardInterrupt on Ctrl-C; an old file of that name is then unchanged.
        """
        path = _convert.path(path)
        with reporter(progress) as report:
            _core.save(self._exact, path, progress=report)

    def _method(self, method: Any, metric: Any) -> Any:
        if _convert.choice(metric, "metric", ("straight", "path")) == "path":
            if method != "exact":
                raise ValueError(f"method: {method!r}, expected 'exact' with metric='path'")
            return self._methods.along_edges
        try:
            return self._methods[method]
        except TypeError:
            if method.__hash__ is not None:
                raise
            raise TypeError(f"method: expected a name or a Paper, not {type(method).__name__}") from None

    def _face_arrays(self, F: Any) -> tuple[Any, Any]:
        """Corners and offsets of `F`, or of the faces that the index keeps."""
        if F is not None:
            return face_arrays(F)
        if self._faces is None:
            raise ValueError(
                "F: expected the faces, because this index has none: it was built with keep_faces=False or from a graph, "
                "or loaded from a file"
            )
        return self._faces

    def _surface(self, F: Any, normals: Any) -> Any:
        """The normals of the faces, or `normals`."""
        if normals is None:
            return self._surfaces.of_faces(self._face_arrays(F), is_own=F is None)
        if F is not None:
            raise ValueError("F: expected None, because the normals are given")
        return self._surfaces.of_normals(normals)

    def _scale(self, unit: Any) -> float:
        """The factor from `unit` to the unit of the positions."""
        if unit == "mesh":
            return 1.0
        _convert.choice(unit, "unit", ("mesh", "edge"))
        length = self.mean_edge_length
        if length == 0:
            raise ValueError("unit: 'edge', but the mesh has no edges of positive length")
        return length

    def _batch(self, v: Any, r: Any, scale: float, workers: Any) -> Any:
        rows = None if v is None else _convert.vertices(v, self._count)
        radius = _convert.radii(r, self._count if rows is None else len(rows))
        return rows, scale * radius, _convert.threads(workers)


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
    kept = None if faces is None else kept_faces(None, *faces)
    return cls._holding(_core.from_bytes(np.frombuffer(saved, np.uint8)), kept)
