#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The gap between two parts of an assembly against that of its design, as two programs mesh it and as others mesh it
again. A pin leans in a cup; the parts are round, or prisms of six sides, whose meshes are the design itself.

    pip install gmsh netgen-mesher pymeshlab pyacvd pyvista scipy
    PYTHONPATH=PACKAGE bench/assembly_gaps.py [PICTURE.png]
"""

import sys
import tempfile
from pathlib import Path

import gmsh
import meshhood
import numpy as np
import pyacvd
import pymeshlab
import pyvista
from netgen.occ import OCCGeometry
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

BORE, FLOOR, LEAN, REACH = 9.0, -2.0, 1 / 60, 5.0  # mm, mm, radians, mm
SIDES = {"round": 0, "flat": 6}


def write_design(sides, step):
    """Writes both solids to the file `step`; 0 sides are a cylinder."""
    shapes = gmsh.model.occ

    def prism(radius, bottom, height):
        if sides == 0:
            return 3, shapes.addCylinder(0, 0, bottom, 0, 0, height, radius)
        angles = np.arange(sides) * (2 * np.pi / sides)
        corners = [shapes.addPoint(radius * np.cos(a), radius * np.sin(a), bottom) for a in angles]
        lines = [shapes.addLine(*pair) for pair in zip(corners, corners[1:] + corners[:1])]
        base = shapes.addPlaneSurface([shapes.addCurveLoop(lines)])
        return next(made for made in shapes.extrude([(2, base)], 0, 0, height) if made[0] == 3)

    gmsh.clear()
    shapes.cut([prism(14, -6, 46)], [prism(BORE, FLOOR, 50)])
    shapes.rotate([prism(8, 0, 36)], 0, 0, 0, 0, 1, 0, LEAN)
    shapes.synchronize()
    gmsh.write(step)


def designed_gap(sides, points):
    """From points within the cup to its wall or its floor."""
    if sides == 0:
        walls = BORE - np.hypot(points[:, 0], points[:, 1])
    else:
        angles = (np.arange(sides) + 0.5) * (2 * np.pi / sides)
        walls = BORE * np.cos(np.pi / sides) - (points[:, :2] @ (np.cos(angles), np.sin(angles))).max(axis=1)
    return np.minimum(walls, points[:, 2] - FLOOR)


def of_faces(V, F):
    """The mesh without the vertices of no face."""
    used, F = np.unique(F, return_inverse=True)
    return V[used], F.reshape(-1, 3)


def by_gmsh(step, size):
    gmsh.clear()
    gmsh.open(step)
    gmsh.option.setNumber("Mesh.MeshSizeMin", size)
    gmsh.option.setNumber("Mesh.MeshSizeMax", size)
    gmsh.model.mesh.generate(2)
    tags, places, _ = gmsh.model.mesh.getNodes()
    order = np.argsort(tags)
    corners = gmsh.model.mesh.getElementsByType(2)[1].reshape(-1, 3)
    return of_faces(places.reshape(-1, 3)[order], np.searchsorted(tags[order], corners))


def by_netgen(step, size):
    mesh = OCCGeometry(step).GenerateMesh(maxh=size, perfstepsend=4)
    corners = [[corner.nr - 1 for corner in face.vertices] for face in mesh.Elements2D()]
    return of_faces(np.array([point.p for point in mesh.Points()]), np.array(corners))


def by_pymeshlab(V, F, size):
    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(V, F))
    meshes.meshing_isotropic_explicit_remeshing(targetlen=pymeshlab.PureValue(size), featuredeg=20)
    return meshes.current_mesh().vertex_matrix(), meshes.current_mesh().face_matrix()


def by_pyacvd(V, F, size):
    made = pyvista.PolyData()
    for body in pyvista.PolyData.from_regular_faces(V, F).split_bodies():
        clustering = pyacvd.Clustering(body.extract_surface(algorithm="dataset_surface"))
        clustering.subdivide(2)
        clustering.cluster(round(body.area / size**2 * 2 / 3**0.5))
        made = made.append_polydata(clustering.create_mesh())
    return np.asarray(made.points, float), made.regular_faces


def pin_of(V, F):
    """The vertices of the component that is nearest to the axis at half its height."""
    links = coo_array((np.ones(F.size), (F.ravel(), np.roll(F, 1, axis=1).ravel())), shape=2 * (len(V),))
    parts, part = connected_components(links)
    assert parts == 2
    reach = [np.hypot(*V[part == i, :2].T).max() for i in range(2)]
    return np.flatnonzero(part == np.argmin(reach))


def error(found, wanted):
    """The mean and the largest, in mm, where the design has a gap within reach."""
    errors = abs(found - wanted)[wanted < REACH - 0.2]
    return f"{errors.mean():.1e}, {errors.max():.1e}"


gmsh.initialize(["", "-v", "1"])
pictures = {}
with tempfile.TemporaryDirectory() as folder:
    for shape, sides in SIDES.items():
        step = str(Path(folder) / f"{shape}.step")
        write_design(sides, step)
        meshes = {"Gmsh, 4 mm": by_gmsh(step, 4), "Gmsh, 1 mm": by_gmsh(step, 1), "Netgen, 2 mm": by_netgen(step, 2)}
        meshes["Gmsh, then MeshLab, 1.5 mm"] = by_pymeshlab(*meshes["Gmsh, 1 mm"], 1.5)
        meshes["Netgen, then ACVD, 1.5 mm"] = by_pyacvd(*meshes["Netgen, 2 mm"], 1.5)
        for name, (V, F) in meshes.items():
            index, pin = meshhood.MeshIndex(V, F), pin_of(V, F)
            gap, wanted = index.gaps(REACH, pin).distance, designed_gap(sides, V[pin])
            nearest = index.nearest_unconnected(2 * REACH, pin).distance
            print(f"| {shape} | {name} | {len(F)} | {error(gap, wanted)} | {error(nearest, wanted)} |")
            pictures[shape, name] = V, F, pin, gap
gmsh.finalize()

if len(sys.argv) > 1:
    shown = [key for key in pictures if key[0] == "round"]
    plotter = pyvista.Plotter(shape=(1, len(shown)), window_size=(200 * len(shown), 320), border=False, off_screen=True)
    for column, key in enumerate(shown):
        V, F, pin, gap = pictures[key]
        values = np.zeros(len(V))
        values[pin] = gap
        mesh = pyvista.PolyData.from_regular_faces(V, F)
        mesh["gap"] = values
        plotter.subplot(0, column)
        of_pin = np.isin(F, pin).all(axis=1)
        plotter.add_mesh(mesh.extract_cells(of_pin), scalars="gap", clim=(0.4, 2), cmap="viridis", show_edges=True,
                         edge_opacity=0.4, show_scalar_bar=False)
        cup = mesh.extract_cells(~of_pin).clip("y", invert=False)
        plotter.add_mesh(cup, color="lightgray", show_edges=True, edge_opacity=0.4)
        plotter.camera_position = [(60, -95, 60), (0, 0, 17), (0, 0, 1)]
        plotter.camera.zoom(1.15)
    plotter.screenshot(sys.argv[1])
