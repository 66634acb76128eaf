# SPDX-License-Identifier: MIT
"""Meshes in parts: their exactness, time and memory.

python3 -m bench.scale verify MESH      a mesh in 2, 7 and 32 parts, compared with one index
python3 -m bench.scale grow COUNT       a mesh of COUNT vertices by formula: partition; counts, mean positions and curvatures
                                        of all vertices at 5 edges

Needs the package meshhood with [dask]. Temporary files go to --folder, about 150 bytes a vertex.
"""

import argparse
import functools
import math
import os
import shutil
import tempfile
import threading
import time
from pathlib import Path

import numpy as np

import meshhood

_ROWS = 1 << 20  # written at a time


def verify(mesh, folder):
    """All counts at 5 and 10 edges, and the ids of 20,000 vertices at 65 edges, which is the halo."""
    halo = 65
    index = meshhood.MeshIndex(*meshhood.read_mesh(mesh))
    edge = index.mean_edge_length
    sample = np.sort(np.random.default_rng(1).choice(len(index), min(20_000, len(index)), replace=False))
    counts = {r: index.counts(r * edge) for r in (5, 10)}
    print(f"{Path(mesh).name}: {len(index)} vertices, halo {halo} edges")
    print("| parts | vertices with halos | partition, s | counts that differ | samples | ids that differ |")
    print("|--:|--:|--:|--:|--:|--:|")
    for number in (2, 7, 32):
        start = time.monotonic()
        parts = meshhood.partition(mesh, folder / f"{number}", parts=number, halo=halo, unit="edge", memory="4GiB")
        seconds = time.monotonic() - start
        wrong = sum(int((parts.counts(r, unit="edge").compute() != expected).sum()) for r, expected in counts.items())
        samples, wrong_ids = compare_ids(parts, index, sample)
        total = sum(size.vertices for size in parts.sizes)
        print(
            f"| {number} | {total / len(index):.2f} #V | {seconds:.0f} | {wrong} of {2 * len(index)} | {samples} | {wrong_ids} |",
            flush=True,
        )
        shutil.rmtree(folder / f"{number}")


def compare_ids(parts, index, sample):
    """The number of compared rows, and of ids that only one of the answers has."""
    rows = wrong = 0
    for number in range(len(parts)):
        part = parts.open(number)
        numbers = part.owned[np.isin(part.vertices[part.owned], sample)]
        for chunk in part.index.iter_neighborhoods(parts.halo, numbers, chunk=500, sort="id"):
            expected = index.neighborhoods(parts.halo, part.vertices[chunk.vertices], sort="id")
            same = np.array_equal(chunk.indptr, expected[0])
            found = part.vertices[chunk.indices]
            wrong += np.count_nonzero(found != expected[1]) if same else len(found)
            rows += len(chunk.vertices)
    return rows, wrong


def grow(count, folder, vertices_per_part, memory):
    side = math.isqrt(count)
    stages = {}
    with Peak() as peak:
        with stage("write", stages):
            write_grid(side, folder / "V.npy", folder / "F.npy")
        mesh = folder / "V.npy", folder / "F.npy"
        with stage("partition", stages):
            parts = meshhood.partition(
                mesh, folder / "parts", vertices_per_part=vertices_per_part, halo=5, unit="edge", memory=memory
            )
        radius = 5 * parts.mean_edge_length
        with stage("counts", stages):
            paths = parts.write(functools.partial(_counts, radius), radius, folder / "counts")
        with stage("means", stages):
            parts.write(functools.partial(_mean_positions, radius, mesh[0]), radius, folder / "means")
        with stage("curvature", stages):
            parts.write(functools.partial(_curvatures, radius), radius, folder / "curvature")
    total = sum(int(np.load(path, mmap_mode="r").sum()) for path in paths)
    with_halo = sum(size.vertices for size in parts.sizes) / parts.n_vertices
    print(f"| vertices | parts | vertices with halos | {', s | '.join(stages)}, s | peak, MB | vertices found |")
    print("|--:" * (5 + len(stages)) + "|")
    times = " | ".join(f"{seconds:.0f}" for seconds in stages.values())
    print(f"| {parts.n_vertices} | {len(parts)} | {with_halo:.3f} #V | {times} | {peak.bytes / 1e6:.0f} | {total} |")


def _counts(radius, part, index, owned):
    return index.counts(radius, owned, workers=1)


def _mean_positions(radius, positions, part, index, owned):
    values = np.load(positions, mmap_mode="r")[part.vertices]
    return index.aggregate(values, radius, vertices=owned, workers=1)


def _curvatures(radius, part, index, owned):
    found = index.curvature(radius, owned, F=part.mesh.faces, workers=1)
    return np.column_stack([found.k1, found.k2])


def write_grid(side, positions, faces):
    """A wavy grid of side by side vertices, row by row, in two triangles a cell."""
    step = max(1, _ROWS // side)
    with array_file(positions, "<f4", (side * side, 3)) as V, array_file(faces, "<i4", (2 * (side - 1) ** 2, 3)) as F:
        for first in range(0, side, step):
            y, x = np.mgrid[first : min(first + step, side), 0:side]
            z = 3 * np.sin(x / 15) * np.cos(y / 20)
            V.write(np.column_stack([x.ravel(), y.ravel(), z.ravel()]).astype("<f4"))
            corner = (y[:, :-1] * side + x[:, :-1])[y[:, 0] < side - 1].ravel()
            cells = np.stack([corner, corner + 1, corner + side + 1, corner, corner + side + 1, corner + side], axis=1)
            F.write(cells.astype("<i4"))


def array_file(path, dtype, shape):
    """A `.npy` file whose rows are to be written in order; a mapped one would count as memory."""
    file = open(path, "wb")
    np.lib.format.write_array_header_1_0(file, {"descr": dtype, "fortran_order": False, "shape": shape})
    return file


class stage:
    def __init__(self, name, stages):
        self.name, self.stages = name, stages

    def __enter__(self):
        self.start = time.monotonic()

    def __exit__(self, *_):
        self.stages[self.name] = time.monotonic() - self.start


class Peak:
    """The largest proportional memory of this process and its children, twenty times a second."""

    def __enter__(self):
        self.bytes = 0
        self.ended = threading.Event()
        self.thread = threading.Thread(target=self._watch, daemon=True)
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.ended.set()
        self.thread.join()

    def _watch(self):
        while not self.ended.wait(0.05):
            self.bytes = max(self.bytes, sum(map(memory_of, tree(os.getpid()))))


def tree(process):
    found = [process]
    for process in found:
        for task in Path(f"/proc/{process}/task").glob("*/children"):
            try:
                found += map(int, task.read_text().split())
            except OSError:
                pass
    return found


def memory_of(process):
    """Anonymous memory and the pages of files that are mapped, shared ones in proportion."""
    try:
        for line in Path(f"/proc/{process}/smaps_rollup").read_text().splitlines():
            if line.startswith("Pss:"):
                return 1024 * int(line.split()[1])
    except OSError:
        pass
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", choices=("verify", "grow"))
    parser.add_argument("subject", help="the mesh, or the number of vertices")
    parser.add_argument("--folder", help="for temporary files (default: that of the system)")
    parser.add_argument("--vertices-per-part", type=int, default=1_000_000)
    parser.add_argument("--memory", default="1GiB")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(dir=arguments.folder) as folder:
        if arguments.command == "verify":
            verify(arguments.subject, Path(folder))
        else:
            grow(int(arguments.subject), Path(folder), arguments.vertices_per_part, arguments.memory)


if __name__ == "__main__":
    main()
