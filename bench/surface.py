# SPDX-License-Identifier: MIT
"""Queries for what is nearest: `python3 -m bench.surface MESH`. k nearest beside SciPy's kd-tree, which knows no
surface: seconds on all processors. Closest points and first hits beside Open3D (Embree, in single precision), if it
is installed: microseconds of one processor. All are the least of five rounds, in which they take turns."""

import argparse
import os
import time

import numpy as np
from scipy.spatial import cKDTree

import meshhood

ROUNDS = 5
POINTS = 1_000_000
LINK = 0.9  # about 15 neighbors a point, where the points have a mean density of 5


def time_of(call, clock):
    start = clock()
    call()
    return clock() - start


def least_times(*calls, clock=time.perf_counter):
    return np.min([[time_of(call, clock) for call in calls] for _ in range(ROUNDS)], axis=0)


def print_row(what, ours, theirs, name):
    print(f"{what:44} {ours:8.2f} {theirs:8.2f} {theirs / ours:8.2f}  {name}", flush=True)


def compare_points():
    points = np.random.default_rng(1).uniform(0, (POINTS / 5) ** (1 / 3), (POINTS, 3))
    print_row(
        f"from_points, {POINTS} points",
        *least_times(
            lambda: meshhood.MeshIndex.from_points(points, LINK),
            lambda: cKDTree(points).query_pairs(LINK, output_type="ndarray"),
        ),
        "cKDTree and query_pairs",
    )


def compare_mesh(path):
    V, F = meshhood.read_mesh(path)
    index, tree = meshhood.MeshIndex(V, F), cKDTree(V)
    for k in (10, 20, 50, 100):
        straight, path, knn = least_times(
            lambda k=k: index.k_nearest(k),
            lambda k=k: index.k_nearest(k, metric="path"),
            lambda k=k: tree.query(V, k, workers=-1),
        )
        for metric, ours in (("straight", straight), ("path", path)):
            print_row(f"k_nearest, {len(V)} vertices, k = {k}, {metric}", ours, knn, "cKDTree.query")


def compare_surface(path):
    try:
        import open3d
    except ImportError:
        print("skipped: Open3D is not installed")
        return
    os.sched_setaffinity(0, {0})
    V, F = meshhood.read_mesh(path)
    index = meshhood.MeshIndex(V, F)
    scene = open3d.t.geometry.RaycastingScene()
    scene.add_triangles(V.astype(np.float32), F.astype(np.uint32))
    random = np.random.default_rng(2)
    on_faces = sample_faces(V, F, random)
    for name, points in families(V, on_faces, index.mean_edge_length, random).items():
        single = points.astype(np.float32)
        compare_calls(f"closest_point, {name}", len(points), lambda: index.closest_point(points, workers=1),
                      lambda: scene.compute_closest_points(open3d.core.Tensor(single)))
    camera = np.tile(V.mean(0) + 2 * (V.max(0) - V.min(0)), (len(on_faces), 1))
    for name, starts in {"from a camera": camera, "from the surface": on_faces[::-1].copy()}.items():
        ways = on_faces - starts
        rays = np.hstack([starts, ways]).astype(np.float32)
        compare_calls(f"first_hit, {name}", len(rays), lambda: index.first_hit(starts, ways, workers=1),
                      lambda: scene.cast_rays(open3d.core.Tensor(rays)))


def sample_faces(V, F, random):
    faces = random.integers(len(F), size=40_000)
    return np.einsum("nc,ncx->nx", random.dirichlet(np.ones(3), len(faces)), V[F[faces]])


def families(V, on_faces, edge, random):
    """Points by their distance from the surface."""
    noise = random.normal(size=on_faces.shape)
    noise /= np.linalg.norm(noise, axis=1)[:, None]
    steps = edge * random.uniform(size=(len(noise), 1)) * noise
    near = {f"within {k} mean edges": on_faces + k * steps for k in (0.1, 1, 10)}
    return {**near, "in the box": random.uniform(V.min(0), V.max(0), on_faces.shape)}


def compare_calls(what, count, ours, theirs):
    print_row(what, *(1e6 / count * least_times(ours, theirs, clock=time.process_time)), "Open3D")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("mesh")
    arguments = parser.parse_args()
    print(f"{'':44} {'meshhood':>8} {'other':>8} {'ratio':>8}")
    compare_points()
    compare_mesh(arguments.mesh)
    compare_surface(arguments.mesh)


if __name__ == "__main__":
    main()
