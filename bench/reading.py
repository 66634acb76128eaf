# SPDX-License-Identifier: MIT
"""Reading mesh files, beside other libraries: a million triangles in each format."""
import gc
import importlib
import statistics
import time

import numpy as np

from . import places, results, timing
from .peers.mesh_files import write_ply
from .worker import Worker

TRIANGLES = 1_000_000
FORMATS = ("obj", "ply, text", "ply, binary", "stl, binary", "stl, text")
THREADS = (1, 2)
ROUNDS = 7
ENOUGH_SECONDS = 1  # of one library and file; no further round is begun then
TIMEOUT = 60


def run(chosen):
    """chosen: numbers of threads; the others keep their results."""
    triangles, files = prepared()
    watched = results.begin("reading")
    measured = (results.load("reading") or {"files": {}})["files"]
    for threads in chosen or THREADS:
        workers = {name: Worker(Reader, name, processors=threads) for name in READERS}
        versions = {name: worker.result(TIMEOUT) for name, worker in workers.items()}
        for form, file in files.items():
            measured[f"{form}, {threads}"] = {"bytes": file.stat().st_size, "format": form, "threads": threads,
                                              "seconds": in_turns(workers, file, form)}
        for worker in workers.values():
            worker.end()
    results.save("reading", {"triangles": triangles, "versions": versions, "files": measured}, watched)


def in_turns(workers, file, form):
    """Of each library that reads the format. The first round warms the page cache."""
    times = {name: [] for name in workers if form.split(",")[0] in READERS[name][2]}
    for number in range(ROUNDS + 1):
        for name, spent in times.items():
            if sum(spent) < ENOUGH_SECONDS:
                seconds = workers[name].call("read", str(file), timeout=TIMEOUT)
                spent += [seconds] if number > 0 or seconds > ENOUGH_SECONDS / 2 else []
    print(f"  {form}: " + ", ".join(f"{name} {1e3 * statistics.median(spent):.1f} ms" for name, spent in times.items()),
          flush=True)
    return {name: timing.summary(spent) for name, spent in times.items()}


def prepared():
    """The number of triangles, and the files by format, from a wavy grid; made once."""
    places.SCRATCH.mkdir(parents=True, exist_ok=True)
    side = int((TRIANGLES / 2) ** 0.5) + 1
    row, column = np.mgrid[:side, :side].reshape(2, -1)
    V = np.column_stack([row, column, 5 * np.sin(row / 9) * np.cos(column / 7)]).astype(np.float32) * np.float32(0.1)
    corner = (row * side + column).reshape(side, side)
    a, b, c, d = corner[:-1, :-1].ravel(), corner[1:, :-1].ravel(), corner[1:, 1:].ravel(), corner[:-1, 1:].ravel()
    F = np.stack([a, b, c, a, c, d], axis=1).reshape(-1, 3).astype(np.int32)
    writers = {"obj": write_obj, "ply, text": write_ply_text, "ply, binary": write_ply, "stl, binary": write_stl,
               "stl, text": write_stl_text}
    files = {}
    for form in FORMATS:
        files[form] = places.SCRATCH / f"reading-{form.replace(', ', '-')}.{form.split(',')[0]}"
        if not files[form].exists():
            writers[form](files[form], V, F)
    return len(F), files


def write_obj(path, V, F):
    with open(path, "w", encoding="ascii") as file:
        np.savetxt(file, V, "v %.6g %.6g %.6g")
        np.savetxt(file, F + 1, "f %d %d %d")


def write_ply_text(path, V, F):
    with open(path, "w", encoding="ascii") as file:
        file.write(f"ply\nformat ascii 1.0\nelement vertex {len(V)}\nproperty float x\nproperty float y\n"
                   f"property float z\nelement face {len(F)}\nproperty list uchar int vertex_indices\nend_header\n")
        np.savetxt(file, V, "%.6g %.6g %.6g")
        np.savetxt(file, F, "3 %d %d %d")


def write_stl(path, V, F):
    rows = np.zeros(len(F), np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")]))
    rows["corners"] = V[F]
    with open(path, "wb") as file:
        file.write(b"binary".ljust(80) + np.uint32(len(F)).tobytes() + rows.tobytes())


def write_stl_text(path, V, F):
    with open(path, "w", encoding="ascii") as file:
        file.write("solid\n")
        np.savetxt(file, V[F].reshape(-1, 9), "facet normal 0 0 1\nouter loop\nvertex %.6g %.6g %.6g\n"
                   "vertex %.6g %.6g %.6g\nvertex %.6g %.6g %.6g\nendloop\nendfacet")
        file.write("endsolid\n")


class Reader:
    """A library in its process."""

    def __init__(self, name):
        package, module, _, self.function = READERS[name]
        importlib.import_module(module)
        self.started = importlib.import_module("importlib.metadata").version(package)

    def read(self, path):
        """Seconds."""
        begin = time.perf_counter()
        mesh = self.function(path)
        seconds = time.perf_counter() - begin
        del mesh
        gc.collect()
        return seconds

    def end(self):
        pass


def by_meshhood(path):
    import meshhood

    return meshhood.read_mesh(path)


def by_trueform(path):
    import trueform

    return trueform.read_stl(path) if path.endswith("stl") else trueform.read_obj(path, 3)


def by_trimesh(path):
    import trimesh

    mesh = trimesh.load(path, process=path.endswith("stl"))
    return mesh.vertices, mesh.faces


def by_meshio(path):
    import meshio

    return meshio.read(path)


def by_pyvista(path):
    import pyvista

    return pyvista.read(path)


def by_libigl(path):
    import igl

    return igl.read_triangle_mesh(path)


# Package, module, formats, how.
READERS = {
    "meshhood": ("meshhood", "meshhood", ("obj", "ply", "stl"), by_meshhood),
    "trueform": ("trueform", "trueform", ("obj", "stl"), by_trueform),
    "trimesh": ("trimesh", "trimesh", ("obj", "ply", "stl"), by_trimesh),
    "meshio": ("meshio", "meshio", ("obj", "ply", "stl"), by_meshio),
    "PyVista": ("pyvista", "pyvista", ("obj", "ply", "stl"), by_pyvista),
    "libigl": ("libigl", "igl", ("obj", "ply", "stl"), by_libigl),
}
