# SPDX-License-Identifier: MIT
"""Memory runs out, in the calling thread or in a worker: each call that takes workers succeeds or raises MemoryError (or
an error of a file or an argument that says so), and the process goes on. Each trial is a process of its own with a limit
on its address space."""

import os

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
}

PROGRAM = programs.SCENE.format(side=120) + """
import errno, resource
DONE, OUT_OF_MEMORY = 0, 3
call = compile({call!r}, "call", "eval")
def outcome(kilobytes):
    # Of the call, with so much memory left.
    used = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (used + 1024 * kilobytes, -1))
    try:
        eval(call)
        return DONE
    except MemoryError:
        return OUT_OF_MEMORY
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
print(codes.count(DONE), "done,", codes.count(OUT_OF_MEMORY), "out of memory")
"""


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="needs Linux")
@pytest.mark.parametrize("call", CALLS)
def test_memory_runs_out(call, tmp_path):
    done = programs.run(PROGRAM.format(call=CALLS[call], trials=TRIALS), tmp_path)
    print(f"{call}: {done.stdout.strip()}")
