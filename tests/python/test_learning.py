# SPDX-License-Identifier: MIT
"""What networks for learning take: edge lists, and results whose memory other libraries share."""

import numpy as np
import pytest
from meshes import grid, triangles

import meshhood

V, QUADS = grid(9)
INDEX = meshhood.MeshIndex(V, triangles(QUADS))
R = 2.5


def edge_list():
    """`edge_index` of PyTorch Geometric: (2, #edges) int64, from a neighbor to the vertex whose neighborhood has it."""
    indptr, indices = INDEX.neighborhoods(R)
    return np.stack([indices, np.repeat(np.arange(len(V)), np.diff(indptr))]).astype(np.int64)


def without_self(edges):
    return edges[:, edges[0] != edges[1]]


def in_order(pairs):
    return pairs[:, np.lexsort(pairs)]


def test_edge_lists_are_those_of_the_matrix():
    edges = edge_list()
    assert edges.shape == (2, INDEX.counts(R).sum())
    assert edges.dtype == np.int64
    matrix = INDEX.radius_neighbors_graph(R).tocoo()
    np.testing.assert_array_equal(in_order(edges), in_order(np.stack([matrix.col, matrix.row])))


def test_each_vertex_is_in_its_neighborhood_once():
    edges, matrix = edge_list(), INDEX.radius_neighbors_graph(R)
    assert edges.shape[1] - without_self(edges).shape[1] == len(V)
    matrix.setdiag(0)
    matrix.eliminate_zeros()
    others = matrix.tocoo()
    np.testing.assert_array_equal(in_order(without_self(edges)), in_order(np.stack([others.col, others.row])))


def test_results_share_their_memory():
    indptr, indices, distances = INDEX.neighborhoods(R, return_distance=True)
    ids, mask = meshhood.padded(indptr, indices)
    for result in (indptr, indices, distances, ids, mask, INDEX.counts(R), INDEX.curvature(R).mean):
        assert np.shares_memory(np.from_dlpack(result), result)


def test_tensors_share_the_memory_of_results():
    torch = pytest.importorskip("torch")
    edges = without_self(edge_list())
    tensor = torch.from_numpy(edges)
    assert tensor.dtype == torch.int64
    assert np.shares_memory(tensor.numpy(), edges)
    ids = INDEX.neighborhood(40, R)
    assert np.shares_memory(torch.from_dlpack(ids).numpy(), ids)
