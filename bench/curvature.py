# SPDX-License-Identifier: MIT
"""Principal curvatures of all vertices in one call, beside libigl, the filter of MeshLab and CGAL's jets.

libigl and MeshLab have no list of vertices: where all would take too long, every tool gets the same piece of the mesh,
the vertices connected with one of them that are nearest to it. All run in this process, one after the other, in rounds;
CGAL, which has no search, in a program that takes its neighborhoods from our searcher."""
import statistics
import subprocess
import time

from . import memory, meshes, places, programs, results, timing

MESHES = ("cortex", "cat0", "dragon", "head_skin")
RADII = (3, 5, 10, 20, 65)
ROUNDS = 3
SIZES = (10_000, 100_000, 1_000_000, 10_000_000)
LIBIGL_SIZE = 1_000_000  # the largest of these on which libigl runs
GROWTH_RADIUS = 5
SECONDS = 12  # intended for libigl, for a mesh and radius
MOST_SECONDS = 40  # allowed for libigl
LIBIGL_COST = 0.27e-6  # approximate seconds for each vertex found
MESHLAB_COST = 0.5e-6
NORMAL_BYTES = 24  # of a vertex, in a surface


def run(names):
    watched = results.begin("curvature")
    measured = {}
    for name in names or MESHES:
        print(f"  {name}", flush=True)
        measured[name] = measure(name)
        results.save("curvature", {"meshes": measured}, watched)


def run_growth(largest):
    """Over the size of the mesh."""
    watched = results.begin("curvature_growth")
    rows = [grown(size) for size in SIZES if size <= largest]
    results.save("curvature_growth", {"radius_edges": GROWTH_RADIUS, "rows": rows}, watched)


def measure(name):
    import meshhood

    mesh = meshhood.read_mesh(meshes.as_file(name))
    index = meshhood.MeshIndex(mesh.vertices, mesh.faces)
    rows = []
    for radius in RADII:
        row = measure_radius(name, mesh, index, radius)
        if row is None:
            print(f"    {radius}: left out, libigl would take too long", flush=True)
            continue
        rows.append(row)
        print(f"    {radius}: {rows[-1]['libigl']['median']:.3g} / {rows[-1]['ours']['median']:.3g} µs", flush=True)
    return {"vertices": len(index), "rows": rows}


def measure_radius(name, mesh, index, edges):
    import meshhood
    import numpy as np

    sample = index.permutation[:: max(1, len(index) // 1000)]
    found = float(index.counts(edges, sample, unit="edge").mean())
    wanted = min(len(index), int(max(SECONDS / (LIBIGL_COST * found + 1e-5), 0.6 * found)))
    if wanted * min(wanted, found) * LIBIGL_COST > MOST_SECONDS:
        return None
    V, F = (np.asarray(mesh.vertices, float), np.asarray(mesh.faces, np.int64))
    if wanted < len(V):
        V, F = piece(index, V, F, wanted)
    part = meshhood.MeshIndex(V, F)
    tools = {"ours": ours(part, V, F, edges, {}), "default": ours(part, V, F, edges, {"like": None}),
             "jets": ours(part, V, F, edges, {"like": None, "fit": "jet", "filter": False}),
             "whole": lambda: meshhood.principal_curvature(V, F, edges, workers=1), **peers(V, F, part, edges, found)}
    times = in_turns(tools)
    threads = wall(ours(part, V, F, edges, {"workers": -1}))
    row = {"radius_edges": edges, "found": found, "rows": len(V), "threads": 1e6 * threads / len(V)}
    row |= {tool: timing.summary([1e6 * t / len(V) for t in spent]) for tool, spent in times.items()}
    cgal = cgal_jets(name, edges)
    return row | ({"cgal": cgal} if cgal else {})


def grown(size):
    """A sphere of `size` vertices: µs a vertex, and bytes a vertex of the index with the normals and of two calls."""
    import meshhood
    import numpy as np

    file = places.SCRATCH / f"sphere-{size}.ply"
    file.parent.mkdir(parents=True, exist_ok=True)
    if not file.exists():
        subprocess.run([places.MESHHOOD, "generate", "sphere", "--vertices", str(size), "-o", file], check=True,
                       stdout=subprocess.DEVNULL)
    V, F = (np.asarray(array) for array in meshhood.read_mesh(file))
    V, F = V.astype(float), F.astype(np.int64)
    index = meshhood.MeshIndex(V, F)
    tools = {"ours": ours(index, V, F, GROWTH_RADIUS, {})}
    radius, values = GROWTH_RADIUS * index.mean_edge_length, V[:, 0].copy()
    peaks = {"mean_peak": memory.peak_of(lambda: index.aggregate(values, radius, workers=1)),
             "curvature_peak": memory.peak_of(tools["ours"])}
    if size <= LIBIGL_SIZE:
        tools |= {"libigl": peers(V, F, index, GROWTH_RADIUS, 1e9)["libigl"]}
    times = {tool: statistics.median(spent) for tool, spent in in_turns(tools).items()}
    print(f"  sphere of {size:,}", flush=True)
    return {"vertices": len(V), "bytes": index.nbytes / len(V) + NORMAL_BYTES,
            **{call: peak / len(V) for call, peak in peaks.items()},
            **{tool: 1e6 * spent / len(V) for tool, spent in times.items()}}


def piece(index, V, F, count):
    """The `count` vertices nearest to the middle one in index order, and their faces."""
    import numpy as np

    ids = index.nearest_connected(int(index.permutation[len(index) // 2]), count)
    ids = np.sort(ids[0] if isinstance(ids, tuple) else ids)
    number = np.full(len(V), -1)
    number[ids] = np.arange(len(ids))
    inside = number[F]
    F = inside[(inside >= 0).all(axis=1)]
    used = np.unique(F)  # libigl ends the program if an isolated vertex has a larger id than those of all faces
    return V[ids[used]], np.searchsorted(used, F)


def ours(index, V, F, edges, options):
    """With the normals made beforehand, as libigl makes them in a small part of its time."""
    from meshhood import _core
    from meshhood._mesh import face_arrays

    radius = _core.libigl_radius((index.positions, *face_arrays(F)), edges=float(edges))
    settings = {"like": "libigl", "workers": 1, **options}
    return lambda: index.curvature(radius, F=F, **settings)


def peers(V, F, index, edges, found):
    tools = {}
    try:
        import igl

        tools["libigl"] = lambda: igl.principal_curvature(V, F, edges, False)
    except ImportError:
        raise SystemExit("bench: no libigl: bench/setup peers") from None
    try:
        import pymeshlab
    except ImportError:
        return tools
    if len(V) * (MESHLAB_COST * found + 2e-5) < SECONDS:
        meshset = pymeshlab.MeshSet()
        meshset.add_mesh(pymeshlab.Mesh(V, F))
        scale = pymeshlab.PureValue(edges * index.mean_edge_length)
        tools["meshlab"] = lambda: meshset.compute_curvature_principal_directions_per_vertex(
            method="Scale Dependent Quadric Fitting", scale=scale, autoclean=False)
    return tools


def in_turns(tools):
    """Processor seconds by tool. A slow tool runs once."""
    times = {tool: [] for tool in tools}
    for _ in range(ROUNDS):
        for tool, work in tools.items():
            if times[tool] and times[tool][0] > SECONDS / 3:
                continue
            start = time.process_time()
            work()
            times[tool].append(time.process_time() - start)
    return times


def wall(work):
    spent = []
    for _ in range(ROUNDS):
        start = time.perf_counter()
        work()
        spent.append(time.perf_counter() - start)
    return statistics.median(spent)


def cgal_jets(name, edges):
    """µs a row of CGAL's fit alone and of the search that it needs, or None."""
    program = places.PROGRAMS / "cgal_jets"
    if not program.is_file():
        return None
    return programs.run(program, meshes.argument(name), edges)
