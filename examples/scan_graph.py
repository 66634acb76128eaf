#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""All neighborhoods of a large scan as a sparse matrix of SciPy, and a use of it: the roughness at every vertex.

    scan_graph.py MESH [RADIUS]

RADIUS   in mean edge lengths, 3 unless given
"""

import resource
import sys

import meshhood
import numpy as np


def roughness(near, V):
    """Per vertex, how far it lies from the mean of its neighborhood; NaN where it has no position."""
    means = (near @ V) / np.maximum(np.diff(near.indptr), 1)[:, None]
    return np.linalg.norm(V - means, axis=1)


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    V, F = meshhood.read_mesh(sys.argv[1])
    index = meshhood.MeshIndex(V, F)
    radius = (float(sys.argv[2]) if len(sys.argv) > 2 else 3.0) * index.mean_edge_length
    near = index.radius_neighbors_graph(radius, progress=sys.stderr.isatty())
    rough = roughness(near, V)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20
    print(f"{near.shape[0]} vertices, {near.nnz} pairs within {radius:.3g}, at most {peak:.2f} GB of memory")
    print(f"roughness {np.nanmedian(rough) / radius:.3f} radii in the middle, {np.nanmax(rough) / radius:.3f} at most")


if __name__ == "__main__":
    main()
