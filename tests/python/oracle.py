# SPDX-License-Identifier: MIT
"""Neighborhoods by SciPy, independent of this library: the component of the graph within the ball."""

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components


def graph(vertex_count, faces):
    """The edges of `faces`, a list of lists of corners."""
    ends = [(a, b) for face in faces for a, b in zip(face, face[1:] + face[:1])]
    rows, columns = np.array(ends or np.zeros((0, 2)), int).T
    return coo_array((np.ones(len(rows)), (rows, columns)), shape=(vertex_count, vertex_count)).tocsr()


def triangle_graph(vertex_count, triangles):
    triangles = triangles.astype(np.int32)  # csgraph of old versions of SciPy takes no other ids
    rows, columns = triangles.ravel(), np.roll(triangles, -1, axis=1).ravel()
    return coo_array((np.ones(len(rows)), (rows, columns)), shape=(vertex_count, vertex_count)).tocsr()


def distances(V, center):
    """From a vertex, or from a point."""
    center = V[center] if np.ndim(center) == 0 else center
    dx, dy, dz = (V.astype(np.float64) - np.asarray(center, np.float64)).T
    return np.sqrt((dx * dx + dy * dy) + dz * dz)


def ball(V, v, r):
    return np.flatnonzero(distances(V, v) <= r)


def neighborhood(V, edges, v, r):
    """Sorted."""
    inside = ball(V, v, r)
    labels = connected_components(edges[inside][:, inside], directed=False)[1]
    return inside[labels == labels[np.searchsorted(inside, v)]]
