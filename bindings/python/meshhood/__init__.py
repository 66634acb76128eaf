# SPDX-License-Identifier: MIT
"""meshhood: the neighborhood of a point on a polygonal mesh.

The neighborhood of vertex v with radius r is the part of the mesh inside the ball of radius r around v that hangs
together with v inside that ball.

    V, F = meshhood.read_mesh("hand.ply")
    index = meshhood.MeshIndex(V, F)
    near = index.query_ball(42, 1.5)
    indptr, indices = index.query_ball([42, 43], 1.5)
"""

from ._files import Mesh, load, read_mesh
from ._index import Chunk, MeshIndex
from ._methods import Paper
from ._plot import plot_neighborhood

__all__ = ["Chunk", "Mesh", "MeshIndex", "Paper", "load", "plot_neighborhood", "read_mesh"]
