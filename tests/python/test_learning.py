# SPDX-License-Identifier: MIT
"""What networks for learning take: results whose memory other libraries share."""

import numpy as np
import pytest
from meshes import grid, triangles

import meshhood

V, QUADS = grid(9)
INDEX = meshhood.MeshIndex(V, triangles(QUADS))
R = 2.5


def test_results_share_their_memory():
    indptr, indices, distances = INDEX.neighborhoods(R, return_distance=True)
    ids, mask = meshhood.padded(indptr, indices)
    for result in (indptr, indices, distances, ids, mask, INDEX.counts(R), INDEX.curvature(R).mean):
        assert np.shares_memory(np.from_dlpack(result), result)


def test_tensors_share_the_memory_of_results():
    torch = pytest.importorskip("torch")
    ids = INDEX.neighborhood(40, R)
    assert np.shares_memory(torch.from_dlpack(ids).numpy(), ids)
