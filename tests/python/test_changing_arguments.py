# SPDX-License-Identifier: MIT
"""Arguments that a callback, another thread or the caller of a generator changes during a call. The answer is that of
the arguments as they were when the call began; a thread that writes all the time may get any answer or an error, but
never ends the process. Each attack runs in a process of its own."""

import subprocess
import sys

import meshes
import meshhood
import numpy as np
import pytest

METHODS = ("exact", "paper", "bfs", "ball")
TIMES = 20

PREPARE = f"""
import itertools, sys, threading, warnings
sys.path.insert(0, {str(meshes.__file__.rsplit("/", 1)[0])!r})
import meshes, meshhood, numpy as np
index = meshhood.MeshIndex(*meshes.two_plates(30))
"""


def run(program):
    done = subprocess.run([sys.executable, "-c", PREPARE + program], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


# Arguments of each call that takes a progress function, and values that would be refused or change the result. There are
# enough channels, radii and rows for several passes.
ARGUMENTS = """
V, quads = meshes.grid(50)
F = meshes.triangles(quads).astype(np.int64)
V[:, 2] = np.sin(V[:, 0] / 5)
index, count, draw = meshhood.MeshIndex(V, F), len(V), np.random.default_rng(1)
arguments = {
    "V": V, "moved": V + draw.random(V.shape) / 9, "F": F, "cut": F[::9, :2].copy(),
    "values": draw.random((count, 40)), "weights": draw.random(count), "normals": draw.normal(size=(count, 3)),
    "vertices": draw.permutation(count), "r": np.array([2.0, 1.0, 3.0]), "radii": draw.random(count) * 3,
    "changed": draw.permutation(count)[:700], "points": V + draw.normal(size=V.shape),
    "walls": draw.random(count) < 0.1, "ignored": draw.random(count) < 0.1,
}
hostile = {
    "V": np.nan, "moved": np.nan, "F": 2**40, "cut": -1, "values": np.inf, "weights": -1.0, "normals": np.nan,
    "vertices": -1, "r": np.nan, "radii": -1.0, "changed": 2**40, "points": np.nan, "walls": True, "ignored": True,
}
def numbers(result):
    if hasattr(result, "tocsr"):
        return result.indptr, result.indices, result.data
    if isinstance(result, meshhood.MeshIndex):
        return [result.positions, *result.neighborhoods(2.0)]
    return result if isinstance(result, tuple) else (result,)
"""

# Several radii, each of which is a search of its own, with masks.
FILTERED = "scales=r, walls=walls, ignored=ignored, progress=p"
FILTER = {"r": "r", "walls": "walls", "ignored": "ignored"}

CALLS = {
    "neighborhoods": ("index.neighborhoods(r, v, progress=p)", {"v": "vertices", "r": "radii"}),
    "counts": ("index.counts(r, v, progress=p)", {"v": "vertices", "r": "radii"}),
    "along edges": ("index.neighborhoods(r, v, metric='path', progress=p)", {"v": "vertices", "r": "radii"}),
    "aggregate": (
        "index.aggregate(values, scales=r, weights=weights, vertices=v, progress=p)",
        {"values": "values", "r": "r", "weights": "weights", "v": "vertices"},
    ),
    "variance of patches": (
        "index.aggregate(values, scales=r, reduce='var', weights=weights, nesting='patch', progress=p)",
        {"values": "values", "r": "r", "weights": "weights"},
    ),
    "maximum": (
        "index.aggregate(values, scales=r, reduce='max', vertices=v, progress=p)",
        {"values": "values", "r": "r", "v": "vertices"},
    ),
    "smooth": ("index.smooth(values, 2.0, weights=weights, progress=p)", {"values": "values", "weights": "weights"}),
    "curvature": ("index.curvature(scales=r, vertices=v, F=F, progress=p)", {"r": "r", "v": "vertices", "F": "F"}),
    "curvature by normals": ("index.curvature(scales=r, normals=N, progress=p)", {"r": "r", "N": "normals"}),
    "corrected curvature": (
        "index.corrected_curvature(2.0, v, F=F, normals=N, progress=p)",
        {"v": "vertices", "F": "F", "N": "normals"},
    ),
    "moments": (
        "index.moments(r, v, weights=weights, progress=p)",
        {"r": "radii", "v": "vertices", "weights": "weights"},
    ),
    "principal components": (
        "index.principal_components(r, v, weights=weights, progress=p)",
        {"r": "radii", "v": "vertices", "weights": "weights"},
    ),
    "features": (
        "index.features(scales=r, vertices=v, F=F, kinds=('crease', 'area', 'variation'), progress=p)",
        {"r": "r", "v": "vertices", "F": "F"},
    ),
    "build": ("meshhood.MeshIndex(V, F, cut=cut, progress=p)", {"V": "V", "F": "F", "cut": "cut"}),
    "refit": ("index.refit(moved, progress=p)", {"moved": "moved"}),
    "refit of some": ("index.refit(moved, changed, progress=p)", {"moved": "moved", "changed": "changed"}),
    "neighborhoods with masks": (f"index.neighborhoods(vertices=v, {FILTERED})", {"v": "vertices", **FILTER}),
    "counts with masks": (f"index.counts(vertices=v, {FILTERED})", {"v": "vertices", **FILTER}),
    "along edges with masks": (f"index.neighborhoods(vertices=v, {FILTERED}, metric='path')", {"v": "vertices", **FILTER}),
    "rings with masks": (f"index.neighborhoods(vertices=v, {FILTERED}, metric='rings')", {"v": "vertices", **FILTER}),
    "graph with masks": (f"index.radius_neighbors_graph(vertices=v, {FILTERED})", {"v": "vertices", **FILTER}),
    "aggregate with masks": (f"index.aggregate(values, {FILTERED})", {"values": "values", **FILTER}),
    "aggregate along edges": (
        f"index.aggregate(values, metric='path', weights=weights, {FILTERED})",
        {"values": "values", "weights": "weights", **FILTER},
    ),
    "smoothing matrix": (
        "index.smoothing_matrix(2.0, weights=weights, vertices=v, walls=walls, progress=p)",
        {"weights": "weights", "v": "vertices", "walls": "walls"},
    ),
    "curvature with masks": (
        f"index.curvature(vertices=v, F=F, {FILTERED})",
        {"v": "vertices", "F": "F", **FILTER},
    ),
    "corrected curvature with masks": (
        f"index.corrected_curvature(F=F, normals=N, {FILTERED})",
        {"F": "F", "N": "normals", **FILTER},
    ),
    "moments with masks": (f"index.moments(weights=weights, {FILTERED})", {"weights": "weights", **FILTER}),
    "principal components with masks": (
        f"index.principal_components(weights=weights, {FILTERED})",
        {"weights": "weights", **FILTER},
    ),
    "features with masks": (f"index.features(F=F, kinds=('crease', 'area'), {FILTERED})", {"F": "F", **FILTER}),
    "nearest unconnected": (
        "index.nearest_unconnected(r, v, walls=walls, ignored=ignored, progress=p)",
        {"v": "vertices", "r": "radii", "walls": "walls", "ignored": "ignored"},
    ),
    "k nearest": (
        "index.k_nearest(9, v, walls=walls, ignored=ignored, progress=p)",
        {"v": "vertices", "walls": "walls", "ignored": "ignored"},
    ),
    "k nearest along edges": (
        "index.k_nearest(9, v, metric='path', walls=walls, ignored=ignored, progress=p)",
        {"v": "vertices", "walls": "walls", "ignored": "ignored"},
    ),
    "discs": (
        "index.discs(9.0, v, weights=weights, walls=walls, ignored=ignored, progress=p)",
        {"v": "vertices", "weights": "weights", "walls": "walls", "ignored": "ignored"},
    ),
    "closest points": ("index.closest_point(q, F=F, progress=p)", {"q": "points", "F": "F"}),
    "first hits": ("index.first_hit(q, -q, F=F, progress=p)", {"q": "points", "F": "F"}),
    "thickness": ("index.thickness(v, F=F, progress=p)", {"v": "vertices", "F": "F"}),
    "points without faces": ("meshhood.MeshIndex.from_points(V, 1.5, progress=p)", {"V": "V"}),
    "faces as vertices": ("meshhood.MeshIndex.of_faces(V, F, progress=p)", {"V": "V", "F": "F"}),
}


@pytest.mark.parametrize("name", CALLS)
def test_a_progress_function_may_write_to_each_argument_of_each_call(name):
    call, names = CALLS[name]
    run(ARGUMENTS + f"""
names = {names!r}
def answer(progress=None, **changed):
    given = {{name: arguments[kind].copy() for name, kind in names.items()}} | changed
    return numbers(eval({call!r}, globals(), given | {{"p": progress}}))
wanted = answer()
for name, kind in names.items():
    written, reports = arguments[kind].copy(), []
    def write(done, total):
        reports.append(done)
        written[:] = hostile[kind]
    for got, want in zip(answer(write, **{{name: written}}), wanted):
        np.testing.assert_array_equal(got, want, err_msg=name)
    assert reports
""")


@pytest.mark.parametrize("name", CALLS)
def test_the_conversion_of_each_argument_may_write_to_the_others(name):
    """The result may be that of either values, or an error; the process goes on."""
    call, names = CALLS[name]
    run(ARGUMENTS + f"""
names = {names!r}
class Array:
    def __init__(self, values, others):
        self.values, self.others, self.dtype = values, others, values.dtype
    def __array__(self, dtype=None, copy=None):
        for kind, other in self.others:
            other[:] = hostile[kind]
        return self.values
    def __len__(self):
        return len(self.values)
for name in names:
    given = {{name: arguments[kind].copy() for name, kind in names.items()}}
    others = [(names[other], given[other]) for other in names if other != name]
    given[name] = Array(given[name], others)
    try:
        eval({call!r}, globals(), given | {{"p": None}})
    except (ValueError, TypeError):
        pass
""")


@pytest.mark.parametrize("which", ("v", "r"))
def test_the_allocation_of_a_result_may_write_to_the_arguments(which):
    run(f"""
v, r = np.arange(len(index), dtype=np.int32), np.full(len(index), 3.0)
wanted = index.neighborhoods(r, v, return_distance=True)
empty, written = np.empty, []
def write(*arguments, **options):
    {which}[:] = -1
    written.append(1)
    return empty(*arguments, **options)
np.empty = write
got = index.neighborhoods(r, v, return_distance=True)
assert written
for one, other in zip(got, wanted):
    np.testing.assert_array_equal(one, other)
""")


WRITES = """
def write():
    for value in itertools.cycle(values):
        written[:] = value
threading.Thread(target=write, daemon=True).start()
for _ in range({times}):
    try:
        call()
    except (ValueError, TypeError):
        pass
"""


@pytest.mark.parametrize("method", METHODS)
def test_a_thread_may_write_to_the_vertices(method):
    run(f"""
written, values = np.arange(len(index), dtype=np.int32), (0, 2**31 - 1, -1)
call = lambda: index.neighborhoods(2.0, written, method={method!r})
""" + WRITES.format(times=TIMES))


@pytest.mark.parametrize("faces", ("triangles", "polygons", "padded", "graph"))
def test_a_thread_may_write_to_the_faces(faces):
    run(f"""
V, quads = meshes.grid(200)
quads = quads.astype(np.int32)
offsets = 4 * np.arange(len(quads) + 1)
padded = np.column_stack([np.full(len(quads), 4, np.int32), quads]).ravel()
from scipy.sparse import csr_array
graph = csr_array((np.ones(quads.size), (quads.ravel(), np.roll(quads, -1, axis=1).ravel())), shape=2 * (len(V),))
written, F = {{
    "triangles": (quads, quads),
    "polygons": (offsets, (offsets, quads.ravel())),
    "padded": (padded, padded),
    "graph": (graph.indptr, graph),
}}[{faces!r}]
values = (written.copy(), 2**30, -1)
call = lambda: meshhood.MeshIndex(V, F)
""" + WRITES.format(times=TIMES // 4))


SUMS = "V, quads = meshes.grid(60)\nindex, quads = meshhood.MeshIndex(V, quads), quads.astype(np.int32)\n"


def test_a_thread_may_write_to_the_faces_of_a_curvature():
    run(SUMS + """
written, values = quads, (quads.copy(), 2**30, -1)
call = lambda: index.curvature(3.0, F=quads)
""" + WRITES.format(times=TIMES))


@pytest.mark.parametrize("argument", ("values", "weights", "vertices", "r"))
def test_a_thread_may_write_to_the_arguments_of_an_aggregate(argument):
    run(SUMS + f"""
arguments = dict(values=np.ones(len(V)), weights=np.ones(len(V)), vertices=np.arange(len(V), dtype=np.int32), r=np.ones(3))
written, values = arguments[{argument!r}], (1, 2**30, -1)
call = lambda: index.aggregate(**arguments)
""" + WRITES.format(times=TIMES))


@pytest.mark.parametrize("made", ("MeshIndex(V, F)", "MeshIndex.from_points(V, 1.0)", "MeshIndex.of_faces(V, F)"))
def test_a_thread_may_write_to_the_positions(made):
    run(f"""
V, F = meshes.grid(200)
written, values = V, (0.0, np.nan, np.inf, -1e150, V.copy())
call = lambda: meshhood.{made}
""" + WRITES.format(times=TIMES // 4))


@pytest.mark.parametrize("part", (0, 1), ids=("index", "faces"))
def test_a_thread_may_write_to_a_pickle_that_is_loaded(part):
    run(f"part = {part}" + """
import pickle
buffers = []
pickled = pickle.dumps(index, protocol=5, buffer_callback=buffers.append)
sent = [bytearray(buffer.raw()) for buffer in buffers]
written = np.frombuffer(sent[part], np.uint8)
values = (written.copy(), 255, 0)
call = lambda: pickle.loads(pickled, buffers=sent).aggregate(np.ones(len(index)), 0.0, weights="area")
""" + WRITES.format(times=TIMES))


@pytest.mark.parametrize("method", METHODS)
def test_chunks_are_those_of_the_arguments_at_the_call(method):
    index = meshhood.MeshIndex(*meshes.two_plates(12))
    v, r = np.arange(100, dtype=np.int32), np.linspace(0, 3, 100)
    wanted = index.neighborhoods(r, v, method=method)
    rows = []
    parts = index.iter_neighborhoods(r, v, chunk=9, method=method)
    v[:50] = -1
    for part in parts:
        rows.append(part)
        v[:], r[:] = -7, np.nan
        part.vertices[:] = 0
    np.testing.assert_array_equal(np.concatenate([part.indices for part in rows]), wanted[1])


def test_chunks_are_those_of_the_masks_at_the_call():
    index = meshhood.MeshIndex(*meshes.two_plates(12))
    masks = {"walls": np.arange(len(index)) % 5 == 0, "ignored": np.arange(len(index)) % 3 == 0}
    wanted = index.neighborhoods(2.0, **masks)
    parts = index.iter_neighborhoods(2.0, chunk=9, **masks)
    for mask in masks.values():
        mask[:] = True
    np.testing.assert_array_equal(np.concatenate([part.indices for part in parts]), wanted[1])


def test_the_arguments_of_chunks_are_checked_at_the_call():
    index = meshhood.MeshIndex(*meshes.two_plates(5))
    for arguments, options, error in (
        ((1.0, [50]), {}, ValueError),
        ((-1.0, [0]), {}, ValueError),
        ((1.0, [0]), {"workers": 0}, ValueError),
        ((1.0, [0]), {"method": "fast"}, ValueError),
        ((1.0, [0]), {"unit": "mile"}, ValueError),
        ((1.0, [0]), {"order": "file"}, ValueError),
    ):
        with pytest.raises(error):
            index.iter_neighborhoods(*arguments, **options)
