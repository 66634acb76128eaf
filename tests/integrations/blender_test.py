# SPDX-License-Identifier: MIT
"""The add-on of Blender, packed, installed and enabled as a user does, has the values of the package.

    BLENDER_USER_SCRIPTS=FOLDER blender -b --factory-startup --python-use-system-env --python blender_test.py -- ROOT
"""

import os
import subprocess
import sys
import unittest
from pathlib import Path

from built_for import skip_unless_loadable

skip_unless_loadable()

import bmesh
import bpy
import meshhood
import numpy as np
from mathutils import Euler, Matrix

ROOT = Path(sys.argv[-1])


def install():
    scripts = Path(os.environ["BLENDER_USER_SCRIPTS"])
    (scripts / "addons").mkdir(parents=True, exist_ok=True)
    archive = scripts / "meshhood_blender.zip"
    subprocess.run(["python3", ROOT / "tools/pack_blender", archive], check=True)
    bpy.ops.preferences.addon_install(filepath=str(archive), overwrite=True)
    bpy.ops.preferences.addon_enable(module="meshhood_blender")
    installed = Path(sys.modules["meshhood_blender"].__file__)
    assert installed.is_relative_to(scripts), installed


def moved(mirrored=False):
    """A rotation, different scales along the axes, and a translation."""
    scale = Matrix.Diagonal((-2.0 if mirrored else 2.0, 0.5, 1.5, 1))
    return Matrix.Translation((3, -1, 7)) @ Euler((0.3, 1.1, -0.4)).to_matrix().to_4x4() @ scale


def torus(matrix=None):
    bpy.ops.mesh.primitive_torus_add(major_segments=48, minor_segments=24)
    bpy.context.object.matrix_world = matrix or Matrix()
    bpy.context.view_layer.update()
    return bpy.context.object


def mesh_object(points, edges, faces):
    mesh = bpy.data.meshes.new("made")
    mesh.from_pydata(points, edges, faces)
    obj = bpy.data.objects.new("made", mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    return obj


def world(obj):
    """Positions and faces, read one by one. The positions are rounded as in the add-on: distances may be equal."""
    matrix = np.array(obj.matrix_world)
    positions = np.array([vertex.co for vertex in obj.data.vertices], np.float32) @ matrix[:3, :3].T + matrix[:3, 3]
    mirrored = obj.matrix_world.is_negative
    return positions, [list(face.vertices)[:: -1 if mirrored else 1] for face in obj.data.polygons]


def index_of(obj):
    positions, faces = world(obj)
    offsets = np.cumsum([0, *map(len, faces)])
    return meshhood.MeshIndex(positions, (offsets, np.concatenate(faces)))


def values_of(obj, name):
    attribute = obj.data.attributes[name]
    values = np.empty(len(attribute.data), np.float32)
    attribute.data.foreach_get("value", values)
    return values


def activate(obj, vertex):
    """Edit mode with this vertex selected and active."""
    if obj.mode != "EDIT":
        bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_mode(type="VERT")
    bpy.ops.mesh.select_all(action="DESELECT")
    edited = bmesh.from_edit_mesh(obj.data)
    edited.verts.ensure_lookup_table()
    edited.verts[vertex].select = True
    edited.select_history.add(edited.verts[vertex])
    bmesh.update_edit_mesh(obj.data)


def selected(obj):
    return [vertex.index for vertex in bmesh.from_edit_mesh(obj.data).verts if vertex.select]


class AddOn(unittest.TestCase):
    def setUp(self):
        self.addCleanup(bpy.ops.wm.read_homefile, use_empty=True)
        self.addCleanup(lambda: bpy.context.mode == "OBJECT" or bpy.ops.object.mode_set(mode="OBJECT"))

    def test_it_selects_the_neighborhood_in_world_units(self):
        checked = 0
        for matrix in (Matrix(), moved(), moved(mirrored=True)):
            obj = torus(matrix)
            index = index_of(obj)
            for metric in ("straight", "path", "surface"):
                for vertex in (0, 500, 1151):
                    activate(obj, vertex)
                    bpy.ops.meshhood.select_connected(radius=0.6, metric=metric)
                    expected = index.neighborhood(vertex, np.float32(0.6), metric=metric)
                    self.assertEqual(selected(obj), sorted(expected.tolist()))
                    edited = bmesh.from_edit_mesh(obj.data)
                    inside = sum(all(corner.select for corner in face.verts) for face in edited.faces)
                    self.assertEqual(sum(face.select for face in edited.faces), inside)
                    self.assertEqual([each.index for each in edited.select_history], [vertex])
                    checked += 1
            bpy.ops.object.mode_set(mode="OBJECT")
        print(f"{checked} selections")

    def test_the_front_of_a_sleeve_is_selected_without_its_back(self):
        sheets = [[(x, y, z) for x in range(9) for y in range(9)] for z in (0, 0.1)]
        faces = [(81 * z + 9 * x + y, 81 * z + 9 * x + y + 1, 81 * z + 9 * x + y + 10, 81 * z + 9 * x + y + 9)
                 for z in range(2) for x in range(8) for y in range(8)]  # fmt: skip
        obj = mesh_object(sum(sheets, []), [], faces)
        activate(obj, 40)
        bpy.ops.meshhood.select_connected(radius=2)
        self.assertEqual(len(selected(obj)), 13)
        self.assertLess(max(selected(obj)), 81)

    def test_edges_without_faces_connect_and_hidden_vertices_do_not(self):
        square = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
        obj = mesh_object([*square, (2, 0, 0), (3, 0, 0), (4, 0, 0)], [(1, 4), (4, 5), (5, 6)], [(0, 1, 2, 3)])
        for metric in ("straight", "path", "surface"):
            activate(obj, 0)
            bpy.ops.meshhood.select_connected(radius=3, metric=metric)
            self.assertEqual(selected(obj), [0, 1, 2, 3, 4, 5])  # vertex 5 is at exactly 3
        bmesh.from_edit_mesh(obj.data).verts[4].hide_set(True)
        activate(obj, 0)
        bpy.ops.meshhood.select_connected(radius=3)
        self.assertEqual(selected(obj), [0, 1, 2, 3])

    def test_a_shape_key_is_selected_as_edit_mode_shows_it(self):
        obj = torus()
        obj.shape_key_add(name="Basis")
        large = obj.shape_key_add(name="Large")
        for point in large.data:
            point.co = 3 * point.co
        index = index_of(obj)
        expected = sorted(index.neighborhood(500, 0.59).tolist())
        for key, scale in ((0, 1), (1, 3)):
            obj.active_shape_key_index = key
            activate(obj, 500)
            bpy.ops.meshhood.select_connected(radius=0.59 * scale)
            self.assertEqual(selected(obj), expected)
            bpy.ops.object.mode_set(mode="OBJECT")
        activate(obj, 500)
        edited = bmesh.from_edit_mesh(obj.data)
        edited.verts[500].co *= 10
        bmesh.ops.delete(edited, geom=[edited.verts[0]], context="VERTS")
        bpy.ops.meshhood.select_connected(radius=1.8)
        self.assertEqual(selected(obj), [499])
        bpy.ops.object.mode_set(mode="OBJECT")
        bpy.ops.meshhood.thickness()
        np.testing.assert_allclose(values_of(obj, "thickness"), index_of(obj).thickness(), rtol=1e-4)

    def test_a_selection_is_replaced_or_extended_and_undone(self):
        obj = torus()
        index = index_of(obj)
        activate(obj, 700)
        bmesh.from_edit_mesh(obj.data).verts[3].select = True
        bpy.ops.ed.undo_push(message="before")
        bpy.ops.meshhood.select_connected("EXEC_DEFAULT", True, radius=0.3, extend=True)
        expected = set(index.neighborhood(700, np.float32(0.3)).tolist())
        self.assertEqual(set(selected(obj)), expected | {3})
        bpy.ops.ed.undo()
        obj = bpy.context.object
        self.assertEqual(selected(obj), [3, 700])
        bpy.ops.meshhood.select_connected(radius=0.3)
        self.assertEqual(set(selected(obj)), expected)

    def test_the_first_radius_is_five_mean_edges(self):
        obj = torus(moved())
        index = index_of(obj)
        activate(obj, 9)
        bpy.ops.meshhood.select_connected()
        expected = index.neighborhood(9, np.float32(5 * index.mean_edge_length))
        self.assertEqual(selected(obj), sorted(expected.tolist()))

    def test_thickness_is_an_attribute_in_world_units(self):
        for matrix in (Matrix(), moved(), moved(mirrored=True)):
            obj = torus(matrix)
            index = index_of(obj)
            for method in ("ray", "sphere"):
                bpy.ops.meshhood.thickness(method=method)
                np.testing.assert_allclose(values_of(obj, "thickness"), index.thickness(method=method), rtol=1e-4)
            self.assertTrue(np.isfinite(values_of(obj, "thickness")).all())

    def test_curvature_is_an_attribute_of_its_kind(self):
        kinds = {
            "mean": "mean_curvature", "gaussian": "gaussian_curvature", "k1": "k1", "k2": "k2",
            "curvedness": "curvedness", "shape_index": "shape_index",
        }  # fmt: skip
        for matrix in (Matrix(), moved(mirrored=True)):
            obj = torus(matrix)
            index = index_of(obj)
            for metric in ("straight", "path"):
                found = index.curvature(np.float32(0.5), metric=metric)
                for kind, name in kinds.items():
                    bpy.ops.meshhood.curvature(kind=kind, radius=0.5, metric=metric)
                    np.testing.assert_allclose(values_of(obj, name), getattr(found, kind), rtol=1e-4, atol=1e-5)
            self.assertGreater(np.mean(values_of(obj, "mean_curvature") > 0), 0.5)  # convex outside
        bpy.ops.meshhood.curvature()
        expected = index.curvature(np.float32(5 * index.mean_edge_length)).mean
        np.testing.assert_allclose(values_of(obj, "mean_curvature"), expected, rtol=1e-4, atol=1e-5)

    def test_colors_show_what_was_measured_last(self):
        obj = torus(moved())
        bpy.ops.meshhood.thickness(colors=False)
        self.assertEqual(len(obj.data.color_attributes), 0)
        bpy.ops.meshhood.thickness()
        layer = obj.data.color_attributes.active_color
        self.assertEqual(layer.name, "meshhood")
        colors = np.array([value.color for value in layer.data])
        redness, thickness = colors[:, 0] - colors[:, 2], values_of(obj, "thickness")
        order = np.argsort(thickness)
        self.assertTrue((np.diff(redness[order]) <= 1e-6).all())  # thin is red
        self.assertTrue(redness[order[0]] > 0.5 and redness[order[-1]] < -0.5)
        bpy.ops.meshhood.curvature(kind="gaussian")
        colors = np.array([value.color for value in obj.data.color_attributes.active_color.data])
        curvature = values_of(obj, "gaussian_curvature")
        np.testing.assert_array_equal(colors[:, 0] > colors[:, 2], curvature > 0)
        self.assertEqual(len(obj.data.color_attributes), 1)

    def test_values_that_are_not_finite_have_colors(self):
        obj = mesh_object([(0, 0, 0), (1, 0, 0), (0, 1, 0), (5, 5, 5)], [], [(0, 1, 2)])
        bpy.ops.meshhood.thickness()
        np.testing.assert_array_equal(values_of(obj, "thickness"), [np.inf, np.inf, np.inf, np.nan])
        colors = np.array([value.color for value in obj.data.color_attributes["meshhood"].data])
        self.assertTrue((colors[:3, 2] > colors[:3, 0]).all())
        self.assertTrue((colors[3, :3] == colors[3, 0]).all())

    def test_errors_say_what_is_wrong(self):
        obj = torus()
        with self.assertRaisesRegex(RuntimeError, "expected a mesh in edit mode"):
            bpy.ops.meshhood.select_connected()
        obj.data.attributes.new("thickness", "INT", "FACE")
        obj.data.attributes.new("meshhood", "FLOAT", "FACE")
        with self.assertRaisesRegex(RuntimeError, "another attribute thickness: rename or remove it"):
            bpy.ops.meshhood.thickness()
        with self.assertRaisesRegex(RuntimeError, "another attribute meshhood: rename or remove it"):
            bpy.ops.meshhood.curvature()
        self.assertNotIn("mean_curvature", obj.data.attributes)
        for group in ("thickness", "meshhood"):
            obj = torus()
            obj.vertex_groups.new(name=group)
            before = obj.data.attributes.keys()
            with self.assertRaisesRegex(RuntimeError, f"has a vertex group {group}: rename or remove it"):
                bpy.ops.meshhood.thickness()
            self.assertEqual(obj.data.attributes.keys(), before)
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="DESELECT")
        with self.assertRaisesRegex(RuntimeError, "No active vertex: in vertex select mode, click one"):
            bpy.ops.meshhood.select_connected()
        with self.assertRaisesRegex(RuntimeError, "expected an active mesh in object mode"):
            bpy.ops.meshhood.thickness()
        bpy.ops.object.mode_set(mode="OBJECT")
        mesh_object([(0, 0, 0)], [], [])
        with self.assertRaisesRegex(RuntimeError, "made has no faces"):
            bpy.ops.meshhood.curvature()
        activate(bpy.context.object, 0)
        with self.assertRaisesRegex(RuntimeError, "made has no edges"):
            bpy.ops.meshhood.select_connected()

    def test_warnings_of_the_package_are_reported(self):
        from meshhood_blender import object_index, operator_parts

        class Indexed(operator_parts.Reporting):
            def _run(self, context, progress):
                object_index.index_of(context.object, progress)

            def report(self, kind, text):
                reports.append((kind, text))

        reports = []
        mesh_object([(0, 0, 0), (1, 0, 0), (0, 1, 0)] * 8, [], [(i, i + 1, i + 2) for i in range(0, 24, 3)])
        self.assertEqual(Indexed().execute(bpy.context), {"FINISHED"})
        self.assertEqual([kind for kind, _ in reports], [{"WARNING"}])
        self.assertIn("24 vertices at 3 different positions", reports[0][1])
        self.assertTrue(reports[0][1].endswith("Weld the mesh first: Mesh > Merge > By Distance"), reports[0][1])

    def test_a_missing_package_is_said_with_what_installs_it(self):
        obj = torus(moved())
        sys.modules["meshhood"] = None
        try:
            with self.assertRaisesRegex(RuntimeError, '-m pip install --no-deps --target ".*modules" meshhood '):
                bpy.ops.meshhood.thickness()
        finally:
            sys.modules["meshhood"] = meshhood
        bpy.ops.meshhood.thickness()
        self.assertIn("thickness", obj.data.attributes)

    def test_an_index_is_built_once_for_a_geometry(self):
        built = []
        whole = meshhood.MeshIndex

        def counted(*arguments, **words):
            built.append(1)
            return whole(*arguments, **words)

        meshhood.MeshIndex = counted
        try:
            obj = torus(Matrix.Scale(1.25, 4))
            bpy.ops.meshhood.curvature(radius=0.4)
            bpy.ops.meshhood.curvature(radius=0.5)
            bpy.ops.meshhood.thickness()
            self.assertEqual(len(built), 1)
            obj.data.vertices[7].co.x += 0.01
            bpy.ops.meshhood.thickness()
            self.assertEqual(len(built), 2)
        finally:
            meshhood.MeshIndex = whole

    def test_it_can_be_disabled(self):
        from meshhood_blender import object_index

        torus()
        bpy.ops.meshhood.thickness()
        for _ in range(2):
            bpy.ops.preferences.addon_disable(module="meshhood_blender")
            self.assertFalse(hasattr(bpy.types, "MESHHOOD_OT_thickness"))
            self.assertEqual(object_index._last, (None, None))
            bpy.ops.preferences.addon_enable(module="meshhood_blender")
            self.assertTrue(hasattr(bpy.types, "MESHHOOD_OT_thickness"))


if __name__ == "__main__":
    install()
    unittest.main(argv=sys.argv[:1])
