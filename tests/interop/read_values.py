#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Opens the meshes with values that `meshhood curvature`, `aggregate` and `features` write: VTK with PyVista and with the
reader of VTK, which is that of ParaView; PLY with meshio and plyfile, and with PyMeshLab where it is installed. Compares
the values with the arrays of the NPZ file.

    read_values.py MESHHOOD

Exit code 77, skipped, without the libraries.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77
RADII = (2, 3)

try:
    import meshio
    import numpy as np
    import plyfile
    import pyvista
    import vtk
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(SKIPPED)

try:
    import pymeshlab
except ImportError:
    pymeshlab = None

COMMANDS = {
    "curvature": [],
    "aggregate": ["--values", "values.npy", "--reduce", "max"],
    "features": ["--kinds", "mean,shape_index"],
}


def expected_columns(command, arrays):
    """The name and values of each column, as the file must have them; the first is the one that is shown."""
    columns = {}
    for i in range(len(RADII)):
        if command == "curvature":
            columns[f"mean_{i}"] = (arrays["k1"][i] + arrays["k2"][i]) / 2
            columns |= {f"{name}_{i}": arrays[name][i] for name in ("k1", "k2", "state", "d1", "d2")}
        elif command == "aggregate":
            columns |= {f"max_{i}_{channel}": arrays["values"][i, :, channel] for channel in range(2)}
        else:
            columns |= {f"{kind}_{i}": arrays["features"][i, :, k] for k, kind in enumerate(arrays["kinds"])}
    if command == "features":
        for k, kind in enumerate(arrays["kinds"]):
            columns |= {f"{kind}_{name}": arrays[name][:, k] for name in ("scales", "strength", "radius")}
    shown = {"curvature": "mean_1", "aggregate": "max_1_0", "features": "mean_1"}[command]
    return shown, {name: values.astype(np.float32) for name, values in columns.items()}


def check_shapes(command, arrays, vertices):
    radii = len(RADII)
    assert arrays["radii"].shape == (radii,), command
    shapes = {
        "curvature": {"k1": (), "k2": (), "state": (), "d1": (3,), "d2": (3,)},
        "aggregate": {"values": (2,)},
        "features": {"features": (2,)},
    }[command]
    for name, rest in shapes.items():
        assert arrays[name].shape == (radii, vertices, *rest), f"{command}: {name} is {arrays[name].shape}"
    if command == "features":
        assert arrays["kinds"].tolist() == ["mean", "shape_index"], arrays["kinds"]
        assert all(arrays[name].shape == (vertices, 2) for name in ("scales", "strength", "radius")), command


def check_vtk(file, mesh, shown, columns):
    found = pyvista.read(file)
    assert np.array_equal(found.points, mesh.points), "points"
    assert np.array_equal(found.faces, np.insert(mesh.cells_dict["triangle"], 0, 3, axis=1).ravel()), "faces"
    assert found.active_scalars_name == shown, found.active_scalars_name
    assert sorted(found.point_data.keys()) == sorted(columns), found.point_data.keys()
    for name, values in columns.items():
        assert np.array_equal(found.point_data[name], values, equal_nan=True), name
    reader = vtk.vtkPolyDataReader()  # as it is, without any option
    reader.SetFileName(str(file))
    reader.Update()
    data = reader.GetOutput().GetPointData()
    assert data.GetScalars().GetName() == shown and data.GetNumberOfArrays() == len(columns), data


def check_ply(file, mesh, shown, columns):
    flat = {"quality": columns[shown]}
    for name, values in columns.items():
        flat |= {name: values} if values.ndim == 1 else {f"{name}_{axis}": values[:, i] for i, axis in enumerate("xyz")}
    found = meshio.read(file)
    assert np.array_equal(found.points, mesh.points), "points"
    assert np.array_equal(found.cells_dict["triangle"], mesh.cells_dict["triangle"]), "faces"
    vertex = plyfile.PlyData.read(file)["vertex"]
    for name, values in flat.items():
        assert np.array_equal(found.point_data[name], values, equal_nan=True), name
        assert np.array_equal(vertex[name], values, equal_nan=True), name
    if pymeshlab:
        meshes = pymeshlab.MeshSet()
        meshes.load_new_mesh(str(file))
        quality = meshes.current_mesh().vertex_scalar_array()
        assert np.allclose(quality, columns[shown], equal_nan=True), "quality"


def main(program):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)

        def run(*arguments):
            subprocess.run([program, *arguments], cwd=folder, check=True, capture_output=True)

        run("generate", "sphere", "--vertices", "700", "-o", "mesh.ply")
        mesh = meshio.read(folder / "mesh.ply")
        vertices = len(mesh.points)
        np.save(folder / "values.npy", np.stack([mesh.points[:, 2], np.arange(vertices)], axis=1))
        for command, options in COMMANDS.items():
            radius = ["-r", ",".join(map(str, RADII)), "--unit", "edge"]
            run(command, "mesh.ply", *radius, *options, "-o", "out.npz", "--ply", "out.ply", "--vtk", "out.vtk")
            arrays = np.load(folder / "out.npz")
            check_shapes(command, arrays, vertices)
            shown, columns = expected_columns(command, arrays)
            assert np.ptp(columns[shown]) > 0, f"{shown} is the same everywhere"
            check_vtk(folder / "out.vtk", mesh, shown, columns)
            check_ply(folder / "out.ply", mesh, shown, columns)
            print(f"{command}: {len(columns)} columns of {vertices} vertices{', also in PyMeshLab' if pymeshlab else ''}")
    return 0


if __name__ == "__main__":
    sys.exit(main(str(Path(sys.argv[1]).resolve())))
