# SPDX-License-Identifier: MIT
"""PyMeshLab has no such query. The closest one is the distance along the surface from a point, up to a limit."""
import numpy as np

from .peer import OneByOne


class PyMeshLab(OneByOne):
    name = "PyMeshLab geodesic distance, maxdistance"
    package = "pymeshlab"
    module = "pymeshlab"
    answers = "distance along the surface"

    def __init__(self, mesh, threads):
        import pymeshlab

        self.pymeshlab = pymeshlab
        self.positions = mesh.positions.astype(np.float64)
        self.meshes = pymeshlab.MeshSet()
        self.meshes.add_mesh(pymeshlab.Mesh(self.positions, mesh.triangles))

    def neighborhood(self, v, radius):
        self.meshes.compute_scalar_by_geodesic_distance_from_given_point_per_vertex(
            startpoint=self.positions[v], maxdistance=self.pymeshlab.PureValue(radius))
        distances = self.meshes.current_mesh().vertex_scalar_array()
        # The distance is 0 beyond the limit, too.
        reached = (distances > 0) & (distances <= radius)
        reached[v] = True
        return np.flatnonzero(reached)
