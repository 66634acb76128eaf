# SPDX-License-Identifier: MIT
"""The paper's evaluation: Table 1, Table 2, the phases of 4.3 and the times for all vertices of 4.2."""
import time

from . import meshes, places, programs, results, timing

RADII = (2, 3, 5, 10, 20, 40, 65, 90)
ACCOUNT_RADIUS = 65  # of 4.2
PROFILE_QUERIES = 2000

# Table 1 of the paper: vertices, mesh with topology, plain mesh, spatial index (MB), building time (s). Its megabytes
# are of 2^20 bytes: 12 bytes for each of 1,000,080 vertices and some 2,000,000 triangles make its 34.335 MB.
PAPER_TABLE1 = {
    "Cat": (27894, 1.703, 0.958, 0.526, 0.258),
    "Victoria": (45659, 2.787, 1.568, 0.866, 0.491),
    "Happy": (543652, 33.182, 18.665, 10.163, 6.652),
    "Raptor": (1000080, 61.040, 34.335, 18.824, 12.589),
}


def tables(names, queries):
    watched = results.begin("the paper's tables")
    measured = {}
    for name in names:
        print(f"  {name}", flush=True)
        mesh = meshes.as_file(name)
        raced = programs.race(mesh, ("bfs", "ball", "paper", "ids"), radii=RADII, queries=queries, builds=3)
        measured[name] = {
            "mesh": meshes.described(name),
            "table1": {key: raced[key] for key in ("vertices", "faces", "mesh_bytes", "topology_bytes")},
            "table2": [{**row, "method": "exact" if row["method"] == "ids" else row["method"]} for row in raced["rows"]],
            "builds": raced["builds"],
            "phases": programs.run(places.PROGRAMS / "phases", mesh, PROFILE_QUERIES, *RADII),
        }
    results.save("paper_tables", {"queries": queries, "meshes": measured}, watched)


def all_vertices(names):
    """Queries every vertex of the mesh in one call of the Python package, and counts the ids as they are streamed."""
    import meshhood

    watched = results.begin("the times for all vertices")
    measured = {}
    for name in names:
        print(f"  {name}", flush=True)
        mesh = meshhood.read_mesh(meshes.as_file(name))
        edge = programs.race(meshes.as_file(name))["mean_edge_length"]
        measured[name] = {str(workers): account(meshhood, mesh, ACCOUNT_RADIUS * edge, workers) for workers in (1, -1)}
        measured[name]["vertices"] = len(mesh.vertices)
    results.save("all_vertices", {"radius_edges": ACCOUNT_RADIUS, "meshes": measured}, watched)


def account(meshhood, mesh, radius, workers):
    begin = time.perf_counter()
    index = meshhood.MeshIndex(*mesh, workers=workers)
    built = time.perf_counter()
    listed = sum(len(chunk.indices) for chunk in index.iter_neighborhoods(radius, chunk=1024, workers=workers))
    listed_at = time.perf_counter()
    counted = int(index.counts(radius, workers=workers).sum())
    end = time.perf_counter()
    if listed != counted:
        raise SystemExit(f"bench: {listed} ids listed, but {counted} counted")
    return {"build_seconds": built - begin, "ids_seconds": listed_at - built, "count_seconds": end - listed_at,
            "found": listed}


def build_summary(table, name):
    """`name`: exact or paper."""
    build = next(build for build in table["builds"] if build["name"] == name)
    return {**timing.summary(build["seconds"]), "bytes": build["bytes"]}
