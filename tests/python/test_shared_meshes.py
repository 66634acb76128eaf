# SPDX-License-Identifier: MIT
"""Real meshes, compared with SciPy."""

import meshes
import meshhood
import numpy as np
import oracle
import pytest

NAMES = ("paper/tosca_cat2.off", "scan/cortex_left_41k.ply.zst", "scan/dragon_res4.ply", "cad/fandisk.off")
EDGES = (1.0, 3.0, 10.0)
VERTICES = 10


@pytest.mark.parametrize("name", NAMES)
def test_exact_equals_scipy(name, tmp_path):
    V, F = meshhood.read_mesh(meshes.shared(name, tmp_path))
    edges = oracle.triangle_graph(len(V), F.astype(int))
    length = np.linalg.norm(V[F[:, 0]] - V[F[:, 1]], axis=1).mean()
    index = meshhood.MeshIndex(V, F)
    rows = np.random.default_rng(5).integers(len(V), size=VERTICES)
    found = 0
    for r in length * np.array(EDGES):
        for method in ("exact", "bfs"):
            indptr, indices = index.neighborhoods(r, rows, sort="id", method=method)
            for v, ids in zip(rows, np.split(indices, indptr[1:-1])):
                np.testing.assert_array_equal(ids, oracle.neighborhood(V, edges, v, r))
        found += len(indices)
    print(f"{name}: {len(V)} vertices, {VERTICES * len(EDGES)} neighborhoods of {found} vertices in all")
