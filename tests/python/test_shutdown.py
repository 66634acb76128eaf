# SPDX-License-Identifier: MIT
"""The interpreter ends while a daemon thread is in a call: the process ends normally. (Before Python 3.14, the thread is
unwound when it takes the interpreter lock, which must not meet a noexcept function.)"""

import os
import subprocess
import sys

import meshes
import pytest

RUNS = int(os.environ.get("MESHHOOD_SHUTDOWN_RUNS", "5"))

CALLS = {
    "batch": "index.query_ball(None, 4.0)",
    "batch with progress": "index.query_ball(None, 4.0, progress=lambda done, total: sum(range(1000)))",
    "counts": "index.query_ball_count(None, 4.0, workers=2)",
    "paper": "index.query_ball(range(50), 2.0, method='paper')",
    "bfs": "index.query_ball(range(50), 2.0, method='bfs')",
    "ball": "index.query_ball(range(50), 2.0, method='ball')",
    "single query": "index.query_ball(7, 2.0)",
    "single query with distances": "index.query_ball(7, 2.0, return_distance=True)",
    "single bfs": "index.query_ball(7, 2.0, method='bfs')",
    "count": "index.query_ball_count(7, 2.0)",
    "ranges": "index.query_ranges(7, 2.0)",
    "chunks": "list(index.iter_neighborhoods(None, 2.0, chunk=100))",
    "graph": "index.radius_neighbors_graph(1.0)",
    "build": "meshhood.MeshIndex(V, F)",
    "hierarchy": "meshhood.MeshIndex(V, F).query_ball(0, 1.0, method='paper')",
    "positions": "meshhood.MeshIndex(V, F).positions",
    "save": "index.save(folder / 'again.index')",
    "load": "meshhood.load(folder / 'plates.index')",
    "map": "meshhood.load(folder / 'plates.index', mmap=True)",
    "read_mesh": "meshhood.read_mesh(folder / 'mesh.off')",
    "pickle": "pickle.loads(pickle.dumps(index))",
}

PROGRAM = """
import pathlib, pickle, sys, threading, time
sys.path.insert(0, sys.argv[2])
import meshes, meshhood
folder = pathlib.Path(sys.argv[1])
V, F = meshes.two_plates(40)
index = meshhood.MeshIndex(V, F)
index.save(folder / "plates.index")
begun = threading.Event()
def run():
    {call}
    begun.set()
    while True:
        {call}
for _ in range(2):
    threading.Thread(target=run, daemon=True).start()
begun.wait()
time.sleep({wait})
"""


@pytest.mark.parametrize("call", CALLS)
def test_the_process_ends_normally(call, tmp_path):
    (tmp_path / "mesh.off").write_text("OFF\n2000 0 0\n" + "0 1 2\n" * 2000)
    tests = os.path.dirname(meshes.__file__)
    for run in range(RUNS):
        program = PROGRAM.format(call=CALLS[call], wait=0.001 * (run % 10))
        command = [sys.executable, "-c", program, str(tmp_path), tests]
        done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=120)
        assert (done.returncode, done.stderr) == (0, ""), f"run {run}"
    print(f"{RUNS} processes ended in the middle of: {call}")
