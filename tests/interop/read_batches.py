#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Reads what `meshhood batch` writes with NumPy, SciPy and `unzip -t`; tests/cli/run_pairs.py compares the rows.

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
    from scipy import sparse
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(SKIPPED)


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


def check_matrix(file, dtype):
    matrix, arrays = sparse.load_npz(file), np.load(file)
    assert matrix.format == "csr" and matrix.shape == tuple(arrays["shape"]), f"shape {matrix.shape}"
    assert matrix.dtype == dtype and matrix.indices.dtype == matrix.indptr.dtype == np.int32, "types"
    matrix.check_format(full_check=True)
    assert matrix.has_canonical_format, "a row is not sorted, or has duplicates"
    assert matrix.nnz > 0 and np.array_equal(matrix.indices, arrays["indices"]), "rows"
    assert dtype != bool or matrix.data.all(), "values"


def check_index_order(file, names):
    """The default. SciPy would ignore whose row it is, so it must refuse the file."""
    try:
        sparse.load_npz(file)
    except ValueError as refusal:
        assert "does not contain a sparse" in str(refusal), refusal
    else:
        raise AssertionError("SciPy took rows in index order for a matrix")
    assert np.load(file).files == names, np.load(file).files


def main(program):
    with tempfile.TemporaryDirectory() as folder:
        batches = Batches(Path(program).resolve(), Path(folder))
        (batches.folder / "list.txt").write_text("# some\n17\n3\n3\n0\n", encoding="utf-8")
        for shape in SHAPES:
            batches.run("generate", shape, "--vertices", str(VERTICES), "-o", "mesh.ply")
            for options in ["--order", "vertex"], ["--vertices", "list.txt"], ["--method", "paper"]:
                check_matrix(batches.file(*options), bool)
                check_matrix(batches.file(*options, "--distances"), np.float64)
            check_index_order(batches.file(), ["vertices", "indptr", "indices"])
            check_index_order(batches.file("--distances"), ["vertices", "indptr", "indices", "distances"])
            assert np.load(batches.file("--count")).files == ["radii", "count"]
            print(f"{shape}: read by SciPy")
    print("unzip -t found no fault" if UNZIP else "skipped: unzip is not installed")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
