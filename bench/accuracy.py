# SPDX-License-Identifier: MIT
"""How far the paper's answer and the ball are from the exact one, and what `f` and the number of levels change."""
from . import meshes, programs, results

MESHES = ("cortex", "mri_head", "cat2", "scroll")
RADII = (2, 3, 5, 7, 10, 15, 20, 30, 40, 65, 90)
FACTORS = (1, 3, 10, 30)
LEVELS = (3, 4, 5, 6, 7)


def factor_method(factor):
    return f"paper,f={factor}"


def level_method(levels):
    """The lowest two levels dropped, as in the paper, so that `levels - 2` remain."""
    return f"paper,levels={levels}"


def run(names, queries):
    watched = results.begin("accuracy")
    methods = ["bfs", "ball", "ids", *map(factor_method, FACTORS),
               *(level_method(levels) for levels in LEVELS if levels != 5)]
    measured = {}
    for name in names:
        print(f"  {name}", flush=True)
        race = programs.race(meshes.argument(name), methods, radii=RADII, queries=queries)
        measured[name] = {**race, "mesh": meshes.described(name)}
    results.save("accuracy", {"queries": queries, "meshes": measured}, watched)
