# SPDX-License-Identifier: MIT
"""All vertices of a mesh in one call: the batch beside breadth-first search and beside one query after the other, with
one thread and two, with each instruction set, and from Python."""
import contextlib
import importlib.util
import os
import subprocess
import sys
import tempfile
from pathlib import Path

from . import meshes, places, programs, results, timing

MESHES = ("cat0", "cortex", "dragon", "head_skin", "mri_head")
RADII = (2, 3, 5, 10, 20, 65)
# The targets of the kernels, as the library names them, from fast to slow.
KERNELS = ("AVX3", "AVX2", "SSE4", "NEON", "SCALAR")
METHODS = ("bfs", "single_count", "single_ids", "count", "ids", "one_thread", "two_threads", "two_processes", "one_thread_work",
           "two_threads_work", *KERNELS, "kept", "python")
ROUNDS = 5
# C++ and Python get memory alike: from the heap, which keeps what is freed, in pages of 4 kB. Otherwise NumPy gets large
# pages, and which arrays are new to the process depends on their sizes.
EQUAL_MEMORY = {"MALLOC_MMAP_MAX_": "0", "MALLOC_TRIM_THRESHOLD_": str(1 << 40), "NUMPY_MADVISE_HUGEPAGE": "0"}


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
    """Rows kept in one array, by C++ and from Python in turn."""
    if importlib.util.find_spec("meshhood") is None:
        print("  not from Python, because the package is not installed")
        return
    commands = {"kept": [places.PROGRAMS / "kept_rows", file], "python": [sys.executable, "-m", "bench.kept_rows", file]}
    with contextlib.ExitStack() as stack:
        timers = {name: stack.enter_context(RowTimer(command)) for name, command in commands.items()}
        for row in found["rows"]:
            for timer in timers.values():
                timer.microseconds(row)  # the first call gets the memory
            row |= {name: [] for name in timers}
            for _ in range(ROUNDS):
                for name, timer in timers.items():
                    row[name].append(timer.microseconds(row))


class RowTimer:
    """A process that times calls: see bench/kept_rows.cpp. All run on one processor, for processors are not alike while
    other programs use them."""

    def __init__(self, command):
        self.command = list(map(str, command))

    def __enter__(self):
        self.process = subprocess.Popen(self.command, cwd=places.ROOT, env=os.environ | EQUAL_MEMORY, text=True,
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        os.sched_setaffinity(self.process.pid, {max(os.sched_getaffinity(0))})
        return self

    def __exit__(self, *error):
        self.process.communicate()

    def microseconds(self, row):
        print(row["first_vertex"], row["rows"], row["radius"], file=self.process.stdin, flush=True)
        answer = self.process.stdout.readline()
        if not answer:
            sys.exit(f"bench: {' '.join(self.command)} failed")
        return float(answer)
