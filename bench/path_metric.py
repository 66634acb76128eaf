# SPDX-License-Identifier: MIT
"""Path distances along the edges beside SciPy's `dijkstra(limit=r)`, one query at a time.

    python3 -m bench.path_metric MESH [RADIUS IN MEAN EDGES...]

Prints milliseconds for each query (the median of several vertices), the ratio, and the largest difference of a path
distance."""

import sys
import time

import meshhood
import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

QUERIES = 9


def lengths(V, F):
    """The graph with the length of each edge, (#V, #V)."""
    ends = np.sort(np.concatenate([F[:, [i, (i + 1) % F.shape[1]]] for i in range(F.shape[1])]), axis=1)
    a, b = np.unique(ends, axis=0).T
    dx, dy, dz = (V[a].astype(np.float64) - V[b]).T
    length = np.sqrt((dx * dx + dy * dy) + dz * dz)
    both = (np.concatenate([length, length]), (np.concatenate([a, b]), np.concatenate([b, a])))
    return csr_array(both, shape=(len(V), len(V)))


def milliseconds(f):
    start = time.process_time()
    result = f()
    return 1e3 * (time.process_time() - start), result


def main(path, *radii):
    V, F = meshhood.read_mesh(path)
    index, graph = meshhood.MeshIndex(V, F), lengths(V, F)
    index.neighborhood(0, 0, metric="path")
    print(f"{path}: {len(V)} vertices")
    print(f"{'edges':>6} {'vertices':>9} {'meshhood ms':>12} {'SciPy ms':>9} {'ratio':>7} difference")
    for edges in map(float, radii or (2, 10, 20, 65)):
        r = edges * index.mean_edge_length
        ours, theirs, sizes, difference = [], [], [], 0.0
        for v in np.linspace(0, len(V) - 1, QUERIES).astype(int):
            spent, (ids, found) = milliseconds(lambda: index.neighborhood(v, r, metric="path", return_distance=True))
            ours.append(spent)
            spent, expected = milliseconds(lambda: dijkstra(graph, indices=v, limit=r))
            theirs.append(spent)
            sizes.append(len(ids))
            assert np.isfinite(expected).sum() == len(ids)
            difference = max(difference, np.abs(expected[ids] - found).max())
        fast, slow = np.median(ours), np.median(theirs)
        size = np.median(sizes)
        print(f"{edges:6g} {size:9.0f} {fast:12.3f} {slow:9.1f} {slow / fast:7.1f} {difference:g}", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
