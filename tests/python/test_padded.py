# SPDX-License-Identifier: MIT
"""Rows of different lengths as one array with a mask."""

from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
from meshes import grid, triangles

import meshhood

V, QUADS = grid(9)
INDEX = meshhood.MeshIndex(V, triangles(QUADS))
INDPTR, INDICES, DISTANCES = INDEX.neighborhoods(2.5, return_distance=True)


def row(i):
    return slice(INDPTR[i], INDPTR[i + 1])


def test_rows_are_those_of_the_lists():
    ids, mask = meshhood.padded(INDPTR, INDICES)
    lengths, same = meshhood.padded(INDPTR, DISTANCES, fill=np.inf)
    assert ids.shape == mask.shape == (len(V), INDEX.counts(2.5).max())
    assert (ids.dtype, mask.dtype, lengths.dtype) == (INDICES.dtype, bool, DISTANCES.dtype)
    np.testing.assert_array_equal(mask, same)
    for i in range(len(V)):
        np.testing.assert_array_equal(ids[i][mask[i]], INDICES[row(i)])
        np.testing.assert_array_equal(lengths[i], np.r_[DISTANCES[row(i)], np.full((~mask[i]).sum(), np.inf)])
    assert (ids[~mask] == 0).all()


def test_values_may_have_further_axes():
    places, mask = meshhood.padded(INDPTR, V[INDICES])
    assert places.shape == (*mask.shape, 3)
    np.testing.assert_array_equal(places[mask], V[INDICES])


@pytest.mark.parametrize("width", (0, 1, 5, 200))
def test_rows_are_cut_or_filled_to_a_width(width):
    ids, mask = meshhood.padded(INDPTR, INDICES, width=width, truncate=True)
    assert ids.shape == mask.shape == (len(V), width)
    for i in range(len(V)):
        np.testing.assert_array_equal(ids[i][mask[i]], INDICES[row(i)][:width])


def test_a_longer_row_is_refused_unless_it_may_be_cut():
    longest = int(np.diff(INDPTR).max())
    row = int(np.argmax(np.diff(INDPTR) == longest))
    assert meshhood.padded(INDPTR, INDICES, width=longest)[0].shape[1] == longest
    with pytest.raises(ValueError, match=f"width: {longest - 1}, but row {row} has {longest} values; truncate=True keeps"):
        meshhood.padded(INDPTR, INDICES, width=longest - 1)


def test_no_rows_and_empty_rows():
    assert meshhood.padded([0], np.zeros(0, np.int32))[0].shape == (0, 0)
    ids, mask = meshhood.padded([0, 0, 2], [7, 8])
    assert ids.tolist() == [[0, 0], [7, 8]]
    assert mask.tolist() == [[False, False], [True, True]]


@pytest.mark.parametrize(
    ("indptr", "values", "message"),
    (
        ([], [], r"indptr: expected #rows \+ 1 integers, not float64 of shape \(0,\)"),
        ([[0, 1]], [3], r"indptr: expected #rows \+ 1 integers, not int64 of shape \(1, 2\)"),
        ([1, 2], [3, 4], "indptr: runs from 1 to 2, expected from 0 to the number of values, 2"),
        ([0, 3], [3, 4], "indptr: runs from 0 to 3, expected from 0 to the number of values, 2"),
        ([0, 1], 3, "indptr: runs from 0 to 1, expected from 0 to the number of values, a single one"),
        ([0, 2, 1, 2], [3, 4], "indptr: descends at 2, from 2 to 1"),
    ),
)
def test_what_are_no_rows_is_refused(indptr, values, message):
    with pytest.raises(ValueError, match=message):
        meshhood.padded(indptr, values)


@pytest.mark.parametrize("fill", (0.5, np.nan, 2**40, [7, 8]))
def test_a_fill_that_the_values_cannot_hold_is_refused(fill):
    with pytest.raises(ValueError, match="fill: .*, expected one value of int32"):
        meshhood.padded(INDPTR, INDICES, fill=fill)


@pytest.mark.parametrize(("fill", "held"), ((None, np.nan), (Decimal("0.5"), 0.5), (Fraction(1, 4), 0.25)))
def test_objects_that_are_floats_fill_only_floats(fill, held):
    array, mask = meshhood.padded(INDPTR, DISTANCES, fill=fill)
    np.testing.assert_array_equal(array[~mask], held)
    with pytest.raises(ValueError, match="fill: .*, expected one value of int32"):
        meshhood.padded(INDPTR, INDICES, fill=fill)


def test_the_limit_counts_the_mask_once():
    values = np.zeros((4, 100), np.uint8)
    assert meshhood.padded([0, 2, 4], values, max_bytes=404)[0].nbytes == 400
    with pytest.raises(MemoryError, match="404 bytes, exceeds max_bytes, 403"):
        meshhood.padded([0, 2, 4], values, max_bytes=403)


def test_a_width_is_a_number_and_a_large_result_is_refused():
    with pytest.raises(ValueError, match="width: -1, expected 0 to 2147483647"):
        meshhood.padded(INDPTR, INDICES, width=-1)
    with pytest.raises(MemoryError, match="exceeds max_bytes, 1000"):
        meshhood.padded(INDPTR, INDICES, max_bytes=1000)
    with pytest.raises(MemoryError, match="take fewer vertices"):
        meshhood.padded(INDPTR, INDICES, width=2**31 - 1)
