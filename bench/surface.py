# SPDX-License-Identifier: MIT
"""Queries for what is nearest beside SciPy's kd-tree, which knows no surface: `python3 -m bench.surface MESH`. Seconds,
the least of three rounds, on all processors."""

import argparse
import time

import numpy as np
from scipy.spatial import cKDTree

import meshhood

ROUNDS = 3
POINTS = 1_000_000
LINK = 0.9  # about 15 neighbors a point, where the points have a mean density of 5


def least_time(call):
    times = []
    for _ in range(ROUNDS):
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return min(times)


def print_row(what, ours, theirs, name):
    print(f"{what:44} {ours:8.2f} {theirs:8.2f} {theirs / ours:8.2f}  {name}", flush=True)


def compare_points():
    points = np.random.default_rng(1).uniform(0, (POINTS / 5) ** (1 / 3), (POINTS, 3))
    print_row(
        f"from_points, {POINTS} points",
        least_time(lambda: meshhood.MeshIndex.from_points(points, LINK)),
        least_time(lambda: cKDTree(points).query_pairs(LINK, output_type="ndarray")),
        "cKDTree and query_pairs",
    )


def compare_mesh(path):
    V, F = meshhood.read_mesh(path)
    index, tree = meshhood.MeshIndex(V, F), cKDTree(V)
    for k in (10, 20, 50, 100):
        knn = least_time(lambda k=k: tree.query(V, k, workers=-1))
        for metric in ("straight", "path"):
            ours = least_time(lambda k=k, metric=metric: index.k_nearest(k, metric=metric))
            print_row(f"k_nearest, {len(V)} vertices, k = {k}, {metric}", ours, knn, "cKDTree.query")
    random = np.random.default_rng(2)
    faces = random.integers(len(F), size=100_000)
    on_faces = np.einsum("nc,ncx->nx", random.dirichlet(np.ones(3), len(faces)), V[F[faces]])
    points = on_faces + random.normal(0, index.mean_edge_length, on_faces.shape)
    index.closest_point(points[0])
    print_row(
        f"closest_point, {len(points)} points",
        least_time(lambda: index.closest_point(points)),
        least_time(lambda: tree.query(points, workers=-1)),
        "cKDTree.query, the nearest vertex",
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("mesh")
    arguments = parser.parse_args()
    print(f"{'':44} {'meshhood':>8} {'SciPy':>8} {'ratio':>8}")
    compare_points()
    compare_mesh(arguments.mesh)


if __name__ == "__main__":
    main()
