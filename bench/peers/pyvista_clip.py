# SPDX-License-Identifier: MIT
"""PyVista: extracts the ball from the mesh, then takes the connected region of the vertex."""
import numpy as np

from .peer import OneByOne


class PyVista(OneByOne):
    name = "PyVista extract_points, then connectivity"
    package = "pyvista"
    module = "pyvista"
    answers = "exact, by whole faces"

    def __init__(self, mesh, threads):
        import pyvista

        self.positions = mesh.positions.astype(np.float64)
        self.mesh = pyvista.PolyData.from_regular_faces(mesh.positions, mesh.triangles)
        self.mesh["vertex"] = np.arange(len(mesh.positions))

    def neighborhood(self, v, radius):
        inside = np.linalg.norm(self.positions - self.positions[v], axis=1) <= radius
        cut = self.mesh.extract_points(inside, adjacent_cells=False, include_cells=True)
        seed = np.flatnonzero(cut["vertex"] == v)
        return cut.connectivity("point_seed", point_ids=seed)["vertex"]
