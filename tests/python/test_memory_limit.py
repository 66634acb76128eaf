# SPDX-License-Identifier: MIT
"""Memory runs out, in the calling thread or in a worker: each call succeeds or raises MemoryError (or an error of a
file or an argument that says so), and the process goes on. Each trial is a process of its own with a limit on its
address space."""

import inspect
import os
import re

import meshhood
import programs
import pytest
from scale import scaled

TRIALS = scaled(60, least=8)

CALLS = {
    "batch": "index.neighborhoods(2.0, workers=2)",
    "counts": "index.counts(3.0, workers=2)",
    "chunks": "list(index.iter_neighborhoods(1.0, chunk=5000, workers=2))",
    "paper": "index.neighborhoods(1.0, method='paper', workers=2)",
    "bfs": "index.counts(2.0, range(500), method='bfs', workers=2)",
    "along edges": "index.neighborhoods(1.0, metric='path', workers=2)",
    "with masks": "index.neighborhoods(2.0, walls=walls, ignored=ignored, workers=2)",
    "along edges with masks": "index.counts(1.0, metric='path', walls=walls, ignored=ignored, workers=2)",
    "nearest unconnected": "index.nearest_unconnected(2.0, walls=walls, workers=2)",
    "k nearest": "index.k_nearest(20, range(2000), ignored=ignored, workers=2)",
    "k nearest along edges": "index.k_nearest(20, range(2000), metric='path', workers=2)",
    "discs": "index.discs(9.0, range(2000), workers=2)",
    "closest points": "index.closest_point(V, F=F, workers=2)",
    "first hits": "index.first_hit(V + 9, -V - 1, F=F, workers=2)",
    "thickness": "index.thickness(method='sphere', F=F, workers=2)",
    "aggregate": "index.aggregate(values, 3.0, workers=2)",
    "aggregate along edges": "index.aggregate(values, 2.0, metric='path', walls=walls, workers=2)",
    "several radii": "index.aggregate(values, scales=[1.0, 2.0], nesting='patch', workers=2)",
    "maximum": "index.aggregate(values, 3.0, 'max', workers=2)",
    "variance": "index.aggregate(values, 3.0, 'var', workers=2)",
    "smooth": "index.smooth(values, 2.0, workers=2)",
    "curvature": "index.curvature(2.0, F=F, workers=2)",
    "corrected curvature": "index.corrected_curvature(2.0, F=F, workers=2)",
    "principal curvature": "meshhood.principal_curvature(V, F, workers=2)",
    "moments": "index.moments(2.0, degree=4, workers=2)",
    "principal components": "index.principal_components(2.0, workers=2)",
    "features": "index.features(scales=[1.0, 2.0], F=F, workers=2)",
    "build": "meshhood.MeshIndex(V, F, workers=2)",
    "points without faces": "meshhood.MeshIndex.from_points(V, 1.0, max_edges=10**6, workers=2)",
    "faces as vertices": "meshhood.MeshIndex.of_faces(V, F, workers=2)",
    "refit": "index.refit(V, workers=2)",
    "partition": "meshhood.partition(arrays, folder / str(os.getpid()), parts=2, halo=1.0, workers=2)",
    "along the surface": "index.counts(1.0, range(500), metric='surface', workers=2)",
    "in space": "index.neighborhoods(2.0, metric='space', workers=2)",
    "one query": "index.neighborhood(0, 120.0, return_distance=True)",
    "one count": "index.count(0, np.inf, walls=walls)",
    "one along the surface": "index.neighborhood(0, 40.0, metric='surface')",
    "nested": "index.nested(0, [10.0, 120.0])",
    "stroke": "index.stroke(V[:240], 20.0)",
    "contains": "index.contains(0, 14000, np.inf)",
    "connecting radius": "index.connecting_radius(0, 14000)",
    "nearest connected": "index.nearest_connected(0, 10000)",
    "nearest": "index.nearest(V + 0.1, workers=2)",
    "graph of neighbors": "index.radius_neighbors_graph(2.0, mode='distance', workers=2)",
    "smoothing matrix": "index.smoothing_matrix(2.0, weights='area', F=F, workers=2)",
    "invariants": "index.invariants(2.0, workers=2)",
    "gaps": "index.gaps(2.0, range(2000), workers=2)",
    "invariants of points": "index.invariants(2.0, points=V[F[:, 0]], face=range(len(F)), workers=2)",
    "patch": "index.patch(0, 40.0)",
    "clip": "index.clip(0, 40.0)",
    "measure": "index.measure(0, 40.0)",
    "gap": "index.gap(0, 40.0)",
    "submesh": "index.submesh(range(9000))",
    "rim": "index.rim(region, 0, 20.0)",
    "submesh of given faces": "index.submesh(range(9000), F=F)",
    "masked": "index.masked(walls=walls, ignored=ignored)",
    "quality": "index.quality()",
    "save": "index.save(folder / f'{os.getpid()}.mhi')",
    "load": "meshhood.load(folder / 'index.mhi')",
    "map": "meshhood.load(folder / 'index.mhi', mmap=True)",
    "read a mesh": "meshhood.read_mesh(folder / 'mesh.ply', workers=2)",
    "write a mesh": "meshhood.write_mesh(folder / f'{os.getpid()}.ply', V, F)",
    "weld": "meshhood.weld(V, F, eps=1e-3)",
    "areas": "meshhood.vertex_areas(V, F)",
    "padded": "meshhood.padded(np.arange(len(V) + 1) * 9, np.zeros(9 * len(V)))",
    "a page": "meshhood.view(V, F)",
}
# They make a few numbers, or nothing; or a library beside this one does the work: Matplotlib and Dask.
LIGHT = {"geometric_radii", "persistence", "show_config", "smoothing_radius", "open_parts", "plot_neighborhood"}

PROGRAM = programs.SCENE.format(side=120) + """
import errno, resource
import scipy.sparse  # loading a library needs memory, too
index.save(folder / "index.mhi")
meshhood.write_mesh(folder / "mesh.ply", V, F)
region = index.neighborhood(0, 20.0)
DONE, OUT_OF_MEMORY = 0, 3
call = compile({call!r}, "call", "eval")
def outcome(kilobytes):
    # Of the call, with so much memory left.
    used = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (used, -1))
    held = ()  # what was freed before, which would serve whatever the limit: a chain, as a list moves when it grows
    for size in (2**20, 2**16, 2**12):
        try:
            while True:
                held = bytearray(size), held
        except MemoryError:
            pass
    resource.setrlimit(resource.RLIMIT_AS, (used + 1024 * kilobytes, -1))
    try:
        eval(call)
        return DONE
    except MemoryError:
        return OUT_OF_MEMORY
    except SystemError as error:  # where NumPy has no memory left to say so
        if "numpy" in str(error) and "without setting an exception" in str(error):
            return OUT_OF_MEMORY
        raise
    except OSError as error:  # where a file is mapped
        if error.errno == errno.ENOMEM and error.filename:
            return OUT_OF_MEMORY
        raise
    except ValueError as error:
        if "memory" in str(error) or "bytes" in str(error):
            return OUT_OF_MEMORY
        raise
def outcome_in_thread(kilobytes):
    thread = threading.Thread(target=lambda: os._exit(outcome(kilobytes)))
    thread.start()
    thread.join()
    return 1
def in_child(work, kilobytes):
    child = os.fork()
    if child == 0:
        signal.alarm(60)
        os._exit(work(kilobytes))
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
codes = []
for trial in range({trials}):
    kilobytes = round(8 * (65536 / 8) ** (trial / {trials}))
    for work in (outcome, outcome_in_thread):
        codes.append(in_child(work, kilobytes))
        assert codes[-1] in (DONE, OUT_OF_MEMORY), f"{{work.__name__}} with {{kilobytes}} kB: exit code {{codes[-1]}}"
assert OUT_OF_MEMORY in codes
print(codes.count(DONE), "done,", codes.count(OUT_OF_MEMORY), "out of memory")
"""


# At the first exception of a thread, the library of C++ needs data of this thread. If Python has loaded it later, the C
# library allocates them then, and ends the process ("cannot allocate memory for thread-local data") if it cannot.
# One arena for all threads: others reserve addresses that would serve whatever the limit.
ENVIRONMENT = {"LD_PRELOAD": "libstdc++.so.6", "MALLOC_ARENA_MAX": "1", "OPENBLAS_NUM_THREADS": "1"}


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="needs Linux")
@pytest.mark.parametrize("call", CALLS)
def test_memory_runs_out(call, tmp_path):
    done = programs.run(PROGRAM.format(call=CALLS[call], trials=TRIALS), tmp_path, environment=ENVIRONMENT)
    print(f"{call}: {done.stdout.strip()}")


def test_every_call_runs_out_of_memory():
    called = {name for call in CALLS.values() for name in re.findall(r"\.(\w+)\(", call)} | LIGHT
    places = [getattr(meshhood, name) for name in meshhood.__all__]
    calls = {place.__name__ for place in places if inspect.isfunction(place)} | {"MeshIndex"}
    of_index = meshhood.MeshIndex
    calls |= {name for name in dir(of_index) if callable(getattr(of_index, name)) and not name.startswith("_")}
    assert calls <= called, f"no call of {', '.join(sorted(calls - called))}"
    metrics = {name for call in CALLS.values() for name in re.findall(r"metric='(\w+)'", call)}
    assert metrics >= {"path", "surface", "space"}
