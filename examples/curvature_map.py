#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Colors a scan by its mean curvature at a scale: blue where it is concave, red where it is convex.

    curvature_map.py SCAN EDGES OUTPUT.ply

SCAN    a file of triangles that meshhood.read_mesh reads
EDGES   the radius, in mean edge lengths: larger than the noise, smaller than the features of interest
"""

import sys

import meshhood
import numpy as np

BLUE, WHITE, RED = np.array([33, 82, 166]), np.array([244, 243, 239]), np.array([178, 34, 34])


def colors_of(values, largest):
    """(#V, 3) uint8: white at 0, blue and red from -largest and largest on."""
    share = np.clip(values / largest, -1, 1)[:, None]
    return np.where(share < 0, WHITE - share * (BLUE - WHITE), WHITE + share * (RED - WHITE)).round().astype(np.uint8)


def write_ply(name, V, F, colors):
    vertices = np.empty(len(V), [("position", "<f4", 3), ("color", "u1", 3)])
    vertices["position"], vertices["color"] = V, colors
    faces = np.empty(len(F), [("corners", "u1"), ("vertices", "<i4", 3)])
    faces["corners"], faces["vertices"] = 3, F
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(V)}"]
    header += [f"property float {axis}" for axis in "xyz"] + [f"property uchar {c}" for c in ("red", "green", "blue")]
    header += [f"element face {len(F)}", "property list uchar int vertex_indices", "end_header", ""]
    with open(name, "wb") as file:
        file.write("\n".join(header).encode() + vertices.tobytes() + faces.tobytes())


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    scan, edges, output = sys.argv[1:]
    V, F = meshhood.read_mesh(scan)
    found = meshhood.MeshIndex(V, F).curvature(float(edges), unit="edge")
    largest = np.quantile(abs(found.mean[found.ok]), 0.98)
    write_ply(output, V, F, colors_of(found.mean, largest))
    print(f"{len(V)} vertices, {found.ok.sum()} fitted; 98 % have a radius of mean curvature above {1 / largest:.4g}")


if __name__ == "__main__":
    main()
