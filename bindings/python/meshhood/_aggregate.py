# SPDX-License-Identifier: MIT
"""Values over neighborhoods."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal, Optional, Union, get_args, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _convert, _core
from ._held import Held
from ._mesh import only_part, whole_mesh_arrays
from ._optional import optional
from ._progress import Progress
from ._rows import check_one_given, check_size, read_rows, result_dtype
from ._types import AnyVertices, Floats, Mask, Metric, Number, Radii, Scales, Unit, Vertex, Vertices, Weights

if TYPE_CHECKING:
    from numpy.typing import DTypeLike
    from scipy.sparse import csr_array

Reduce = Literal["sum", "mean", "min", "max", "var", "std", "count", "median", "quantile"]
Reductions = Union[Reduce, Sequence[Reduce]]
Missing = Literal["propagate", "omit"]
Nesting = Literal["own", "patch"]
Kernel = Literal["box", "epanechnikov", "biweight", "gaussian"]


def smoothing_radius(fwhm: Number) -> float:
    """The radius of the kernel "gaussian" of this full width at half maximum, in the same unit, at which its weight is
    1/1000: fwhm * sqrt(log2(1000)) / 2, which is 1.57843 fwhm.

    >>> round(meshhood.smoothing_radius(6.0), 4)
    9.4706
    """
    return float(_core.smoothing_radius(_convert.finite(fwhm, "fwhm", or_zero=True)))


def vertex_areas(V: Any, F: Any = None) -> NDArray[np.float64]:
    """The area that each vertex represents: each face gives equal shares to its corners, a third of a triangle. (#V,)
    float64, in the square of the unit of V. V and F as for `MeshIndex`. The area of a polygon is the length
    of its vector area: of one that is not plane, less than that of its triangles, which patches measure.

    >>> bool(abs(meshhood.vertex_areas(V, F).sum() - 4 * np.pi) < 0.2)
    True
    """
    return _core.vertex_areas(whole_mesh_arrays(V, F))


class Aggregates(Held):
    """The part of `MeshIndex` that computes values over neighborhoods."""

    @overload
    def aggregate(
        self, values: ArrayLike, r: Optional[Radii] = None, reduce: Reductions = "mean", *, vertices: Vertices = None,
        scales: Optional[Scales] = None, weights: Weights = None, kernel: Optional[Kernel] = None,
        nan: Missing = "propagate", nesting: Nesting = "own", ddof: int = 0, q: Number = 0.5, F: Any = None,
        metric: Metric = "straight", walls: Mask = None, ignored: Mask = None, unit: Unit = "mesh",
        dtype: Optional[DTypeLike] = None, max_bytes: Optional[int] = None, workers: int = -1, progress: Progress = None,
    ) -> Floats: ...  # fmt: skip

    @overload
    def aggregate(
        self, values: ArrayLike, r: Optional[Radii] = None, reduce: Reductions = "mean", *, vertices: Vertex,
        scales: Optional[Scales] = None, weights: Weights = None, kernel: Optional[Kernel] = None,
        nan: Missing = "propagate", nesting: Nesting = "own", ddof: int = 0, q: Number = 0.5, F: Any = None,
        metric: Metric = "straight", walls: Mask = None, ignored: Mask = None, unit: Unit = "mesh",
        dtype: Optional[DTypeLike] = None, max_bytes: Optional[int] = None, workers: int = -1, progress: Progress = None,
    ) -> Union[float, Floats]: ...  # fmt: skip

    def aggregate(
        self,
        values: ArrayLike,
        r: Optional[Radii] = None,
        reduce: Reductions = "mean",
        *,
        vertices: AnyVertices = None,
        scales: Optional[Scales] = None,
        weights: Weights = None,
        kernel: Optional[Kernel] = None,
        nan: Missing = "propagate",
        nesting: Nesting = "own",
        ddof: int = 0,
        q: Number = 0.5,
        F: Any = None,
        metric: Metric = "straight",
        walls: Mask = None,
        ignored: Mask = None,
        unit: Unit = "mesh",
        dtype: Optional[DTypeLike] = None,
        max_bytes: Optional[int] = None,
        workers: int = -1,
        progress: Progress = None,
    ) -> Any:
        """A sum, a mean or another aggregate of values over the exact neighborhood of each vertex.

        values : (#V,) or (#V, ...), numbers or bools; each channel by itself. Copied. Or a SurfaceImage of nilearn with
            one part.
        r, scales, vertices, F, walls, ignored, metric, unit, max_bytes, workers, progress : see `MeshIndex`.
        reduce : "sum", "mean", "min", "max", "var", "std", "count", "median" or "quantile"; or several, which share one
            search.
        weights : (#V,) finite and >= 0, for sum, mean, var and std, which leave out a vertex of weight 0; "area" for
            `vertex_areas`, of `F`. The others ignore them.
        kernel : for sum and mean, how the weight falls with the distance d. None or "box": not at all; "epanechnikov":
            1 - (d/r)^2; "biweight": (1 - (d/r)^2)^2; "gaussian": 1000^-(d/r)^2, of the full width at half maximum whose
            `smoothing_radius` is r.
        nan : "propagate", a neighborhood with a NaN gives NaN, but its count is that of all vertices; "omit", NaN marks a
            missing value, which is left out.
        nesting : what scales mean. "own": each has its own neighborhoods. "patch": the neighborhoods of the largest,
            and of them the vertices within each smaller radius. With metric="path" or "rings" both are the same.
        ddof : "var" and "std" divide by the number of values minus this, 0 or 1; 1 is refused with weights.
        q : for "quantile", 0 to 1, with linear interpolation as in numpy.quantile.
        dtype : of the result, float32 or float64. Without it, that of `values` if float32, else float64. All sums are
            computed in float64.

        Returns an axis of scales if there are any, one of vertices unless `vertices` is a single one, the axes of `values`
        but the first, and one of reductions unless `reduce` is one name. NaN where a neighborhood has no values; 0 for
        their sum and their count.

        No ids are listed. The cost is that of `counts` and a little for each channel; for medians and quantiles, all
        values of a channel are sorted first. Sums are exact to 1e-14 of the sum of the absolute terms, with a kernel to
        1e-13 of the sum without it. A result does not depend on the other vertices of the call, bit for bit. With a
        kernel, its last bits may depend on whether `values` have more than 16 channels, and on whether one of them
        exceeds 2^300.

        >>> index = meshhood.MeshIndex(V, F)
        >>> index.aggregate(V, 0.3, "std", weights="area").shape
        (642, 3)
        >>> index.aggregate(V[:, 2], scales=[0.2, 0.4], vertices=[42, 43]).shape
        (2, 2)
        >>> mean, std, most = index.aggregate(V[:, 2], 0.3, ("mean", "std", "max")).T
        """
        rows = read_rows(self, vertices, r, scales, metric, walls, ignored, unit, workers, progress)
        given = _values(values, self._count)
        dtype = result_dtype(dtype, np.float32 if given.dtype == np.float32 else np.float64)
        names, axis = read_reductions(reduce)
        shape = rows.shape + given.shape[1:] + axis
        check_size(shape, 8, max_bytes)
        falling = "box" if kernel is None else _convert.choice(kernel, "kernel", get_args(Kernel))
        options = {
            "reduce": [getattr(_core.Reduce, name) for name in names],
            "kernel": getattr(_core.SmoothingKernel, falling),
            "missing": getattr(_core.MissingValues, _convert.choice(nan, "nan", get_args(Missing))),
            "nesting": getattr(_core.Nesting, _convert.choice(nesting, "nesting", get_args(Nesting))),
            "ddof": _convert.integer(ddof, "ddof", 0, 1),
            "quantile": _convert.share(q, "q"),
        }
        if falling != "box" and not {"sum", "mean"}.issuperset(names):
            raise ValueError(f"kernel: {kernel!r}, expected None or 'box' with reduce={reduce!r}")
        areas = area_weights(self, weights, F)
        if 0 in given.shape[1:]:
            return np.empty(shape, dtype)
        columns = np.array(given, np.float64, order="C").reshape(self._count, int(np.prod(given.shape[1:])))
        result = rows.ask(_core.aggregate, rows.index._exact, values=columns, weights=areas, **options)
        result = result.reshape(shape).astype(dtype, copy=False)
        return result if result.ndim else float(result)

    def smooth(
        self,
        values: ArrayLike,
        fwhm: Optional[Radii] = None,
        *,
        vertices: Vertices = None,
        scales: Optional[Scales] = None,
        weights: Weights = None,
        nan: Missing = "propagate",
        F: Any = None,
        metric: Metric = "straight",
        walls: Mask = None,
        ignored: Mask = None,
        unit: Unit = "mesh",
        dtype: Optional[DTypeLike] = None,
        max_bytes: Optional[int] = None,
        workers: int = -1,
        progress: Progress = None,
    ) -> Floats:
        """The values smoothed by a Gaussian of this full width at half maximum: the mean with the weights
        exp(-4 ln 2 (d / fwhm)^2) by the distance d, cut where they are below 1/1000.

        fwhm : > 0, or one for each row; or several as `scales`. A distance in `unit`: straight, along the surface or
            along edges, as `metric` says. Vertices farther away than `smoothing_radius(fwhm)`, 1.578 fwhm, or not
            connected within that distance, have no influence; one at exactly that distance has the weight 1/1000. With
            the straight metric, two banks are not mixed as long as the path over the bottom between them leaves the
            ball; once it fits, the other bank counts by its straight distance (docs/aggregate.md). With
            metric="surface" or "path" it counts by the length of the path.
        weights : None counts each vertex once; "area" weighs it by its area, and makes the result independent of how
            densely the surface is sampled.
        The other arguments are those of `aggregate`, which this calls with reduce="mean" and kernel="gaussian", but
        `vertices` is never a single one. Vertices that are walls get NaN.

        >>> index = meshhood.MeshIndex(V, F)
        >>> smooth = index.smooth(V[:, 2], 0.5, metric="surface", walls=V[:, 2] < -0.9)
        """
        r, scales, vertices = _smoothing_radii(fwhm, scales, vertices, self._count)
        return self.aggregate(
            values, r, kernel="gaussian", vertices=vertices, scales=scales, weights=weights, nan=nan, F=F, metric=metric,
            walls=walls, ignored=ignored, unit=unit, dtype=dtype, max_bytes=max_bytes, workers=workers, progress=progress,
        )  # fmt: skip

    def smoothing_matrix(
        self,
        fwhm: Optional[Radii] = None,
        *,
        vertices: Vertices = None,
        scales: Optional[Scales] = None,
        weights: Weights = None,
        F: Any = None,
        metric: Metric = "straight",
        walls: Mask = None,
        ignored: Mask = None,
        unit: Unit = "mesh",
        dtype: Optional[DTypeLike] = None,
        max_bytes: Optional[int] = None,
        workers: int = -1,
        progress: Progress = None,
    ) -> csr_array:
        """What `smooth` does, as a scipy.sparse.csr_array (#rows, #V), or with scales (#scales * #rows, #V): its product
        with values (#V, ...) are the smoothed values, up to rounding, for values without NaN. Each row sums to 1, or is
        NaN: that of a vertex without a neighborhood, as a wall, has one NaN at itself, and one whose weights are all
        0 has NaN for each.

        The arguments are those of `smooth`, without `values` and `nan`; `dtype` is float64 unless given. Memory: 12 bytes
        for each vertex of each neighborhood. Needs SciPy. `smooth` is faster, unless the same matrix is used many times.

        >>> index = meshhood.MeshIndex(V, F)
        >>> W = index.smoothing_matrix(0.5, weights="area")
        >>> np.allclose(W @ V[:, 2], index.smooth(V[:, 2], 0.5, weights="area"))
        True
        """
        csr_array = optional("scipy.sparse", "smoothing_matrix").csr_array
        areas = area_weights(self, weights, F)
        r, scales, vertices = _smoothing_radii(fwhm, scales, vertices, self._count)
        graph = self.radius_neighbors_graph(
            r, vertices, scales=scales, mode="distance", metric=metric, walls=walls, ignored=ignored, unit=unit,
            max_bytes=max_bytes, workers=workers, progress=progress,
        )  # fmt: skip
        sizes = np.diff(graph.indptr)
        radii = np.atleast_1d(self._scale(unit, metric) * (r if scales is None else scales))
        radii = np.repeat(np.repeat(radii, len(sizes) // max(len(radii), 1)), sizes)
        data = _core.smoothing_weights(_core.SmoothingKernel.gaussian, graph.data, radii)
        if areas is not None:
            data *= areas[graph.indices]
        sums = csr_array((data, graph.indices, graph.indptr), shape=graph.shape).sum(axis=1)
        with np.errstate(invalid="ignore"):
            data /= np.repeat(sums, sizes)
        graph.data = data.astype(result_dtype(dtype), copy=False)
        return _nan_where_empty(graph, np.arange(self._count) if vertices is None else np.asarray(vertices))


def _nan_where_empty(graph: Any, rows: Any) -> Any:
    """The matrix with a NaN in each empty row, at its vertex. `rows`: the vertices, those of each scale."""
    empty = np.flatnonzero(np.diff(graph.indptr) == 0)
    if not empty.size:
        return graph
    places = graph.indptr[empty]
    data = np.insert(graph.data, places, np.nan)
    indices = np.insert(graph.indices, places, rows[empty % len(rows)])
    indptr = graph.indptr + np.searchsorted(empty, np.arange(len(graph.indptr)))
    return type(graph)((data, indices, indptr), shape=graph.shape)


def _smoothing_radii(fwhm: Any, scales: Any, vertices: Any, count: int) -> tuple[Any, Any, Any]:
    """The radii of the kernels and of their scales, one of which is None, and the vertices, read before `progress` may
    change them."""
    check_one_given(fwhm, scales, "fwhm")
    _convert.refuse_one(vertices, count)
    if vertices is not None:
        ids = _convert.vertices(vertices, count)
        count = len(ids)
        vertices = ids.tolist() if isinstance(vertices, (list, tuple)) else ids  # so that it is read alike again
    radii = _kernel_radii(fwhm, "fwhm")
    if radii is not None:  # which rows they belong to, by the name that they have here
        radii = _convert.radii(radii, count, "fwhm")
    return radii, _kernel_radii(scales, "scales"), vertices


def _kernel_radii(fwhm: Any, name: str) -> Any:
    if fwhm is None or _convert.is_single(fwhm, name):
        return None if fwhm is None else smoothing_radius(_convert.finite(fwhm, name, or_zero=False))
    widths = _copied(fwhm, name, "iuf")
    wrong = np.argwhere(~((widths > 0) & (widths < np.inf)))
    if wrong.size:
        at = tuple(wrong[0])
        what = "row" if name == "fwhm" else "value"
        raise ValueError(f"{name}: {what} {at[0]}: {widths[at]}, expected a finite number > 0")
    return np.array([_core.smoothing_radius(width) for width in widths.flat]).reshape(widths.shape)


def _values(values, count):
    """`values` as an array of numbers."""
    if hasattr(values, "mesh") and hasattr(values, "data"):  # nilearn's SurfaceImage
        values = only_part(values.data.parts, "values")
    array = _convert.numbers(values, "values", "biuf")
    if array.ndim == 0 or array.shape[0] != count:
        raise ValueError(f"values: expected an array of shape ({count},) or ({count}, ...), not {array.shape}")
    return array


def read_reductions(reduce: Any) -> tuple[tuple[str, ...], tuple[int, ...]]:
    """The names, and the axis that they add to the result."""
    names = _convert.some_choices(reduce, "reduce", get_args(Reduce))
    return names, () if isinstance(reduce, str) else (len(names),)


def area_weights(index: Held, weights: Any, F: Any) -> Any:
    """`weights` as float64, those that the surface keeps if they are "area"; None if there are none."""
    if weights is None:
        return None
    if isinstance(weights, str):
        _convert.choice(weights, "weights", ("area",))
        return index._surface(F, instead=" or numbers as weights=").vertex_areas()
    return read_weights(weights, range(index._count))


def read_weights(weights: Any, vertices: Any) -> NDArray[np.float64]:
    """The weights of these vertices, checked."""
    array = _copied(weights, "weights", "biuf")
    if array.shape != (len(vertices),):
        raise ValueError(f"weights: expected an array of shape ({len(vertices)},), not {array.shape}")
    wrong = np.flatnonzero(~((array >= 0) & (array < np.inf)))
    if wrong.size:
        raise ValueError(f"weights: vertex {vertices[wrong[0]]}: {array[wrong[0]]}, expected a finite number >= 0")
    return array


def _copied(values, name, kinds):
    """`values` as a new float64 array in C order. A copy, because a `progress` function or another thread may write to
    `values` after they are checked."""
    return np.array(_convert.numbers(values, name, kinds), dtype=np.float64, order="C")
