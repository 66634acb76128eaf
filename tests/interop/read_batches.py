#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Reads what `meshhood batch` writes with NumPy, SciPy and `unzip -t`. Compares it with components that SciPy finds.

    read_batches.py MESHHOOD

Exit code 77, skipped, without the libraries.
"""

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77
SHAPES = ("scroll", "plates", "soup", "ngons", "star", "isolated")
VERTICES = 700
RADIUS = 2.5
UNZIP = shutil.which("unzip")

try:
    import numpy as np
    import plyfile
    from scipy import sparse
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(SKIPPED)


class Oracle:
    """Neighborhoods by SciPy, with the arithmetic that meshhood promises."""

    def __init__(self, file):
        mesh = plyfile.PlyData.read(file)
        self.positions = np.stack([mesh["vertex"][axis] for axis in "xyz"], axis=1).astype(np.float64)
        faces = mesh["face"]["vertex_indices"] if mesh["face"].count else []
        edges = [(a, b) for face in faces for a, b in zip(face, np.roll(face, 1))]
        ends = np.array(edges, int).reshape(-1, 2).T
        size = len(self.positions)
        self.graph = sparse.coo_array((np.ones(ends.shape[1]), ends), shape=(size, size)).tocsr()

    def row(self, v):
        """The vertices, ascending, and their distances."""
        x, y, z = (self.positions - self.positions[v]).T
        distances = np.sqrt((x * x + y * y) + z * z)
        ball = np.flatnonzero(distances <= RADIUS)
        _, part = sparse.csgraph.connected_components(self.graph[ball][:, ball], directed=False)
        vertices = ball[part == part[np.searchsorted(ball, v)]]
        return vertices, distances[vertices]


class Batches:
    def __init__(self, program, folder):
        self.program = program
        self.folder = folder

    def run(self, *arguments):
        return subprocess.run([self.program, *arguments], cwd=self.folder, check=True, capture_output=True, text=True).stdout

    def file(self, *options):
        self.run("batch", "mesh.ply", "-r", str(RADIUS), *options, "-o", "out.npz")
        if UNZIP:
            subprocess.run([UNZIP, "-tqq", "out.npz"], cwd=self.folder, check=True)
        return self.folder / "out.npz"


def check_matrix(matrix, rows, size, dtype):
    assert matrix.format == "csr" and matrix.shape == (len(rows), size), f"shape {matrix.shape}"
    assert matrix.dtype == dtype and matrix.indices.dtype == matrix.indptr.dtype == np.int32, "types"
    matrix.check_format(full_check=True)
    assert matrix.has_canonical_format, "a row is not sorted, or has duplicates"
    for i, (vertices, distances) in enumerate(rows):
        found = slice(*matrix.indptr[i:i + 2])
        assert np.array_equal(matrix.indices[found], vertices), f"row {i}: {matrix.indices[found]}, expected {vertices}"
        values = distances if dtype == np.float64 else np.ones(len(vertices), bool)
        assert np.array_equal(matrix.data[found], values), f"row {i}: values differ"


def check_exact(batches, oracle):
    size = len(oracle.positions)
    rows = [oracle.row(v) for v in range(size)]
    check_matrix(sparse.load_npz(batches.file("--order", "vertex")), rows, size, bool)
    check_matrix(sparse.load_npz(batches.file("--order", "vertex", "--distances")), rows, size, np.float64)
    check_index_order(batches, rows)
    counts = np.load(batches.file("--count"))
    assert counts.files == ["radii", "count"], counts.files
    assert np.array_equal(counts["count"], [[len(vertices) for vertices, _ in rows]]), "counts"


def check_index_order(batches, rows):
    """The default. SciPy would ignore whose row it is, so it must refuse the file."""
    for options in [], ["--distances"]:
        file = batches.file(*options)
        try:
            sparse.load_npz(file)
        except ValueError as refusal:
            assert "does not contain a sparse" in str(refusal), refusal
        else:
            raise AssertionError("SciPy took rows in index order for a matrix")
        arrays = np.load(file)
        assert arrays.files == ["vertices", "indptr", "indices", *(["distances"] if options else [])], arrays.files
        assert np.array_equal(np.sort(arrays["vertices"]), np.arange(len(rows))), "vertices"
        for v, begin, end in zip(arrays["vertices"], arrays["indptr"], arrays["indptr"][1:]):
            vertices, distances = rows[v]
            assert np.array_equal(arrays["indices"][begin:end], vertices), f"vertex {v}"
            assert not options or np.array_equal(arrays["distances"][begin:end], distances), f"distances of vertex {v}"


def check_listed(batches, oracle):
    listed = [17, 3, 3, len(oracle.positions) - 1, 0]
    (batches.folder / "list.txt").write_text("# some\n" + "\n".join(map(str, listed)) + "\n", encoding="utf-8")
    rows = [oracle.row(v) for v in listed]
    for file in batches.file("--vertices", "list.txt"), batches.file("--vertices", "list.txt", "--count"):
        assert np.array_equal(np.load(file)["vertices"], listed), "vertices"
    check_matrix(sparse.load_npz(batches.file("--vertices", "list.txt")), rows, len(oracle.positions), bool)


def check_paper(batches, oracle):
    matrix = sparse.load_npz(batches.file("--method", "paper"))
    for v in range(0, len(oracle.positions), 50):
        answer = batches.run("query", "mesh.ply", "-v", str(v), "-r", str(RADIUS), "--method", "paper")
        assert np.array_equal(matrix.indices[slice(*matrix.indptr[v:v + 2])], list(map(int, answer.split()))), f"paper {v}"


def check_threads(batches):
    for options in [], ["--distances"], ["--order", "vertex"], ["--method", "paper"]:
        one, three = (batches.file("--threads", n, *options).read_bytes() for n in "13")
        assert one == three, f"the number of threads shows in {options}"


def main(program):
    with tempfile.TemporaryDirectory() as folder:
        batches = Batches(Path(program).resolve(), Path(folder))
        for shape in SHAPES:
            batches.run("generate", shape, "--vertices", str(VERTICES), "-o", "mesh.ply")
            oracle = Oracle(batches.folder / "mesh.ply")
            check_exact(batches, oracle)
            check_listed(batches, oracle)
            check_paper(batches, oracle)
            check_threads(batches)
            print(f"{shape}: {len(oracle.positions)} rows as SciPy finds them")
    print("unzip -t found no fault" if UNZIP else "skipped: unzip is not installed")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
