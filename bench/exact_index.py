# SPDX-License-Identifier: MIT
"""The exact index beside the best breadth-first search: on the mesh as it is and in index order, cold and warm."""
import subprocess

from . import meshes, places, programs, results
from .paper_tables import RADII

METHODS = ("bfs", "bfs-reordered", "ids", "count", "ranges")

# By formula, with sheets so close together that a ball contains several; with their numbers of vertices.
SHEETS = {"scroll": 1_000_000, "plates": 1_000_000, "folds": 1_000_000, "gyroid": 1_000_000}


RADII_BEFORE = (2, 3, 5, 10, 20, 40, 65, 90)


def compare(commit, names, queries):
    """The exact index of `commit` and this one, in turn in one process."""
    subprocess.run([places.ROOT / "bench/before/build", commit], check=True)
    data = results.load("exact_index")
    watched = results.begin("another commit")
    arguments = {name: meshes.argument(name) for name in names or [*meshes.OF_PAPER, "cortex"]}
    if not names:
        arguments |= {kind: f"{kind}:{vertices}" for kind, vertices in SHEETS.items()}
    measured = {}
    for name, mesh in arguments.items():
        print(f"  {name}", flush=True)
        race = programs.race(mesh, ("before", "ids", "before-count", "count"), radii=RADII_BEFORE, queries=queries)
        measured[name] = {"vertices": race["vertices"], "rows": race["rows"]}
    data["before"] = {"commit": commit, "queries": queries, "meshes": measured}
    results.save("exact_index", data, watched)


def run(names, queries):
    watched = results.begin("the exact index")
    arguments = {name: meshes.argument(name) for name in names or meshes.OF_PAPER}
    if not names:
        arguments |= {kind: f"{kind}:{vertices}" for kind, vertices in SHEETS.items()}
    measured = {}
    for name, mesh in arguments.items():
        print(f"  {name}", flush=True)
        orders = {order: programs.race(mesh, METHODS, radii=RADII, queries=queries, order=order)
                  for order in ("cold", "warm")}
        measured[name] = {"vertices": orders["cold"]["vertices"],
                          **{order: race["rows"] for order, race in orders.items()}}
    before = (results.load("exact_index") or {}).get("before")
    results.save("exact_index", {"queries": queries, "meshes": measured} | ({"before": before} if before else {}),
                 watched)
