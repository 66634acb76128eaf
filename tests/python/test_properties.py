# SPDX-License-Identifier: MIT
"""`positions`, `mean_edge_length`, `unit="edge"`, and copies of subclasses."""

import pickle

import meshes
import meshhood
import numpy as np
import pytest

V, QUADS = meshes.grid(9)
F = meshes.triangles(QUADS)


@pytest.mark.parametrize("kind", (np.float32, np.float64))
def test_positions_are_those_given_read_only_and_kept(kind):
    given = V.astype(kind)
    index = meshhood.MeshIndex(given, F)
    found = index.positions
    assert found.dtype == kind and not found.flags.writeable
    np.testing.assert_array_equal(found, given)
    del index
    np.testing.assert_array_equal(found, given)
    with pytest.raises(ValueError):
        found[0, 0] = 1


def test_the_mean_edge_length_counts_each_edge_once():
    index = meshhood.MeshIndex(V, F)
    ends = np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]])
    edges = np.unique(np.sort(ends, axis=1), axis=0)
    lengths = np.linalg.norm(V[edges[:, 0]] - V[edges[:, 1]], axis=1)
    assert index.mean_edge_length == pytest.approx(lengths.mean())
    assert meshhood.MeshIndex(V, np.zeros((0, 3), int)).mean_edge_length == 0


def test_radii_in_edges_need_edges():
    index = meshhood.MeshIndex(V, np.zeros((0, 3), int))
    with pytest.raises(ValueError, match="unit: 'edge', but the mesh has no edges of positive length"):
        index.neighborhood(0, 1, unit="edge")
    with pytest.raises(ValueError, match="unit: 'inch', expected 'mesh' or 'edge'"):
        index.neighborhood(0, 1, unit="inch")


def test_what_an_index_holds_is_read_only_and_answers_belong_to_the_caller():
    index = meshhood.MeshIndex(V, F)
    assert len(index) == len(V) and str(len(V)) in repr(index) and index.nbytes > V.nbytes
    assert np.shares_memory(index.permutation, index.permutation)
    with pytest.raises(ValueError, match="read-only"):
        index.permutation[0] = 1
    before = index.neighborhood(5, 3.0).copy()
    index.neighborhood(5, 3.0)[:] = 0
    np.testing.assert_array_equal(index.neighborhood(5, 3.0), before)


class Named(meshhood.MeshIndex):
    def __init__(self, V, F, name):
        super().__init__(V, F)
        self.name = name


class Slotted(meshhood.MeshIndex):
    __slots__ = ("color",)


@pytest.mark.parametrize("protocol", range(2, pickle.HIGHEST_PROTOCOL + 1))
def test_a_pickled_subclass_keeps_its_class_and_attributes(protocol):
    named = Named(V, F, "hand")
    named.notes = ["left"]
    got = pickle.loads(pickle.dumps(named, protocol))
    assert type(got) is Named and got.name == "hand" and got.notes == ["left"]
    np.testing.assert_array_equal(got.neighborhood(40, 2.0, sort="id"), named.neighborhood(40, 2.0, sort="id"))
    slotted = Slotted(V, F)
    slotted.color, slotted.extra = "red", 7
    got = pickle.loads(pickle.dumps(slotted, protocol))
    assert type(got) is Slotted and got.color == "red" and got.extra == 7
