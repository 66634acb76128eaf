#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Reads the shared PLY, OFF and STL meshes, and some that deviate from their format, with plyfile and trimesh too, and
compares vertices and faces.

    compare_readers.py DUMP_MESH SHARED

DUMP_MESH   the program built from dump_mesh.cpp
SHARED      the folder that contains `meshes`, unless MESHHOOD_SHARED names it

Exit code 77, skipped, without the meshes or the libraries.
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77
FEWEST = 40

try:
    import numpy as np
    import plyfile
    import trimesh
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(SKIPPED)


def flat(faces):
    """Corners per face, and all corners: compared as a whole, because one face at a time takes a minute."""
    faces = list(faces)
    sides = np.fromiter(map(len, faces), np.int64, len(faces))
    return sides, np.concatenate(faces) if faces else np.empty(0, np.uint32)


def our_reading(dump_mesh, name, folder):
    """Positions (#V by 3, float32), corners per face, and corners."""
    subprocess.run([dump_mesh, name, folder], check=True)
    positions = np.fromfile(folder / "positions", np.float32).reshape(-1, 3)
    sides = np.fromfile(folder / "sides", np.uint64).astype(np.int64)
    return positions, sides, np.fromfile(folder / "corners", np.uint32)


def plyfile_reading(file):
    mesh = plyfile.PlyData.read(file)
    vertex = mesh["vertex"]
    positions = np.stack([vertex[axis] for axis in "xyz"], axis=1).astype(np.float32)
    if "face" not in mesh or mesh["face"].count == 0:
        return positions, *flat([])
    names = [p.name for p in mesh["face"].properties]
    return positions, *flat(mesh["face"]["vertex_indices" if "vertex_indices" in names else "vertex_index"])


def trimesh_reading(file, kind):
    mesh = trimesh.load(file, file_type=kind, process=False, maintain_order=True)
    faces = np.asarray(mesh.faces)
    return np.asarray(mesh.vertices).astype(np.float32), np.full(len(faces), 3), faces.ravel()


def compare_indexed(ours, theirs):
    assert np.array_equal(ours[0], theirs[0]), "vertices differ"
    assert np.array_equal(ours[1], theirs[1]) and np.array_equal(ours[2], theirs[2]), "faces differ"


def compare_soup(ours, theirs):
    """trimesh leaves the corners of an STL unjoined."""
    positions, _, corners = ours
    soup = theirs[0][theirs[2]]
    assert np.array_equal(positions[corners], soup), "corners differ"
    assert len(np.unique(soup + np.float32(0), axis=0)) == len(positions), "not every equal position is one vertex"
    first = np.unique(corners, return_index=True)[1]
    assert np.all(np.diff(first) > 0), "vertices are not numbered by first appearance"


def compare(dump_mesh, name):
    """Whether the mesh could be compared. Raises AssertionError if the readers differ."""
    kind = name.removesuffix(".zst").rsplit(".", 1)[1]
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        ours = our_reading(dump_mesh, name, folder)
        with open(folder / "plain", "rb") as file:
            if kind == "ply":
                compare_indexed(ours, plyfile_reading(file))
            elif kind == "off":
                if np.any(ours[1] != 3):
                    return False  # trimesh cuts polygons into triangles
                compare_indexed(ours, trimesh_reading(file, kind))
            else:
                compare_soup(ours, trimesh_reading(file, kind))
    return True


def odd_files():
    """A cube in files that deviate from their format as those of some programs do, by name."""
    cube = [(x, y, z) for x in (1, 2) for y in (1, 2) for z in (1, 2)]
    faces = "".join(f"3 {a} {b} {c}\n" for a, b, c in ((0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5)))
    vertices = "".join(f"{x} {y} {z}\n" for x, y, z in cube)
    axes = "property float x\nproperty float y\nproperty float z\n"
    corners = "property list uchar int vertex_indices\n"
    ply = f"ply\nformat ascii 1.0\nelement vertex 8\n{axes}element face 4\n{corners}end_header\n"
    return {
        "weights.ply": ply + vertices.replace("\n", " 1\n") + faces,
        "colors.ply": ply + vertices + faces.replace("\n", " 255 0 0\n"),
        "normals_first.off": "NCOFF\n8 4 0\n" + vertices.replace("\n", " 0 0 1 255 0 0 255\n") + faces,
        "two_counts.off": "OFF\n8 4\n" + vertices + faces,
    }


def compare_odd(dump_mesh):
    """The names of the files that trimesh reads otherwise."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in odd_files().items():
            file = Path(folder).resolve() / name
            file.write_text(text)
            try:
                ours = our_reading(dump_mesh, str(file), Path(folder))
                with open(file, "rb") as opened:
                    compare_indexed(ours, trimesh_reading(opened, file.suffix[1:]))
            except AssertionError as difference:
                yield f"{name}: {difference}"


def main(dump_mesh, meshes):
    if not meshes.is_dir():
        print(f"skipped: no meshes at {meshes}")
        return SKIPPED
    names = sorted(str(path.relative_to(meshes)) for path in meshes.rglob("*") if path.is_file())
    kinds = (".ply", ".off", ".stl", ".ply.zst", ".stl.zst")
    tally, failures = {"ply": 0, "off": 0, "stl": 0}, 0
    for name in names:
        # plyfile does not read triangle strips as faces.
        if name.startswith("broken/") or not name.endswith(kinds) or "tristrips" in name:
            continue
        try:
            if compare(dump_mesh, name):
                tally[name.removesuffix(".zst").rsplit(".", 1)[1]] += 1
        except AssertionError as difference:
            failures += 1
            print(f"{name}: {difference}")
    for difference in compare_odd(dump_mesh):
        failures += 1
        print(difference)
    compared = sum(tally.values())
    print(f"{compared} meshes compared ({tally}), {failures} differ")
    return 0 if failures == 0 and compared >= FEWEST else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], Path(os.environ.get("MESHHOOD_SHARED", sys.argv[2])) / "meshes"))
