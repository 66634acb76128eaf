#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""All neighborhoods of a large scan as a sparse matrix of SciPy, and a use of it: the roughness at every vertex.

    scan_graph.py MESH [RADIUS]

RADIUS   in mean lengths of the first edge of each face, 3 unless given
"""

import resource
import sys

import meshhood
import numpy as np


def roughness(near, V):
    """Per vertex, how far it lies from the mean of its neighborhood."""
    means = (near @ V) / np.diff(near.indptr)[:, None]
    return np.linalg.norm(V - means, axis=1)


def main():
    V, F = meshhood.read_mesh(sys.argv[1])
    edges = float(sys.argv[2]) if len(sys.argv) > 2 else 3.0
    radius = edges * np.linalg.norm(V[F[:, 0]] - V[F[:, 1]], axis=1).mean()
    near = meshhood.MeshIndex(V, F).radius_neighbors_graph(radius, progress=sys.stderr.isatty())
    rough = roughness(near, V)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20
    print(f"{near.shape[0]} vertices, {near.nnz} pairs within {radius:.3g}, at most {peak:.2f} GB of memory")
    print(f"roughness {np.median(rough) / radius:.3f} radii in the middle, {rough.max() / radius:.3f} at most")


if __name__ == "__main__":
    main()
