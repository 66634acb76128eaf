# SPDX-License-Identifier: MIT
"""The mesh of a comparison, as files that each process reads: arrays, and the same as PLY."""
import numpy as np

from .. import meshes, places
from .peer import Mesh


def prepared(name, order):
    """The path of the arrays, in the order of the file or with the vertices shuffled; the PLY file is beside it."""
    import meshhood

    places.SCRATCH.mkdir(parents=True, exist_ok=True)
    target = places.SCRATCH / f"{name}-{order}.npz"
    positions, triangles = meshhood.read_mesh(meshes.as_file(name))
    positions, triangles = positions.astype(np.float32), triangles.astype(np.int32)
    if order == "shuffled":
        new = np.random.default_rng(1).permutation(len(positions)).astype(np.int32)
        shuffled = np.empty_like(positions)
        shuffled[new] = positions
        positions, triangles = shuffled, new[triangles]
    np.savez(target, positions=positions, triangles=triangles)
    write_ply(target.with_suffix(".ply"), positions, triangles)
    return target


def load(path):
    with np.load(path) as arrays:
        return Mesh(arrays["positions"], arrays["triangles"], str(path.with_suffix(".ply")))


def write_ply(path, positions, triangles):
    header = ("ply\nformat binary_little_endian 1.0\n"
              f"element vertex {len(positions)}\nproperty float x\nproperty float y\nproperty float z\n"
              f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n")
    rows = np.empty(len(triangles), np.dtype([("size", "u1"), ("corners", "<i4", 3)]))
    rows["size"], rows["corners"] = 3, triangles
    with open(path, "wb") as file:
        file.write(header.encode("ascii"))
        file.write(np.ascontiguousarray(positions, "<f4").tobytes())
        file.write(rows.tobytes())
