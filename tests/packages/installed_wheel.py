#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests the installed package where nothing else is but NumPy: the choice of kernels, answers compared with a
breadth-first search, files, the page, the command line, and the programs of examples/tasks, of which some need SciPy or
nilearn.

    installed_wheel.py [KERNELS]

KERNELS  the target that the kernels must use, as AVX2; by default the best one of the processor, as Linux names it

MESHHOOD_PROGRAM is how to run the command line, words between spaces; by default it is among the scripts of the
environment, and `none` says that it was not installed.
"""

import json
import os
import platform
import runpy
import subprocess
import sys
import sysconfig
import tempfile
import time
from pathlib import Path


def best_kernels():
    if platform.machine() in ("aarch64", "arm64"):
        return "NEON"
    text = Path("/proc/cpuinfo").read_text()
    flags = set(next(line for line in text.splitlines() if line.startswith("flags")).split())
    for kernels, needed in [
        ("AVX3", "avx512f avx512bw avx512dq avx512vl avx2 fma f16c bmi1 bmi2"),
        ("AVX2", "avx2 fma f16c bmi1 bmi2"),
        ("SSE4", "pni ssse3 sse4_1 sse4_2 popcnt"),
    ]:
        if flags.issuperset(needed.split()):
            return kernels
    return "SCALAR"


started = time.perf_counter()
import numpy as np  # noqa: E402

with_numpy = time.perf_counter()
import meshhood  # noqa: E402

imported = time.perf_counter()


def folded(side):
    """A grid whose halves nearly touch, so that every larger ball has vertices of both: positions and triangles."""
    x, y = (axis.ravel() for axis in np.meshgrid(np.arange(2 * side), np.arange(side)))
    V = np.column_stack([np.minimum(x, 2 * side - 1 - x), y, np.where(x < side, 0.0, 0.25)])
    first = (np.arange(side - 1)[:, None] * 2 * side + np.arange(2 * side - 1)).ravel()
    lower = np.column_stack([first, first + 1, first + 2 * side + 1])
    upper = np.column_stack([first, first + 2 * side + 1, first + 2 * side])
    return V + np.random.default_rng(7).uniform(-0.1, 0.1, V.shape), np.concatenate([lower, upper])


def breadth_first(V, neighbors, v, r):
    inside = ((V - V[v]) ** 2).sum(axis=1) <= r * r
    reached, queue = {v}, [v]
    for vertex in queue:
        for other in neighbors[vertex]:
            if inside[other] and other not in reached:
                reached.add(other)
                queue.append(other)
    return sorted(reached)


def check_answers(folder):
    V, F = folded(40)
    neighbors = [set() for _ in V]
    for triangle in F.tolist():
        for a in triangle:
            neighbors[a].update(triangle)
    random = np.random.default_rng(1)
    saved = folder / "folded.mhi"
    meshhood.MeshIndex(V, F).save(saved)
    sizes = []
    for kind in (np.float64, np.float32):
        positions = V.astype(kind)
        index = meshhood.MeshIndex(positions, F)
        for r in (0.0, 1.5, 4.0, 9.0):
            vertices = random.choice(len(V), 40, replace=False)
            indptr, indices = index.neighborhoods(r, vertices)
            for row, v in enumerate(vertices):
                expected = breadth_first(positions.astype(float), neighbors, v, r)
                assert sorted(indices[indptr[row] : indptr[row + 1]].tolist()) == expected, (kind, v, r)
                assert sorted(index.neighborhood(v, r).tolist()) == expected, (kind, v, r)
                sizes.append(len(expected))
    index = meshhood.MeshIndex(V, F)
    assert (meshhood.load(saved).counts(4.0) == index.counts(4.0)).all()
    assert np.isfinite(index.curvature(3.0).k1).all()
    assert np.allclose(index.smooth(np.ones(len(V)), fwhm=3.0), 1.0)
    assert "meshhood-mesh" in meshhood.view(V, F, v=5, r=3.0).html
    return sizes


def check_command(folder, kernels):
    program = os.environ.get("MESHHOOD_PROGRAM", "").split() or [Path(sysconfig.get_path("scripts")) / "meshhood"]
    if program == ["none"]:
        return

    def run(*arguments):
        return subprocess.run([*program, *arguments], cwd=folder, check=True, capture_output=True, text=True).stdout

    assert run("--version") == f"meshhood {meshhood.__version__}, kernels for {kernels}\n"
    run("generate", "scroll", "--vertices", "5000", "-o", "scroll.ply")
    run("batch", "scroll.ply", "-r", "5", "--unit", "edge", "-o", "scroll.npz", "--order", "vertex")
    V, F = meshhood.read_mesh(folder / "scroll.ply")[:2]
    rows = np.load(folder / "scroll.npz")
    indptr, indices = meshhood.MeshIndex(V, F).neighborhoods(5, unit="edge")
    assert (rows["indptr"] == indptr).all()
    assert sorted(rows["indices"][: indptr[1]]) == sorted(indices[: indptr[1]])
    assert "vertices" in json.loads(run("info", "scroll.ply", "--json"))
    run("view", "scroll.ply", "-v", "42", "-r", "10", "--unit", "edge", "-o", "scroll.html")
    assert (folder / "scroll.html").stat().st_size > (folder / "scroll.ply").stat().st_size


def run_examples(mesh):
    """Returns the names of those that ran."""
    names = []
    for path in sorted((Path(__file__).resolve().parents[2] / "examples" / "tasks").glob("*.py")):
        sys.argv[1:] = [str(mesh)]
        try:
            runpy.run_path(str(path))
        except ModuleNotFoundError as error:
            assert error.name.partition(".")[0] in ("scipy", "nilearn", "sklearn"), error
        else:
            names.append(path.stem)
    return names


def main():
    expected = sys.argv[1] if len(sys.argv) > 1 else best_kernels()
    kernels = meshhood._core.kernel_target()
    assert kernels == expected, f"kernels for {kernels}, expected {expected}"
    meshhood.show_config()
    with tempfile.TemporaryDirectory() as name:
        sizes = check_answers(Path(name))
        check_command(Path(name), kernels)
        meshhood.write_mesh(Path(name) / "folded.ply", *folded(30))
        examples = run_examples(Path(name) / "folded.ply")
    assert len(examples) >= 9, examples
    print(
        f"Python {platform.python_version()}, NumPy {np.__version__}, {platform.machine()}: {len(sizes)} neighborhoods "
        f"of {min(sizes)} to {max(sizes)} vertices; {len(examples)} examples; "
        f"imported in {1000 * (imported - with_numpy):.0f} ms, "
        f"after NumPy in {1000 * (with_numpy - started):.0f} ms"
    )


main()
