# SPDX-License-Identifier: MIT
"""All vertices of a mesh in one call: the batch beside breadth-first search and beside one query after the other, with
one thread and two, with each instruction set, and from Python."""
import importlib.util
import tempfile
import time
from pathlib import Path

from . import meshes, places, programs, results, timing

MESHES = ("cat0", "cortex", "dragon", "head_skin", "mri_head")
RADII = (2, 3, 5, 10, 20, 65)
METHODS = ("bfs", "single_count", "single_ids", "count", "ids", "kept", "one_thread", "two_threads", "portable", "avx2",
           "avx512", "python")
ROUNDS = 5


def run(names):
    watched = results.begin("batches")
    measured = {}
    for name in names or MESHES:
        print(f"  {name}", flush=True)
        measured[name] = measure(name)
    results.save("batch", {"meshes": measured}, watched)


def measure(name):
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "mesh.index"
        found = programs.run(places.PROGRAMS / "all_vertices", "--json", "--index", file, meshes.argument(name), *RADII)
        add_python(file, found)
    rows = [row | {method: timing.summary(row[method]) for method in METHODS if method in row} for row in found["rows"]]
    return {"vertices": found["vertices"], "rows": rows}


def add_python(file, found):
    """The rows of `all_vertices` from Python, kept in arrays: to be compared with `kept`."""
    if importlib.util.find_spec("meshhood") is None:
        print("  not from Python, because the package is not installed")
        return
    import meshhood
    import numpy as np

    index = meshhood.load(file)
    for row in found["rows"]:
        vertices = np.arange(row["first_vertex"], row["first_vertex"] + row["rows"])
        row["python"] = [microseconds(index, vertices, row["radius"]) for _ in range(ROUNDS)]


def microseconds(index, vertices, radius):
    begin = time.thread_time()
    rows = index.query_ball(vertices, radius, workers=1)
    took = time.thread_time() - begin
    del rows
    return 1e6 * took / len(vertices)
