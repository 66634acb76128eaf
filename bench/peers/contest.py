# SPDX-License-Identifier: MIT
"""All peers on the same queries: block by block in turn, so that what disturbs the machine disturbs all of them."""
from dataclasses import dataclass, field

import numpy as np

from .. import meshes, places, results, timing
from . import PEERS
from .worker import ALL_THREADS, ONE_THREAD, Worker

# mesh: radii in average edges.
CONTESTS = {"cortex": (5, 20), "dragon": (5, 10)}
BLOCKS = 5
BLOCK_QUERIES = 2000
JUDGED = 20
PATIENCE = 300  # seconds for one step of one peer
WHOLE_MESH_BLOCKS = 30  # for who answers for all vertices: as long as so many blocks take, and at least one run


@dataclass
class Contestant:
    name: str
    worker: Worker
    built: dict = None
    failure: str = None
    queries: int = 0  # a block, as many as there is time for
    runs: int = 0
    seconds: list = field(default_factory=list)
    row: dict = field(default_factory=dict)

    def forget(self):
        self.seconds, self.queries, self.runs, self.row = [], 0, 0, {}

    def attempt(self, *command):
        """As Worker.ask; a failure ends the part of this contestant, and is kept."""
        try:
            return self.worker.ask(*command, timeout=PATIENCE)
        except RuntimeError as error:
            self.failure = str(error)
            return None


def run(names, block_seconds):
    machine = results.begin("peers")
    contests = []
    for name in names or CONTESTS:
        for order in ("file", "shuffled"):
            mesh = prepared(name, order)
            for threads in (ONE_THREAD, ALL_THREADS):
                spoken = "one thread" if threads == ONE_THREAD else "all threads"
                print(f"  {name}, order: {order}, {spoken}", flush=True)
                contests += contest(name, order, mesh, threads, block_seconds)
    results.save("peers", {"blocks": BLOCKS, "block_seconds": block_seconds, "contests": contests}, machine)


def prepared(name, order):
    """The mesh as .npz and .ply, in the order of the file or with its vertices shuffled."""
    import meshhood

    places.SCRATCH.mkdir(parents=True, exist_ok=True)
    target = places.SCRATCH / f"{name}-{order}.npz"
    positions, triangles = meshhood.read_mesh(meshes.as_file(name))
    positions, triangles = positions.astype(np.float32), triangles.astype(np.int32)
    if order == "shuffled":
        new = np.random.default_rng(1).permutation(len(positions)).astype(np.int32)
        shuffled = np.empty_like(positions)
        shuffled[new] = positions
        positions, triangles = shuffled, new[triangles]
    np.savez(target, positions=positions, triangles=triangles)
    meshes.write_ply(target.with_suffix(".ply"), positions, triangles)
    return target


def contest(name, order, mesh, threads, block_seconds):
    """One result for each radius: the same workers answer for all of them."""
    with np.load(mesh) as arrays:
        positions, triangles = arrays["positions"], arrays["triangles"]
    exact = exact_index(positions, triangles)
    contestants = [started(peer, mesh, threads) for peer in PEERS]
    found = []
    for edges in CONTESTS.get(name, (5, 20)):
        radius = edges * mean_edge(positions, triangles)
        rows = at_radius(contestants, exact, radius, block_seconds)
        found.append({"mesh": meshes.described(name), "name": name, "order": order, "radius_edges": edges,
                      "vertices": len(positions), "threads": "one" if threads == ONE_THREAD else "all", "peers": rows})
    for contestant in contestants:
        contestant.worker.end()
    return found


def started(peer, mesh, threads):
    """One after the other, so that each builds alone."""
    contestant = Contestant(peer, Worker(peer, mesh, threads))
    try:
        contestant.built = contestant.worker.result(PATIENCE)
    except RuntimeError as error:
        contestant.failure = str(error)
    return contestant


def at_radius(contestants, exact, radius, block_seconds):
    random = np.random.default_rng(2)
    vertices = len(exact)
    judged = random.choice(vertices, min(JUDGED, vertices), replace=False).astype(np.int32)
    truth = [set(exact.query_ball(v, radius, method="bfs").tolist()) for v in judged]
    typical = np.mean([len(row) for row in truth])
    for contestant in contestants:
        contestant.forget()
    running = [contestant for contestant in contestants if contestant.built and not contestant.failure]
    for contestant in running:
        begin_radius(contestant, judged, truth, radius, vertices, block_seconds)
    for number in range(BLOCKS):
        block = random.integers(0, vertices, BLOCK_QUERIES).astype(np.int32)
        for contestant in running[number:] + running[:number]:
            if not contestant.failure and number < contestant.runs:
                run_block(contestant, block, radius)
    return [result(contestant, typical) for contestant in contestants]


def begin_radius(contestant, judged, truth, radius, vertices, block_seconds):
    """Judges the answers, and finds how many queries there is time for; both warm what must be warm."""
    peer = PEERS[contestant.name]
    ids = np.mean([len(row) for row in truth]) * vertices
    if peer.largest_answer and ids > peer.largest_answer:
        contestant.row = {"left_out": f"{ids:.1e} ids in all would be too many"}
        return
    judgement = contestant.attempt("judge", judged, radius)
    if judgement is None:
        return
    seconds, answers = judgement
    if peer.whole:
        contestant.queries = vertices
        contestant.runs = int(np.clip(WHOLE_MESH_BLOCKS * block_seconds / seconds, 1, BLOCKS)) - 1
        contestant.seconds.append(1e6 * seconds / vertices)  # too long for a run that does not count
    else:
        contestant.queries = int(np.clip(block_seconds * len(judged) / seconds, 1, BLOCK_QUERIES))
        contestant.runs = BLOCKS
    if answers is not None:
        contestant.row = difference(answers, truth)


def difference(answers, truth):
    """Vertices an answer, on average."""
    pairs = [(set(answer), right) for answer, right in zip(answers, truth)]
    return {"extra": float(np.mean([len(answer - right) for answer, right in pairs])),
            "missing": float(np.mean([len(right - answer) for answer, right in pairs]))}


def run_block(contestant, block, radius):
    seconds = contestant.attempt("time", block[:contestant.queries], radius)
    if seconds is not None:
        contestant.seconds.append(1e6 * seconds / contestant.queries)


def result(contestant, typical):
    peer = PEERS[contestant.name]
    row = {"name": contestant.name, "answers": peer.answers, "remark": peer.remark, "whole": peer.whole,
           "found": float(typical), **(contestant.built or {}), **contestant.row}
    if contestant.failure:
        row["failure"] = contestant.failure
    if contestant.seconds:
        row.update(microseconds=timing.summary(contestant.seconds), queries=contestant.queries)
    return row


def exact_index(positions, triangles):
    import meshhood

    return meshhood.MeshIndex(positions, triangles)


def mean_edge(positions, triangles):
    from .scipy_trees import edges_of

    edges = np.unique(np.sort(edges_of(triangles), axis=1), axis=0)
    return float(np.linalg.norm(positions[edges[:, 0]].astype(float) - positions[edges[:, 1]], axis=1).mean())
