# SPDX-License-Identifier: MIT
"""The types that a type checker finds: `mypy --strict` accepts these programs, with exactly these types."""

import site
import subprocess
import sys
from pathlib import Path

import meshhood
import pytest

PROGRAM = """
from typing import TYPE_CHECKING, Any, Union

import meshhood
import numpy as np
from meshhood import distributed
from numpy.typing import NDArray
from typing_extensions import assert_type

Ids = NDArray[np.int32]
Longs = NDArray[np.int64]
Reals = NDArray[np.float64]
Singles = NDArray[np.float32]
Floats = Union[Singles, Reals]
Offsets = Union[Ids, Longs]

mesh = meshhood.read_mesh("hand.ply")
assert_type(mesh.vertices, Union[NDArray[np.float32], Reals])
assert_type(mesh.faces, Union[Ids, tuple[Longs, Ids]])
index = meshhood.MeshIndex(*mesh, workers=2, progress=lambda done, total: print(done))
assert_type(len(index), int)
assert_type(index.n_vertices, int)
assert_type(index.nbytes, int)
assert_type(index.mean_edge_length, float)
assert_type(index.positions, Union[NDArray[np.float32], Reals])
assert_type(index.permutation, Ids)
assert_type(index.faces, Union[Ids, tuple[NDArray[np.signedinteger[Any]], Ids], None])
assert_type(meshhood.weld(*mesh, eps=0.1).ids, Ids)
assert_type(meshhood.weld(*mesh).faces, Union[Ids, tuple[Longs, Ids]])
assert_type(meshhood.__version__, str)
assert_type(meshhood.show_config(), None)

assert_type(index.neighborhood(1, 2), Ids)
assert_type(index.neighborhood(np.int64(1), np.float32(2), sort="id", unit="edge"), Ids)
assert_type(index.neighborhood(1, 2.0, return_distance=True), tuple[Ids, Floats])
assert_type(index.neighborhoods(2.0, [1, 2], method="bfs"), tuple[Offsets, Ids])
assert_type(index.neighborhoods([2.0, 3.0]), tuple[Offsets, Ids])
assert_type(index.neighborhoods(np.ones(3), np.arange(3), return_distance=True), tuple[Offsets, Ids, Floats])
assert_type(index.neighborhoods(1.0, index.permutation), tuple[Offsets, Ids])
assert_type(index.neighborhoods(1.0, np.ones(9, bool)), tuple[Offsets, Ids])
assert_type(index.count(1, 2.0, method=meshhood.Paper(radius_ratio=20)), int)
assert_type(index.counts(2.0, range(3)), Longs)
assert_type(index.counts(scales=[1.0, 2.0], vertices=3), Union[int, Longs])
walls = np.zeros(9, bool)
assert_type(index.neighborhoods(2.0, walls=walls, metric="path", dtype=np.float32), tuple[Offsets, Ids])
assert_type(index.neighborhoods(scales=[1.0, 2.0], vertices=[3]), tuple[Offsets, Ids])
assert_type(index.neighborhood(3, 2.0, walls=walls, return_distance=True), tuple[Ids, Floats])
assert_type(index.nested(3, range(4), metric="rings").ids, Ids)
assert_type(index.k_nearest(9).distances, Reals)
assert_type(index.discs(2.0, metric="path").indptr, Offsets)
assert_type(index.aggregate(np.ones(9), 2.0, "max"), Floats)
assert_type(index.aggregate(np.ones(9), 2.0, ("mean", "std"), kernel="box"), Floats)
assert_type(index.aggregate(np.ones(9, np.float32), scales=[1.0, 2.0], vertices=[3, 4]), Floats)
assert_type(index.aggregate([1.0, 2.0], 2.0, vertices=3), Union[float, Singles, Reals])
assert_type(index.smooth(np.ones(9, np.float32), 2.0, metric="path", walls=walls), Floats)
assert_type(index.smooth(np.ones(9), 2.0, weights="area"), Floats)
assert_type(index.nearest([0.0, 0.0, 1.0]), tuple[int, float])
assert_type(index.nearest([[0.0, 0.0, 1.0]]), tuple[Ids, Reals])
assert_type(index.nearest(np.ones((2, 3))), Union[tuple[int, float], tuple[Ids, Reals]])
assert_type(index.submesh([1, 2]).F, Union[Ids, tuple[Longs, Ids]])
assert_type(index.submesh([1, 2]).weights, Reals)
assert_type(index.curvature(scales=[2.0]).count, NDArray[np.uint32])
assert_type(index.curvature(2.0).mean, Floats)
assert_type(index.thickness(), Union[float, Reals])
assert_type(index.thickness(points=[[0.0, 0.0, 1.0]], face=[0], method="sphere"), Union[float, Reals])
assert_type(index.nearest_unconnected(2.0).vertex, Union[int, Ids])
assert_type(index.nearest_unconnected(2.0).distance, Union[float, Reals])
assert_type(index.closest_point([0.0, 0.0, 1.0]).face, Union[int, Longs])
assert_type(index.closest_point([0.0, 0.0, 1.0]).distance, Union[float, Reals])
assert_type(index.first_hit([0.0, 0.0, 1.0], [0.0, 0.0, 1.0]).face, Union[int, Longs])
assert_type(index.first_hit([0.0, 0.0, 1.0], [0.0, 0.0, 1.0]).distance, Union[float, Reals])
assert_type(index.measure(3, 2.0).volume, float)
assert_type(index.gap([0.0, 0.0, 1.0], 2.0, face=3, walls=walls), meshhood.Gap)
assert_type(index.gap(3, 2.0, unit="edge").face, int)
assert_type(meshhood.smoothing_radius(6.0), float)
assert_type(index.curvature(2.0, F=mesh.faces, fit="jet"), meshhood.Curvature)
assert_type(index.corrected_curvature(2.0, F=mesh.faces).mean, Floats)
assert_type(index.moments(2.0, degree=3, weights="area", F=mesh.faces), Floats)
assert_type(index.principal_components(2.0).surface_variation, Floats)
assert_type(index.features(meshhood.geometric_radii(1.0, 2.0, 3), F=mesh.faces, kinds=("crease", "mean")), Floats)
assert_type(meshhood.persistence(np.ones((1, 2)), [1.0], 0.5).scales, Ids)
for part in index.iter_neighborhoods(1.0, return_distance=True):
    assert_type(part.vertices, Ids)
    assert_type(part.indptr, Offsets)
    assert_type(part.distances, Union[Singles, Reals, None])
index.save("hand.index")
assert_type(meshhood.load("hand.index", mmap=True), meshhood.MeshIndex)

parts = meshhood.partition(("V.npy", "F.npy"), "parts", parts=2, halo=3.5, unit="edge", memory="4GiB")
assert_type(parts, distributed.Parts)
assert_type(meshhood.open_parts("parts").sizes, list[distributed.PartSize])
assert_type(parts.open(0).vertices, Longs)
assert_type(parts.open(0).owned, Ids)
assert_type(parts.neighborhoods(1.0, "out", format="zarr", progress=True), list[str])


def rows(part: distributed.OpenPart, index: meshhood.MeshIndex, owned: Ids) -> Longs:
    return index.counts(1.0, owned)


parts.map(rows, 1.0, order="parts")
assert_type(parts.write(rows, 1.0, "out"), list[str])
"""

REFUSED = (
    'index.neighborhoods(2.0, "1")',
    "index.neighborhood(1)",
    "index.neighborhood(1, [2.0])",
    'index.neighborhood(1, 2.0, method="fast")',
    'index.neighborhood(1, 2.0, unit="mile")',
    'index.neighborhoods(2.0, [1], metric="edge")',
    "index.count(1, 2.0, sort='id')",
    "index.iter_neighborhoods(vertices=1.0)",
    'index.features(2.0, kinds="sharp")',
    'index.aggregate([1.0], 2.0, ("mean", "sharp"))',
    'index.neighborhoods(2.0, [1], sort="length")',
    'index.curvature(2.0, metric="miles")',
    'index.smooth([1.0], 2.0, kernel="biweight")',
    "meshhood.Paper(factor=20)",
    "meshhood.load(3)",
)


def check(tmp_path, program):
    pytest.importorskip("mypy")
    file = tmp_path / "program.py"
    file.write_text(program)
    package = str(Path(meshhood.__file__).parents[1])
    search = {} if package in site.getsitepackages() else {"MYPYPATH": package}  # mypy refuses its own site-packages
    done = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path / "cache"), "program.py"],
        cwd=tmp_path,
        env={**search, "PATH": "/usr/bin:/bin"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode in (0, 1) and "source file" in done.stdout, done.stdout + done.stderr
    return [line for line in done.stdout.splitlines() if line.startswith("program.py") or "Traceback" in line], done


def test_the_types_are_exact(tmp_path):
    errors, done = check(tmp_path, PROGRAM)
    assert not errors, done.stdout


def test_wrong_calls_are_found(tmp_path):
    head = 'import meshhood\nindex = meshhood.load("hand.index")\n'
    errors, done = check(tmp_path, head + "\n".join(REFUSED))
    lines = {int(line.split(":")[1]) for line in errors if " error: " in line}
    assert lines == {number for number, _ in enumerate(REFUSED, start=3)}, done.stdout
