# SPDX-License-Identifier: MIT
"""PyVista: cut the ball out of the mesh, then take the connected region of the vertex."""
import numpy as np

from .peer import Peer


class PyVista(Peer):
    name = "PyVista extract_points, then connectivity"
    package = "pyvista"
    module = "pyvista"
    answers = "exact, by whole faces"
    remark = "a call for each; one thread in any case"

    def __init__(self, positions, triangles, path, threads):
        import pyvista

        self.positions = positions.astype(np.float64)
        self.mesh = pyvista.PolyData.from_regular_faces(positions, triangles)
        self.mesh["vertex"] = np.arange(len(positions))

    def ask(self, vertices, radius):
        return [self.neighborhood(v, radius) for v in vertices]

    def neighborhood(self, v, radius):
        inside = np.linalg.norm(self.positions - self.positions[v], axis=1) <= radius
        cut = self.mesh.extract_points(inside, adjacent_cells=False, include_cells=True)
        seed = np.flatnonzero(cut["vertex"] == v)
        return cut.connectivity("point_seed", point_ids=seed)["vertex"]
