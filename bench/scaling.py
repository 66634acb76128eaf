# SPDX-License-Identifier: MIT
"""Cost as mesh and radius grow: builds and queries from ten thousand to ten million vertices, and queries over the
radius."""
from . import programs, results, timing

SHAPES = ("sphere", "scroll", "noise")
SIZES = (10_000, 30_000, 100_000, 300_000, 1_000_000, 3_000_000, 10_000_000)
METHODS = ("bfs", "ids", "count", "ranges", "paper")
LARGE = 1000  # vertices of an answer
RADIUS = 20  # while the mesh grows
SIZE = 1_000_000  # while the radius grows
RADII = (2, 3, 5, 7, 10, 15, 20, 30, 40, 65, 90, 130, 200)


def run(largest, queries):
    watched = results.begin("cost as work grows")
    by_size, by_radius = {}, {}
    for shape in SHAPES:
        by_size[shape] = [over_size(shape, size, queries) for size in SIZES if size <= largest]
        size = min(SIZE, largest)
        print(f"  {shape} of {size:,} vertices over the radius", flush=True)
        by_radius[shape] = programs.race(f"{shape}:{size}", METHODS, radii=RADII, queries=queries)
    results.save("scaling", {"queries": queries, "radius_edges": RADIUS, "by_size": by_size, "by_radius": by_radius},
                 watched)


def over_size(shape, size, queries):
    print(f"  {shape} of {size:,} vertices", flush=True)
    # The paper's index builds in one thread, and would take most of the time at the end.
    builds = 5 if size <= 1_000_000 else 1
    return programs.race(f"{shape}:{size}", METHODS, radii=(RADIUS,), queries=queries, builds=builds)


def build_seconds(race, name):
    build = next(build for build in race["builds"] if build["name"] == name)
    return timing.summary(build["seconds"])["median"]


def microseconds(race, method, radius):
    return next(row["microseconds"] for row in race["rows"] if (row["method"], row["radius_edges"]) == (method, radius))


def cost_by_found(race, method):
    """Vertices of the exact answer, and microseconds, radius by radius."""
    rows = programs.by_radius(race["rows"]).values()
    return [row["bfs"]["count"] for row in rows], [row[method]["microseconds"] for row in rows]


def large(found, costs):
    """The answers to which the exponent is fitted: for smaller ones, the fixed cost of a query hides it."""
    pairs = [pair for pair in zip(found, costs) if pair[0] >= LARGE]
    return tuple(zip(*pairs)) if pairs else ((), ())
