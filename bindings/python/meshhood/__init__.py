# SPDX-License-Identifier: MIT
"""meshhood: the connected component of a mesh inside a ball around a vertex, exact and indexed.

The neighborhood of vertex v with radius r: of the part of the mesh inside the ball of radius r around v, the connected
component that contains v.

    >>> V, F = meshhood.read_mesh("hand.ply")
    >>> index = meshhood.MeshIndex(V, F)
    >>> near = index.neighborhood(42, 1.5)
    >>> indptr, indices = index.neighborhoods(1.5, [42, 43])

The calls, by what they answer; those without a dot are of `MeshIndex`, and help(meshhood.MeshIndex.count) shows one:

- neighborhoods: neighborhood, neighborhoods, iter_neighborhoods, nested, stroke, contains, count, counts
- the same as a mesh or a graph: faces, submesh, rim, radius_neighbors_graph, meshhood.padded
- nearest vertices: k_nearest, nearest_connected, nearest_unconnected, connecting_radius, discs
- from points in space: nearest, closest_point, first_hit, neighborhood
- the surface in the ball: invariants, measure, gaps, gap, patch, clip; through a wall: thickness
- values on the vertices: smooth, smoothing_matrix, aggregate, meshhood.smoothing_radius, meshhood.vertex_areas
- shape: curvature, corrected_curvature, features, principal_components, moments, meshhood.principal_curvature,
  meshhood.persistence, meshhood.geometric_radii
- other indexes: from_points, of_faces, masked, refit, quality, save, meshhood.load
- of an index: positions, permutation, mean_edge_length, n_vertices, nbytes, meshhood.show_config
- meshes and pictures: meshhood.read_mesh, meshhood.write_mesh, meshhood.weld, meshhood.view, meshhood.plot_neighborhood
- beyond the memory: meshhood.partition, meshhood.open_parts
"""

from . import _core
from ._aggregate import smoothing_radius, vertex_areas
from ._curvature import (
    CorrectedCurvature,
    Curvature,
    Persistence,
    PrincipalComponents,
    geometric_radii,
    persistence,
)
from ._files import Mesh, load, read_mesh, write_mesh
from ._index import Chunk, MeshIndex, Quality
from ._libigl import principal_curvature
from ._methods import Paper
from ._padded import padded
from ._partition import partition
from ._patches import Gap, Gaps, Invariants, Measure
from ._plot import plot_neighborhood
from ._queries import Connected, Nested
from ._regions import RimLine, Submesh
from ._surface_queries import ClosestPoint, Discs, FirstHit, Nearest, Unconnected
from ._view import Page, view
from ._weld import Welded, weld
from .distributed import open_parts

__version__: str = _core.__version__


def show_config() -> None:
    """Prints the version and the instructions that the inner loops use on this processor, by the names of Google
    Highway: AVX3 for AVX-512, AVX2, SSE4, NEON, or SCALAR for none but those of every processor. Answers do not depend
    on them, only their speed.

    >>> meshhood.show_config()  # doctest: +ELLIPSIS
    meshhood ...
    """
    print(f"meshhood {__version__}, kernels for {_core.kernel_target()}")


__all__ = [
    "Chunk",
    "ClosestPoint",
    "Connected",
    "CorrectedCurvature",
    "Curvature",
    "Discs",
    "FirstHit",
    "Gap",
    "Gaps",
    "Invariants",
    "Measure",
    "Mesh",
    "MeshIndex",
    "Nearest",
    "Nested",
    "Page",
    "Paper",
    "Persistence",
    "PrincipalComponents",
    "Quality",
    "RimLine",
    "Submesh",
    "Unconnected",
    "Welded",
    "__version__",
    "geometric_radii",
    "load",
    "open_parts",
    "padded",
    "partition",
    "persistence",
    "plot_neighborhood",
    "principal_curvature",
    "read_mesh",
    "show_config",
    "smoothing_radius",
    "vertex_areas",
    "view",
    "weld",
    "write_mesh",
]
