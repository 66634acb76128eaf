# SPDX-License-Identifier: MIT
"""Arguments that a callback, another thread or the caller of a generator changes during a call. The answer is that of
the arguments as they were when the call began; a thread that writes all the time may get any answer or an error, but
never ends the process. Each attack runs in a process of its own."""

import inspect

import meshes
import meshhood
import numpy as np
import programs
import pytest

METHODS = ("exact", "paper", "bfs", "ball")
TIMES = 20


def run(program):
    programs.run("import itertools\nindex = meshhood.MeshIndex(*meshes.two_plates(30))\n" + program)


# Arguments by the names of parameters, and values that would be refused or change the result. There are enough channels,
# radii and rows for several passes.
ARGUMENTS = """
V, quads = meshes.grid(50)
F = meshes.triangles(quads).astype(np.int64)
V[:, 2] = np.sin(V[:, 0] / 5)
index, count, draw = meshhood.MeshIndex(V, F), len(V), np.random.default_rng(1)
radii, points = draw.random(count) * 3, V + draw.normal(size=V.shape)
arguments = {
    "V": V, "P": V, "F": F, "cut": F[::9, :2].copy(), "values": draw.random((count, 40)), "weights": draw.random(count),
    "normals": draw.normal(size=(count, 3)), "vertices": draw.permutation(count), "r": radii, "fwhm": radii,
    "scales": np.array([2.0, 1.0, 3.0]), "changed": draw.permutation(count)[:700], "q": points, "origins": points,
    "directions": -points, "walls": draw.random(count) < 0.1, "ignored": draw.random(count) < 0.1,
}
hostile = {
    "V": np.nan, "P": np.nan, "F": 2**40, "cut": -1, "values": np.inf, "weights": -1.0, "normals": np.nan, "vertices": -1,
    "r": -1.0, "fwhm": -1.0, "scales": np.nan, "changed": 2**40, "q": np.nan, "origins": np.nan, "directions": np.nan,
    "walls": True, "ignored": True,
}
def call_of(name):
    return meshhood.MeshIndex if name == "MeshIndex" else getattr(index, name)
def numbers(result):
    if hasattr(result, "tocsr"):
        return result.indptr, result.indices, result.data
    if isinstance(result, meshhood.MeshIndex):
        return [result.positions, *result.neighborhoods(2.0)]
    return result if isinstance(result, tuple) else (result,)
"""
ARRAYS = (
    "V", "P", "F", "cut", "values", "weights", "normals", "vertices", "r", "fwhm", "scales", "changed", "q", "origins",
    "directions", "walls", "ignored",
)  # fmt: skip
MASKS = {"walls", "ignored"}

# What else a call needs, and other searches of a call.
NEEDED = {
    "k_nearest": {"k": 9}, "discs": {"area": 9.0}, "from_points": {"link": 1.5},
    "features": {"kinds": ("crease", "area", "variation")},
}  # fmt: skip
OTHERS = {
    "neighborhoods": ({"metric": "path"}, {"metric": "rings"}),
    "aggregate": ({"metric": "path"}, {"reduce": "var", "nesting": "patch"}, {"reduce": "max"}),
    "k_nearest": ({"metric": "path"},),
}


def calls():
    """Each call that takes a progress function: its name, those of its arrays, and other words. If it takes scales, once
    with a radius for each row, and once with scales, each of which is a search of its own, and masks."""
    methods = {name: getattr(meshhood.MeshIndex, name) for name in dir(meshhood.MeshIndex) if name[0] != "_"}
    for name, method in {"MeshIndex": meshhood.MeshIndex, **methods}.items():
        parameters = inspect.signature(method).parameters if callable(method) else {}
        arrays = {word for word in ARRAYS if word in parameters}
        if "progress" not in parameters or not arrays:
            continue
        if "weights" in arrays:
            arrays -= {"F", "q"}  # faces are for weights="area"; of `aggregate`, q is a number
        of_rows, of_scales = arrays - MASKS - {"scales"}, arrays - {"r", "fwhm"}
        if "normals" in arrays:  # instead of faces
            of_rows, of_scales = of_rows - {"normals"}, of_scales - {"F"}
        for words in ({}, *OTHERS.get(name, ())):
            for some in (of_rows, of_scales) if "scales" in arrays else (of_scales,):
                yield name, sorted(some), {**NEEDED.get(name, {}), **words}


CALLS = {f"{name}({', '.join([*arrays, *map(str, words.values())])})": (name, arrays, words) for name, arrays, words in calls()}


@pytest.mark.parametrize("case", CALLS)
def test_a_progress_function_may_write_to_each_argument_of_each_call(case):
    name, arrays, words = CALLS[case]
    run(ARGUMENTS + f"""
call = call_of({name!r})
def answer(progress=None, **changed):
    given = {{name: arguments[name].copy() for name in {arrays!r}}} | changed
    return numbers(call(**given, **{words!r}, progress=progress))
wanted = answer()
for name in {arrays!r}:
    written, reports = arguments[name].copy(), []
    def write(done, total):
        reports.append(done)
        written[:] = hostile[name]
    for got, want in zip(answer(write, **{{name: written}}), wanted):
        np.testing.assert_array_equal(got, want, err_msg=name)
    assert reports
""")


@pytest.mark.parametrize("case", CALLS)
def test_the_conversion_of_each_argument_may_write_to_the_others(case):
    """The result may be that of either values, or an error; the process goes on."""
    name, arrays, words = CALLS[case]
    run(ARGUMENTS + f"""
class Array:
    def __init__(self, values, others):
        self.values, self.others, self.dtype = values, others, values.dtype
    def __array__(self, dtype=None, copy=None):
        for name, other in self.others:
            other[:] = hostile[name]
        return self.values
    def __len__(self):
        return len(self.values)
for name in {arrays!r}:
    given = {{name: arguments[name].copy() for name in {arrays!r}}}
    given[name] = Array(given[name], [(other, array) for other, array in given.items() if other != name])
    try:
        call_of({name!r})(**given, **{words!r})
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
