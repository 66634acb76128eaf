# SPDX-License-Identifier: MIT
"""The interpreter ends while daemon threads are in a call: the process ends normally. (Before Python 3.14, a thread is
unwound when it takes the interpreter lock, which must not meet a noexcept function; and once the interpreter is freed, it
must not look for it.)"""

import os

import programs
import pytest
from scale import scaled

RUNS = scaled(100, least=4)

# Each releases the interpreter lock.
CALLS = {
    "batch": "index.neighborhoods(4.0)",
    "batch with progress": "index.neighborhoods(4.0, progress=lambda done, total: sum(range(1000)))",
    "batch along edges": "index.neighborhoods(2.0, metric='path')",
    "counts": "index.counts(4.0, workers=2)",
    "paper": "index.neighborhoods(2.0, range(50), method='paper')",
    "bfs": "index.neighborhoods(2.0, range(50), method='bfs')",
    "ball": "index.neighborhoods(2.0, range(50), method='ball')",
    "batch with masks": "index.neighborhoods(4.0, walls=walls, ignored=ignored)",
    "batch along edges with masks": "index.neighborhoods(2.0, metric='path', walls=walls, ignored=ignored)",
    "single query": "index.neighborhood(7, 2.0)",
    "single query with distances": "index.neighborhood(7, 2.0, return_distance=True)",
    "single bfs": "index.neighborhood(7, 2.0, method='bfs')",
    "count": "index.count(7, 2.0)",
    "chunks": "list(index.iter_neighborhoods(2.0, chunk=100))",
    "graph": "index.radius_neighbors_graph(1.0)",
    "region": "index.neighborhood([1.0, 2.0, 3.0], 4.0)",
    "region along edges": "index.neighborhood(7, 4.0, metric='path')",
    "stroke": "index.stroke(V[:20], 2.0)",
    "nested": "index.nested(7, [1.0, 2.0, 4.0])",
    "rings": "index.nested(7, range(6), metric='rings')",
    "contains": "index.contains(7, 9, 4.0)",
    "connecting radius": "index.connecting_radius(7, 900)",
    "nearest connected": "index.nearest_connected(7, 20)",
    "nearest": "index.nearest(V[:50])",
    "nearest unconnected": "index.nearest_unconnected(2.0)",
    "k nearest": "index.k_nearest(20, walls=walls)",
    "k nearest along edges": "index.k_nearest(20, metric='path')",
    "discs": "index.discs(9.0, range(50), ignored=ignored)",
    "closest points": "index.closest_point(V)",
    "first hits": "index.first_hit(V + 9, -V - 1)",
    "thickness": "index.thickness(method='sphere')",
    "clipped patch": "index.clip(7, 4.0)",
    "measured patch": "index.measure(7, 4.0)",
    "gap of a patch": "index.gap(7, 4.0)",
    "rim": "index.rim(index.neighborhood(7, 4.0), 7, 4.0)",
    "aggregate": "index.aggregate(values, scales=[2.0, 4.0], reduce='var', progress=lambda done, total: None)",
    "aggregate along edges": "index.aggregate(values, 2.0, metric='path', walls=walls)",
    "smooth": "index.smooth(values, 4.0)",
    "areas": "meshhood.vertex_areas(V, F)",
    "curvature": "index.curvature(scales=[2.0, 4.0], F=F)",
    "corrected curvature": "index.corrected_curvature(4.0, F=F)",
    "principal curvature of libigl": "meshhood.principal_curvature(V, F)",
    "moments": "index.moments(4.0, degree=4)",
    "principal components": "index.principal_components(4.0, weights='area', F=F)",
    "features": "index.features(scales=[2.0, 4.0], F=F, kinds=('crease', 'area'))",
    "persistence": "meshhood.persistence(values.T, range(1, 21), 0.1)",
    "build": "meshhood.MeshIndex(V, F)",
    "build without edges": "meshhood.MeshIndex(V, F, cut=F[:9, :2])",
    "build from points": "meshhood.MeshIndex.from_points(V, 1.0)",
    "build of faces": "meshhood.MeshIndex.of_faces(V, F)",
    "weld": "meshhood.weld(V, F, 0.1)",
    "refit": "index.refit(V)",
    "refit of some": "index.refit(V, [7, 8, 9])",
    "quality": "index.quality()",
    "hierarchy": "meshhood.MeshIndex(V, F).neighborhood(0, 1.0, method='paper')",
    "positions": "meshhood.MeshIndex(V, F).positions",
    "mean edge length": "meshhood.MeshIndex(V, F).mean_edge_length",
    "save": "index.save(folder / 'again.index')",
    "load": "meshhood.load(folder / 'plates.index')",
    "map": "meshhood.load(folder / 'plates.index', mmap=True)",
    "read_mesh": "meshhood.read_mesh(folder / 'mesh.off')",
    "write_mesh": "meshhood.write_mesh(folder / f'{threading.get_ident()}.ply', V, F)",
    "pickle": "pickle.loads(pickle.dumps(index))",
    "partition": "meshhood.partition(arrays, folder / str(threading.get_ident()), parts=2, halo=0.5, resume=False)",
    "open parts": "meshhood.open_parts(folder / 'parts')",
    "open a part": "open_part(folder / 'parts')",
}

# The processes that end are children of one that has imported everything.
PROGRAM = programs.SCENE.format(side=40) + """
import pickle, random
index.save(folder / "plates.index")
meshhood.partition(arrays, folder / "parts", parts=2, halo=0.5)
(folder / "mesh.off").write_text("OFF\\n2000 0 0\\n" + "0 1 2\\n" * 2000)
def open_part(path):
    meshhood._open_part._opened.cache_clear()
    meshhood.open_parts(path).open(1)
call = compile({call!r}, "call", "eval")
def run():
    while True:
        eval(call)
def in_child(end):
    child = os.fork()
    if child == 0:
        end()
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
eval(call)

def end():
    for _ in range(2):
        threading.Thread(target=run, daemon=True).start()
    time.sleep(random.choice((0, 0.001, 0.003, 0.01, 0.03)))
    sys.exit(0)
for number in range({runs}):
    random.seed(number)
    code = in_child(end)
    assert code == 0, f"run {{number}}: exit code {{code}}"

# The threads of low priority have the only processor once the main thread sleeps, which is after the interpreter was
# freed. So they take the lock then.
import ctypes
libc = ctypes.CDLL(None)
def run_idle():
    os.sched_setscheduler(threading.get_native_id(), os.SCHED_IDLE, os.sched_param(0))
    run()
def end_with_idle_threads():
    libc.on_exit(libc.sleep, None)  # sleep(exit code)
    os.sched_setaffinity(0, {{min(os.sched_getaffinity(0))}})
    for _ in range(4):
        threading.Thread(target=run_idle, daemon=True).start()
        time.sleep(0.01)
    sys.exit(1)
if hasattr(os, "SCHED_IDLE"):
    code = in_child(end_with_idle_threads)
    assert code == 1, f"with idle threads: exit code {{code}}"
else:
    print("skipped: the threads of low priority, which need the scheduler of Linux")
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")
@pytest.mark.parametrize("call", CALLS)
def test_the_process_ends_normally(call, tmp_path):
    done = programs.run(PROGRAM.format(call=CALLS[call], runs=RUNS), tmp_path)
    assert done.stderr == ""
    print(f"{RUNS} processes ended in the middle of: {call}", done.stdout)
