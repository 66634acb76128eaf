# SPDX-License-Identifier: MIT
"""All vertices of a mesh in one call: the batch beside breadth-first search and beside one query after the other."""
from . import meshes, places, programs, results, timing

MESHES = ("cat0", "cortex", "dragon", "head_skin", "mri_head")
RADII = (2, 3, 5, 10, 20, 65)
METHODS = ("bfs", "single_count", "single_ids", "count", "ids")


def run(names):
    watched = results.begin("batches")
    measured = {}
    for name in names or MESHES:
        print(f"  {name}", flush=True)
        found = programs.run(places.PROGRAMS / "all_vertices", "--json", meshes.argument(name), *RADII)
        rows = [row | {method: timing.summary(row[method]) for method in METHODS} for row in found["rows"]]
        measured[name] = {"vertices": found["vertices"], "rows": rows}
    results.save("batch", {"meshes": measured}, watched)
