# SPDX-License-Identifier: MIT
"""The filters of ParaView have the values of the package, errors are one message, and an index is built once.

    pvpython paraview_test.py PLUGIN
"""

import inspect
import sys
import unittest

from built_for import skip_unless_loadable

skip_unless_loadable()
if not hasattr(inspect, "getargspec"):  # ParaView 5.11 with Python 3.11, as in Debian 12
    inspect.getargspec = inspect.getfullargspec

import meshhood
import numpy as np
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkPoints, vtkStringOutputWindow
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

simple.LoadPlugin(sys.argv.pop(), remote=False, ns=vars(simple))


def sphere(**properties):
    return simple.Sphere(ThetaResolution=40, PhiResolution=40, **properties)


def strips():
    return simple.Superquadric(ThetaResolution=64, PhiResolution=64, Toroidal=1)


def torus():
    return simple.Clean(Input=simple.Triangulate(Input=strips()))


def surface_of(mesh):
    polygons = mesh.GetPolys()
    faces = vtk_to_numpy(polygons.GetOffsetsArray()), vtk_to_numpy(polygons.GetConnectivityArray())
    return vtk_to_numpy(mesh.GetPoints().GetData()), faces


def corners_of(faces, face):
    return faces[1][faces[0][face] : faces[0][face + 1]] if isinstance(faces, tuple) else faces[face]


def source_of(mesh):
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(mesh)
    return source


POINTS = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [3, 1, 0], [9, 9, 9]], float)


def mixed_cells():
    """Two vertices, a line, a square, and two triangles that share a side with it, with arrays for points and cells."""
    mesh = vtkPolyData()
    mesh.SetPoints(vtkPoints())
    mesh.GetPoints().SetData(numpy_to_vtk(POINTS, deep=True))
    for setter, cells in (
        (mesh.SetVerts, [[6], [0]]),
        (mesh.SetLines, [[6, 5]]),
        (mesh.SetPolys, [[0, 1, 2, 3], [1, 4, 2], [4, 5, 2]]),
    ):
        array = vtkCellArray()
        for cell in cells:
            array.InsertNextCell(len(cell), cell)
        setter(array)
    for data, name, count in ((mesh.GetPointData(), "point", 7), (mesh.GetCellData(), "cell", 6)):
        values = numpy_to_vtk(np.arange(count) * 10.0, deep=True)
        values.SetName(name)
        data.AddArray(values)
    return mesh


class Filters(unittest.TestCase):
    def setUp(self):
        self.addCleanup(vtkOutputWindow.SetInstance, vtkOutputWindow.GetInstance())
        self.window = vtkStringOutputWindow()  # has also what is printed
        vtkOutputWindow.SetInstance(self.window)

    def result(self, algorithm):
        """The point arrays of its output by name, after it has run without a message."""
        mesh = servermanager.Fetch(algorithm)
        self.assertEqual(self.window.GetOutput(), "")
        data = mesh.GetPointData()
        self.cells, self.field = mesh.GetCellData(), mesh.GetFieldData()
        self.points = mesh.GetNumberOfPoints()
        return {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}

    def message(self, algorithm):
        """The message of a run that fails."""
        before = len(self.window.GetOutput())
        algorithm.UpdatePipeline()
        self.assertEqual(servermanager.Fetch(algorithm).GetNumberOfPoints(), 0)
        return self.window.GetOutput()[before:].strip()

    def test_neighborhoods_are_those_of_the_package(self):
        checked = 0
        for source in (sphere(), torus()):
            index = meshhood.MeshIndex(servermanager.Fetch(source))
            edge = index.mean_edge_length
            for metric, words, said in (
                ("straight", "straight lines", ""),
                ("path", "paths along edges", "path "),
                ("surface", "paths along the surface", "surface "),
            ):
                for start in (0, 77, len(index) - 1):
                    found = simple.MeshhoodNeighborhood(
                        Input=source, Start="vertex id", VertexId=start, Radius=4, Metric=words
                    )
                    arrays = self.result(found)
                    ids, lengths = index.neighborhood(start, 4, unit="edge", metric=metric, return_distance=True)
                    inside = arrays[f"neighborhood {said}r=4 edges"]
                    np.testing.assert_array_equal(np.flatnonzero(inside), np.sort(ids))
                    np.testing.assert_array_equal(arrays[f"distance {said}r=4 edges [unit]"][ids], lengths)
                    self.assertEqual(np.isfinite(arrays[f"distance {said}r=4 edges [unit]"]).sum(), len(ids))
                    self.assertEqual(self.field.GetArray("start_vertex").GetValue(0), start)
                    self.assertEqual(self.field.GetArray("mean_edge_length [unit]").GetValue(0), edge)
                    found.Unit, found.Radius = "units of the points", 0.25
                    ids = index.neighborhood(start, 0.25, metric=metric)
                    inside = self.result(found)[f"neighborhood {said}r=0.25"]
                    np.testing.assert_array_equal(np.flatnonzero(inside), np.sort(ids))
                    checked += 2
        print(f"{checked} neighborhoods", file=sys.__stdout__)

    def test_a_point_stands_for_the_nearest_corner_of_its_face(self):
        for source in (torus(), source_of(mixed_cells())):
            index = meshhood.MeshIndex(*surface_of(servermanager.Fetch(source)))
            found = simple.MeshhoodNeighborhood(Input=source)
            for vertex in range(0, len(index), 1 + len(index) // 7):
                point = index.positions[vertex] * [0.97, 1.05, 1.0] + [0.01, 0.02, 0.03]
                found.Point = list(point)
                self.result(found)
                face, _, on_surface, _ = index.closest_point(point)
                corners = corners_of(index.faces, face)
                nearest = min(corners, key=lambda corner: np.linalg.norm(index.positions[corner] - on_surface))
                self.assertEqual(self.field.GetArray("start_vertex").GetValue(0), nearest)

    def test_the_faces_of_a_neighborhood_keep_their_arrays(self):
        found = simple.MeshhoodNeighborhood(Input=source_of(mixed_cells()), Start="vertex id", VertexId=2)
        found.Unit, found.Radius, found.Output = "units of the points", 1.5, "faces of the neighborhood"
        arrays = self.result(found)
        self.assertEqual(sorted(arrays["point"]), [0, 10, 20, 30, 40])
        self.assertEqual(list(vtk_to_numpy(self.cells.GetArray("cell"))), [30, 40])
        ids = (arrays["point"] / 10).astype(int)
        positions = servermanager.Fetch(found).GetPoints().GetData()
        self.assertEqual(positions.GetDataTypeAsString(), "double")
        np.testing.assert_array_equal(vtk_to_numpy(positions), POINTS[ids])
        distances = np.sqrt([2, 1, 0, 1, 2])[ids]
        np.testing.assert_allclose(arrays["distance r=1.5 [unit]"], distances)
        found.Radius = 0
        self.assertEqual([len(values) for values in self.result(found).values()], [0, 0, 0])
        self.assertEqual((self.points, self.cells.GetNumberOfTuples()), (0, 0))

    def test_thickness_is_that_of_the_package(self):
        for source in (sphere(), torus(), sphere(EndPhi=120)):
            index = meshhood.MeshIndex(servermanager.Fetch(source))
            for method in ("sphere", "ray"):
                arrays = self.result(simple.MeshhoodThickness(Input=source, Method=method))
                np.testing.assert_array_equal(arrays[f"thickness {method} [unit]"], index.thickness(method=method))
        self.assertTrue(np.isinf(arrays["thickness ray [unit]"]).any())  # through the hole

    def test_curvature_and_invariants_are_those_of_the_package(self):
        for source in (sphere(Radius=2), torus()):
            index = meshhood.MeshIndex(servermanager.Fetch(source))
            for metric, words, said in (("straight", "straight lines", ""), ("path", "paths along edges", "path ")):
                found = simple.MeshhoodCurvature(Input=source, Metric=words, Radius=3, AreaAndVolume=1)
                arrays = self.result(found)
                shape = index.curvature(3, unit="edge", metric=metric)
                area, volume = index.invariants(3, unit="edge")
                for name, values in {
                    f"mean_curvature {said}r=3 edges [1/unit]": shape.mean,
                    f"gaussian_curvature {said}r=3 edges [1/unit^2]": shape.gaussian,
                    f"k1 {said}r=3 edges [1/unit]": shape.k1,
                    f"k2 {said}r=3 edges [1/unit]": shape.k2,
                    f"d1 {said}r=3 edges": shape.d1,
                    f"d2 {said}r=3 edges": shape.d2,
                    f"curvedness {said}r=3 edges [1/unit]": shape.curvedness,
                    f"shape_index {said}r=3 edges": shape.shape_index,
                    f"curvature_state {said}r=3 edges": shape.state,
                    "area r=3 edges [unit^2]": area,
                    "volume r=3 edges [unit^3]": volume,
                }.items():
                    np.testing.assert_array_equal(arrays[name], values, name)
                found.AreaAndVolume, found.RadiusInNames = 0, 0
                arrays = self.result(found)
                np.testing.assert_array_equal(arrays["mean_curvature [1/unit]"], shape.mean)
                self.assertEqual([name for name in arrays if "area" in name or "r=" in name], [])

    def test_smoothed_arrays_are_those_of_the_package(self):
        source = torus()
        index = meshhood.MeshIndex(servermanager.Fetch(source))
        V = index.positions
        hole = simple.ProgrammableFilter(
            Input=source,
            Script="import numpy\nz = inputs[0].Points[:, 2]\n"
            "output.PointData.append(numpy.where(z > 0.2, numpy.sin(30 * z), numpy.nan), 'hole')",
            CopyArrays=1,
        )
        values = np.where(V[:, 2] > 0.2, np.sin(30 * V[:, 2]), np.nan)
        for metric, words, said in (
            ("straight", "straight lines", ""),
            ("surface", "paths along the surface", "surface "),
        ):
            for weights in (None, "area"):
                found = simple.MeshhoodSmooth(
                    Input=hole, Array=["POINTS", "hole"], FWHM=4, Metric=words, WeighByArea=int(weights is not None)
                )
                smooth = index.smooth(values, 4, unit="edge", metric=metric, weights=weights, nan="omit")
                np.testing.assert_array_equal(self.result(found)[f"hole {said}fwhm=4 edges"], smooth)
                found.Array = ["POINTS", "Normals"]
                normals = self.result(found)
                smooth = index.smooth(normals["Normals"], 4, unit="edge", metric=metric, weights=weights)
                np.testing.assert_array_equal(normals[f"Normals {said}fwhm=4 edges"], smooth)
                found.RadiusInNames = 0
                unnamed = self.result(found)
                np.testing.assert_array_equal(unnamed["Normals smooth"], smooth)
                np.testing.assert_array_equal(unnamed["Normals"], normals["Normals"])
        self.assertTrue(np.isnan(index.smooth(values, 4, unit="edge", nan="omit")).any())

    def test_errors_are_one_message(self):
        neighborhood = simple.MeshhoodNeighborhood(Input=sphere(), Start="vertex id", VertexId=5000)
        smooth = simple.MeshhoodSmooth(Input=sphere(), Array=["POINTS", "heat"])
        unloadable = simple.MeshhoodThickness(Input=sphere(Radius=3))
        for algorithm, expected in (
            (simple.MeshhoodThickness(Input=strips()), "Meshhood Thickness: Input: has 512 triangle strips, expected"),
            (simple.MeshhoodCurvature(Input=simple.Line()), "Meshhood Curvature: Input: has no polygons"),
            (simple.MeshhoodCurvature(Input=source_of(vtkPolyData())), "Meshhood Curvature: Input: has no polygons"),
            (neighborhood, "Meshhood Neighborhood: start: vertex 5000, but the mesh has 1522 vertices"),
            (smooth, "Meshhood Smooth: Array: 'heat', expected a point array"),
            (unloadable, "Meshhood Thickness: needs the Python package meshhood"),
        ):
            if algorithm is unloadable:
                sys.modules["meshhood"] = None
            said = self.message(algorithm)
            self.assertTrue(said.startswith(expected), said)
            self.assertNotIn("\n", said)
        sys.modules["meshhood"] = meshhood
        neighborhood.VertexId = 5  # the filter works again
        before = len(self.window.GetOutput())
        self.assertEqual(servermanager.Fetch(neighborhood).GetNumberOfPoints(), 1522)
        self.assertEqual(len(self.window.GetOutput()), before)

    def test_warnings_of_the_package_are_messages(self):
        V = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]] * 8, float)
        mesh = vtkPolyData()
        mesh.SetPoints(vtkPoints())
        mesh.GetPoints().SetData(numpy_to_vtk(V, deep=True))
        mesh.SetPolys(vtkCellArray())
        for first in range(0, len(V), 3):
            mesh.GetPolys().InsertNextCell(3, [first, first + 1, first + 2])
        servermanager.Fetch(simple.MeshhoodThickness(Input=source_of(mesh)))
        said = self.window.GetOutput()
        self.assertIn("Meshhood Thickness: V: 24 vertices at 3 different positions", said)
        self.assertIn("Weld the mesh first: apply the filter Clean\n", said)
        self.assertIn("apply the filter Surface Normals with Flip Normals, without Splitting; an open sheet", said)

    def test_other_data_is_refused_by_the_input(self):
        for name in ("MeshhoodNeighborhood", "MeshhoodThickness", "MeshhoodCurvature", "MeshhoodSmooth"):
            found = getattr(simple, name)(Input=sphere())
            domain = found.SMProxy.GetProperty("Input").FindDomain("vtkSMDataTypeDomain")
            for source, fits in ((simple.Wavelet(), 0), (sphere(), 1)):
                source.UpdatePipeline()
                self.assertEqual(bool(domain.IsInDomain(source.SMProxy, 0)), bool(fits), name)

    def test_an_index_is_built_once_for_a_geometry(self):
        built = []
        whole = meshhood.MeshIndex

        def counted(*arguments, **words):
            built.append(1)
            return whole(*arguments, **words)

        meshhood.MeshIndex = counted
        try:
            source = sphere(Radius=7)
            curvature = simple.MeshhoodCurvature(Input=source)
            self.result(curvature)
            curvature.Radius = 3
            self.result(curvature)
            self.result(simple.MeshhoodThickness(Input=curvature))
            self.assertEqual(len(built), 1)
            source.Radius = 8
            self.result(curvature)
            self.assertEqual(len(built), 2)
        finally:
            meshhood.MeshIndex = whole

    def test_a_mesh_that_is_edited_in_place_has_a_new_index(self):
        mesh = mixed_cells()
        found = simple.MeshhoodNeighborhood(Input=source_of(mesh), Start="vertex id", Radius=2.5, RadiusInNames=0)
        found.Unit = "units of the points"
        self.assertEqual(self.result(found)["neighborhood"].sum(), 5)
        vtk_to_numpy(mesh.GetPoints().GetData())[:] *= 2  # as the two below, without a new time of points and polygons
        mesh.Modified()
        self.assertEqual(self.result(found)["neighborhood"].sum(), 3)
        mesh.GetPolys().InsertNextCell(3, [0, mesh.GetPoints().InsertNextPoint(0, -1, 0), 1])
        mesh.GetPointData().GetArray("point").InsertNextValue(70)
        mesh.GetCellData().GetArray("cell").InsertNextValue(60)
        mesh.Modified()
        arrays = self.result(found)
        self.assertEqual({len(values) for values in arrays.values()}, {8})
        self.assertEqual(list(np.flatnonzero(arrays["neighborhood"])), [0, 1, 3, 7])

    def test_progress_reaches_the_end(self):
        found = simple.MeshhoodCurvature(Input=sphere(Radius=9))
        algorithm, reports = found.GetClientSideObject(), []
        algorithm.AddObserver("ProgressEvent", lambda *_: reports.append(algorithm.GetProgress()))
        self.result(found)
        print(f"{len(reports)} reports of progress", file=sys.__stdout__)
        self.assertIn(1.0, reports)
        self.assertTrue(all(0 <= report <= 1 for report in reports))


if __name__ == "__main__":
    unittest.main()
