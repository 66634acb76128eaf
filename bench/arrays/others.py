# SPDX-License-Identifier: MIT
"""Libraries that answer something comparable: curvature, rings, balls in space, distances along the surface."""
import numpy as np

from .tool import OneByOne, Tool, mean_of_rows


class Libigl(Tool):
    name = "libigl principal_curvature"
    package, module = "libigl", "igl"
    answers = "ball"
    remark = "the component of the vertex in the ball; one thread"
    questions = ("curvature",)
    real, integer = np.float64, np.int64

    def curvature(self, built, scale):
        import igl

        return igl.principal_curvature(self.V, self.F, scale.edges, False)


class ScipyTree(Tool):
    name = "SciPy cKDTree"
    package, module = "scipy", "scipy.spatial"
    answers = "ball"
    questions = ("counts", "ids")
    real = np.float64

    def build(self):
        from scipy.spatial import cKDTree

        return cKDTree(self.V)

    def counts(self, tree, scale):
        return tree.query_ball_point(self.V, scale.radius, workers=self.threads, return_length=True)

    def ids(self, tree, scale):
        return tree.query_ball_point(self.V, scale.radius, workers=self.threads)

    def found(self, question, answer):
        return super().found(question, answer) if question == "counts" else sum(map(len, answer)) / len(self.V)


class ScipyMatrix(Tool):
    name = "SciPy power of the sparse matrix"
    package, module = "scipy", "scipy.sparse"
    answers = "k rings"
    remark = "one thread; mean: of the ids, by NumPy"
    questions = ("ids", "mean")

    def build(self):
        from scipy.sparse import csr_array

        rows, columns = self.F[:, [0, 1, 2, 0, 1, 2]].ravel(), self.F[:, [1, 2, 0, 2, 0, 1]].ravel()
        ids = np.arange(len(self.V), dtype=np.int32)
        rows, columns = np.concatenate([rows, ids]), np.concatenate([columns, ids])
        return csr_array((np.ones(len(rows), bool), (rows, columns)), shape=(len(self.V), len(self.V)))

    def ids(self, matrix, scale):
        power = matrix
        for _ in range(scale.edges - 1):
            power = power @ matrix
        return power.indptr, power.indices

    def mean(self, matrix, scale):
        return mean_of_rows(self.signal, *self.ids(matrix, scale))


class Open3d(Tool):
    name = "Open3D fixed_radius_search"
    package = module = "open3d"
    answers = "ball"
    remark = "mean: of the ids, by NumPy"
    questions = ("ids", "mean")

    def build(self):
        import open3d

        self.points = open3d.core.Tensor(self.V)
        return open3d.core.nns.NearestNeighborSearch(self.points)

    def ids(self, search, scale):
        search.fixed_radius_index(scale.radius)
        ids, _, offsets = search.fixed_radius_search(self.points, scale.radius, sort=False)
        return offsets.numpy(), ids.numpy()

    def mean(self, search, scale):
        return mean_of_rows(self.signal, *self.ids(search, scale))


class PyVista(OneByOne):
    name = "PyVista point_neighbors_levels"
    package = module = "pyvista"
    answers = "k rings"
    remark = "a call for each vertex"

    def build(self):
        import pyvista

        return pyvista.PolyData.from_regular_faces(self.V, self.F)

    def neighborhood(self, mesh, v, scale):
        return [v, *(id for level in mesh.point_neighbors_levels(v, scale.edges) for id in level)]


class Potpourri3d(OneByOne):
    name = "potpourri3d heat method"
    package = module = "potpourri3d"
    answers = "distance along the surface"
    remark = "a call for each vertex"
    real = np.float64

    def build(self):
        import potpourri3d

        return potpourri3d.MeshHeatMethodDistanceSolver(self.V, self.F)

    def neighborhood(self, solver, v, scale):
        return np.flatnonzero(solver.compute_distance(v) <= scale.radius)


class Pygeodesic(OneByOne):
    name = "pygeodesic exact distances"
    package, module = "pygeodesic", "pygeodesic.geodesic"
    answers = "distance along the surface"
    remark = "a call for each vertex"
    real = np.float64
    SAMPLE = 1

    def build(self):
        from pygeodesic.geodesic import PyGeodesicAlgorithmExact

        return PyGeodesicAlgorithmExact(self.V, self.F)

    def neighborhood(self, solver, v, scale):
        return np.flatnonzero(solver.geodesicDistances([v])[0] <= scale.radius)
