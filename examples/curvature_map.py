#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Colors a scan by its mean curvature at a scale: blue where it is concave, red where it is convex.

    curvature_map.py SCAN EDGES OUTPUT.ply

SCAN    a mesh that meshhood.read_mesh reads
EDGES   the radius, in mean edge lengths: larger than the noise, smaller than the features of interest
"""

import sys

import meshhood
import numpy as np

BLUE, WHITE, RED = np.array([33, 82, 166]), np.array([244, 243, 239]), np.array([178, 34, 34])


def colors_of(values, largest):
    """(#V, 3) uint8: white at 0 and without a value, blue and red from -largest and largest on."""
    share = np.nan_to_num(np.clip(values / (largest or 1), -1, 1))[:, None]
    return np.where(share < 0, WHITE - share * (BLUE - WHITE), WHITE + share * (RED - WHITE)).round().astype(np.uint8)


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    scan, edges, output = sys.argv[1:]
    V, F = meshhood.read_mesh(scan)
    found = meshhood.MeshIndex(V, F).curvature(float(edges), unit="edge")
    if not found.ok.any():
        sys.exit(f"EDGES: {edges}, expected a larger radius: no vertex has enough neighbors for a fit")
    largest = np.quantile(abs(found.mean[found.ok]), 0.98)
    meshhood.write_mesh(output, V, F, colors=colors_of(found.mean, largest))
    print(f"{len(V)} vertices, {found.ok.sum()} fitted; 98 % have a mean curvature of at most {largest:.4g} in magnitude")


if __name__ == "__main__":
    main()
