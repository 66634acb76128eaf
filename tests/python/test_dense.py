# SPDX-License-Identifier: MIT
"""What is summed over neighborhoods, compared with dense sums that share no code with the library: NumPy over the
vertices that SciPy finds."""

import meshes
import meshhood
import numpy as np
import oracle
import pytest


def bumpy(side):
    V, quads = meshes.grid(side)
    V[:, 2] = np.sin(0.7 * V[:, 0]) * np.cos(0.5 * V[:, 1])
    V[:, :2] += np.random.default_rng(side).uniform(-0.2, 0.2, (len(V), 2))
    return V, quads


def graded(far):
    """A curved patch of spacing 0.01, joined at its corners to four faces of size `far`."""
    V, quads = meshes.grid(20)
    x, y = 0.01 * V[:, 0], 0.01 * V[:, 1]
    V = np.column_stack([x, y, 0.3 * x + 2 * (x * x + y * y)])
    ring = far * np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    corners = np.array([0, 19, 399, 380])
    sides = [[400 + i, 400 + (i + 1) % 4, corners[(i + 1) % 4], corners[i]] for i in range(4)]
    return np.vstack([V, ring]), np.vstack([quads, sides])


def edges_of(V, F):
    return oracle.graph(len(V), F.tolist())


def newell(V, face):
    """The vector area of a polygon."""
    p = V[face] - V[face[0]]
    return np.cross(p, np.roll(p, -1, axis=0)).sum(axis=0) / 2


def areas_and_normals(V, F):
    """Of a vertex: its share of the areas of its faces, and the direction of the sum of their vector areas."""
    areas, normals = np.zeros(len(V)), np.zeros_like(V)
    for face in F:
        vector = newell(V, face)
        areas[face] += np.linalg.norm(vector) / len(face)
        normals[face] += vector
    with np.errstate(invalid="ignore"):
        return areas, normals / np.linalg.norm(normals, axis=1)[:, None]


@pytest.mark.parametrize("make", (lambda: bumpy(14), lambda: graded(1e2), lambda: graded(1e6)))
def test_height_and_variation_are_dense_sums(make):
    V, F = make()
    index, edges = meshhood.MeshIndex(V, F), edges_of(V, F)
    areas, normals = areas_and_normals(V, F)
    unit = np.linalg.norm(V[1] - V[0])
    radii = unit * np.array([0.5, 2.3, 5.0])
    found = index.features(scales=radii, F=F, kinds=("height", "variation"))
    for i, r in enumerate(radii):
        for v in range(0, len(V), 3):
            ids = oracle.neighborhood(V, edges, v, r)
            if len(ids) > 1 and areas[ids].max() > 100 * np.median(areas[ids]):
                continue  # a corner that has the area of the large faces: the others are lost beside it
            p, w = V[ids] - V[v], areas[ids]
            center = (w[:, None] * p).sum(axis=0) / w.sum()
            np.testing.assert_allclose(found[i, v, 0], -4 / r * (center @ normals[v]), rtol=1e-9, atol=1e-11)
            if len(ids) < 4:
                continue
            values = np.linalg.svd(np.sqrt(w / w.sum())[:, None] * (p - center), compute_uv=False) ** 2
            np.testing.assert_allclose(found[i, v, 1], values[2] / values.sum(), rtol=1e-7, atol=1e-12)


def corrected_measures(V, F, normals):
    """The twelve measures that each vertex holds: those of the triangles of a polygon around its middle, whose normal
    is the mean of those of the corners."""
    held = np.zeros((len(V), 12))
    for face in F:
        if len(face) == 3:
            triangles = [(V[face], normals[face])]
        else:
            middle, mean = V[face].mean(axis=0), normals[face].sum(axis=0)
            mean /= np.linalg.norm(mean)
            pairs = zip(face, np.roll(face, -1))
            triangles = [(np.array([V[a], V[b], middle]), np.array([normals[a], normals[b], mean])) for a, b in pairs]
        total = np.zeros(12)
        for x, u in triangles:
            m = u.mean(axis=0)
            # The formulas of Lachaud et al. 2020, with corners in place of sides.
            area = np.linalg.det([m, x[1] - x[0], x[2] - x[0]]) / 2
            mean_curvature = sum(m @ np.cross(u[(i + 2) % 3] - u[(i + 1) % 3], x[i]) for i in range(3)) / 2
            gaussian = np.linalg.det(u) / 2
            tensor = [
                (m @ np.cross(e, x[1] - x[0]) * (u[2] - u[0]) - m @ np.cross(e, x[2] - x[0]) * (u[1] - u[0])) / 2
                for e in np.eye(3)
            ]
            total += np.concatenate([[area, mean_curvature, gaussian], np.ravel(tensor)])
        if not np.isnan(total).any():
            held[face] += total / len(face)
    return held


@pytest.mark.parametrize("split", (False, True))
@pytest.mark.parametrize("make", (lambda: bumpy(14), lambda: graded(1e2)))
def test_corrected_curvature_is_a_dense_sum(make, split):
    V, F = make()
    F = meshes.triangles(F) if split else F
    index, edges = meshhood.MeshIndex(V, F), edges_of(V, F)
    _, normals = areas_and_normals(V, F)
    held = corrected_measures(V, F, normals)
    r = 4 * np.linalg.norm(V[1] - V[0])
    c = index.corrected_curvature(r, F=F)
    for v in range(0, len(V), 3):
        ids = oracle.neighborhood(V, edges, v, r)
        m, terms = held[ids].sum(axis=0), abs(held[ids]).sum(axis=0)
        np.testing.assert_array_less(abs(c.measures[v] - m), 1e-9 * terms + 1e-300)
        by_area = [m[0], m[1] / (2 * m[0]), m[2] / m[0]]
        np.testing.assert_allclose([c.area[v], c.mean[v], c.gaussian[v]], by_area, rtol=1e-6)
        tangent = np.linalg.svd(normals[v][None])[2][1:]
        tensor = m[3:].reshape(3, 3)
        low, high = np.linalg.eigvalsh(tangent @ (tensor + tensor.T) / 2 @ tangent.T)
        scale = max(abs(low), abs(high)) / abs(m[0])
        np.testing.assert_allclose([c.k1[v], c.k2[v]], [-low / m[0], -high / m[0]], atol=1e-6 * scale)

