# SPDX-License-Identifier: MIT
"""The edges of a mesh of triangles."""
import numpy as np


def edges_of(mesh):
    """Each once: #E by 2."""
    corners = mesh.triangles
    edges = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
    return np.unique(np.sort(edges, axis=1), axis=0)


def lengths_of(mesh, edges):
    ends = mesh.positions[edges].astype(float)
    return np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
