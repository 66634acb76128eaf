# SPDX-License-Identifier: MIT
"""All vertices of a mesh in one call."""
from .markdown import number, table

SHOWN = ("head_skin", "dragon", "cortex", "mri_head")
SHOWN_RADII = (2, 5, 10, 20, 65)


def speed(data):
    """Times as fast as breadth-first search, for the README."""
    header = ["radius in mean edges"]
    for name in shown(data):
        header += [f"{name}: count", "ids"]
    by_radius = [{row["radius_edges"]: row for row in result["rows"]} for result in shown(data).values()]
    return table(header, [[f"{radius:g}", *(cell for rows in by_radius for cell in ratios(rows[radius]))]
                          for radius in by_radius[0] if radius in SHOWN_RADII])


def rows(data):
    header = ["mesh", "vertices", "radius", "found", "bfs", "count", "ids", "× count", "× ids", "two threads", "two processes",
              "work", "AVX2", "portable", "Python / C++"]
    return table(header, [[name, f"{result['vertices']:,}", f"{row['radius_edges']:g}", number(row["found"]),
                           *(number(row[method]["median"]) for method in ("bfs", "count", "ids")), *ratios(row), *others(row)]
                          for name, result in shown(data).items() for row in result["rows"]])


def shown(data):
    """The meshes of SHOWN, or all where there is none of them."""
    return {name: data["meshes"][name] for name in SHOWN if name in data["meshes"]} or data["meshes"]


def ratios(row):
    """How many times as fast as breadth-first search counts and ids are."""
    return [number(row["bfs"]["median"] / row[method]["median"]) for method in ("count", "ids")]


def others(row):
    """Threads, kernels and Python."""
    best = next(isa for isa in ("AVX3", "AVX2", "SSE4", "NEON", "SCALAR") if isa in row)
    return [ratio(row, "one_thread", "two_threads"), ratio(row, "one_thread", "two_processes", times=2),
            ratio(row, "two_threads_work", "one_thread_work"), ratio(row, best, "AVX2"), ratio(row, best, "SCALAR"),
            ratio(row, "python", "kept")]


def ratio(row, method, other, *, times=1):
    """How many times as long `method` takes as `other`, when called `times` times."""
    return f"{times * row[method]['median'] / row[other]['median']:.2f}" if method in row and other in row else "—"
