# SPDX-License-Identifier: MIT
"""The exact index of another commit and this one, in turn in one process."""
import subprocess
from statistics import geometric_mean

from . import meshes, places, programs, results
from .paper_tables import RADII
from .sections.markdown import table

METHODS = ("before", "ids", "before-count", "count", "bfs", "bfs-reordered")


def run(commit, names, queries):
    """Measures all meshes, or `names` of them; those measured before stay if commit and number of queries are equal.
    Prints the time for ids over that of the other commit, by mesh and radius."""
    subprocess.run([places.ROOT / "bench/before/build", commit], check=True)
    watched = results.begin("another commit")
    arguments = {name: meshes.argument(name) for name in [*meshes.OF_PAPER, "cortex"]} | meshes.SHEETS | meshes.ODD
    kept = results.load("before") or {}
    measured = kept["meshes"] if names and (kept.get("commit"), kept.get("queries")) == (commit, queries) else {}
    for name, mesh in arguments.items():
        if names and name not in names:
            continue
        print(f"  {name}", flush=True)
        race = programs.race(mesh, METHODS, radii=RADII, queries=queries)
        measured[name] = {"vertices": race["vertices"], "rows": race["rows"]}
    in_order = {name: measured[name] for name in arguments if name in measured}
    results.save("before", {"commit": commit, "queries": queries, "meshes": in_order}, watched)
    print(table([f"time over that of {commit}", *(f"{radius:g}" for radius in RADII), "mean"],
                [ratios(name, programs.by_radius(result["rows"])) for name, result in in_order.items()]))


def ratios(name, times):
    cells = [times[radius]["ids"]["microseconds"] / times[radius]["before"]["microseconds"] for radius in sorted(times)]
    return [name, *(f"{value:.2f}" for value in cells), f"{geometric_mean(cells):.2f}"]
