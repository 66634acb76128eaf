# SPDX-License-Identifier: MIT
"""All libraries on the same queries, in alternating blocks, so that a disturbance of the machine affects all of
them."""
import numpy as np

from .. import meshes, results
from . import PEERS, mesh_files
from .contestant import BLOCK_QUERIES, BLOCKS, Contestant, Judged
from .edges import edges_of, lengths_of
from .service import ALL_THREADS, ONE_THREAD

# mesh: radii in average edges.
CONTESTS = {"cortex": (5, 20), "dragon": (5, 10)}
RUNS = tuple((order, threads) for order in ("file", "shuffled") for threads in (ONE_THREAD, ALL_THREADS))
JUDGED = 20


def run(names, block_seconds):
    watched = results.begin("peers")
    contests = []
    for name in names or CONTESTS:
        for order, threads in RUNS:
            thread_text = "one thread" if threads == ONE_THREAD else "all threads"
            print(f"  {name}, order: {order}, {thread_text}", flush=True)
            contests += contest(name, order, threads, block_seconds)
    results.save("peers", {"blocks": BLOCKS, "block_seconds": block_seconds, "contests": contests}, watched)


def contest(name, order, threads, block_seconds, peers=tuple(PEERS)):
    """One result for each radius, of the libraries `peers`. All radii use the same workers."""
    import meshhood

    path = mesh_files.prepared(name, order)
    mesh = mesh_files.load(path)
    exact = meshhood.MeshIndex(mesh.positions, mesh.triangles)
    mean_edge = lengths_of(mesh, edges_of(mesh)).mean()
    # One after the other, so that each builds alone.
    contestants = [Contestant.started(peer, path, threads) for peer in peers]
    found = []
    for edges in CONTESTS.get(name, (5, 20)):
        rows = at_radius(contestants, exact, float(edges * mean_edge), block_seconds)
        found.append({"mesh": meshes.described(name), "name": name, "order": order, "radius_edges": edges,
                      "vertices": len(exact), "threads": "one" if threads == ONE_THREAD else "all", "peers": rows})
    for contestant in contestants:
        contestant.worker.end()
        print(f"    {contestant.name}: {contestant.spent:.0f} s", flush=True)
    return found


def at_radius(contestants, exact, radius, block_seconds):
    random = np.random.default_rng(2)
    vertices = len(exact)
    judged = judgement(exact, random.choice(vertices, min(JUDGED, vertices), replace=False), radius)
    for contestant in contestants:
        contestant.begin_radius(judged, radius, vertices, block_seconds)
    for number in range(BLOCKS):
        block = random.integers(0, vertices, BLOCK_QUERIES).astype(np.int32)
        for contestant in contestants[number:] + contestants[:number]:
            contestant.run_block(number, block, radius)
    return [contestant.result(judged) for contestant in contestants]


def judgement(exact, vertices, radius):
    return Judged(vertices.astype(np.int32),
                  [set(exact.neighborhood(v, radius, method="bfs").tolist()) for v in vertices])
