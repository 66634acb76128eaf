# SPDX-License-Identifier: MIT
"""The exact index beside the best breadth-first search: on the mesh as it is and in index order, cold and warm."""
from . import meshes, programs, results
from .paper_tables import RADII

METHODS = ("bfs", "bfs-reordered", "ids", "count", "ranges")

def run(names, queries):
    watched = results.begin("the exact index")
    arguments = {name: meshes.argument(name) for name in names or meshes.OF_PAPER}
    if not names:
        arguments |= meshes.SHEETS
    measured = {}
    for name, mesh in arguments.items():
        print(f"  {name}", flush=True)
        orders = {order: programs.race(mesh, METHODS, radii=RADII, queries=queries, order=order)
                  for order in ("cold", "warm")}
        measured[name] = {"vertices": orders["cold"]["vertices"],
                          **{order: race["rows"] for order, race in orders.items()}}
    results.save("exact_index", {"queries": queries, "meshes": measured}, watched)
