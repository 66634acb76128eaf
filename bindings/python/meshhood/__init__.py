# SPDX-License-Identifier: MIT
"""meshhood: the connected component of a mesh inside a ball around a vertex, exact and indexed.

The neighborhood of vertex v with radius r: of the part of the mesh inside the ball of radius r around v, the connected
component that contains v.

    V, F = meshhood.read_mesh("hand.ply")
    index = meshhood.MeshIndex(V, F)
    near = index.query_ball(42, 1.5)
    indptr, indices = index.query_ball([42, 43], 1.5)
"""

from . import _core
from ._aggregate import vertex_areas
from ._curvature import Curvature
from ._files import Mesh, load, read_mesh
from ._index import Chunk, MeshIndex, Quality
from ._libigl import principal_curvature
from ._methods import Paper
from ._moments import (
    CorrectedCurvature,
    Persistence,
    PrincipalComponents,
    geometric_radii,
    persistence,
)
from ._partition import partition
from ._plot import plot_neighborhood
from ._region_mesh import RegionMesh, RimLine, Submesh
from ._view import Page, view
from .distributed import open_parts

__version__: str = _core.__version__

__all__ = [
    "Chunk",
    "CorrectedCurvature",
    "Curvature",
    "Mesh",
    "MeshIndex",
    "Page",
    "Paper",
    "Persistence",
    "PrincipalComponents",
    "Quality",
    "RegionMesh",
    "RimLine",
    "Submesh",
    "__version__",
    "geometric_radii",
    "load",
    "open_parts",
    "partition",
    "persistence",
    "plot_neighborhood",
    "principal_curvature",
    "read_mesh",
    "vertex_areas",
    "view",
]
