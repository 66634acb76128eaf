# SPDX-License-Identifier: MIT
"""Compares the answer to a command line with what plain.py computes. Each function of CHECKS appends what is wrong and
returns the number of compared rows."""
import functools
import io
import json
import math
import re

import numpy as np

import plain

READING = ("--weld", "--precision")  # how a mesh is read
ROWS = 60  # of each answer, which are compared


def agree(found, expected):
    return np.allclose(found, expected, rtol=1e-9, atol=1e-11, equal_nan=True)


def expect(wrong, what, found, expected):
    same = agree(found, expected) if isinstance(expected, (float, np.ndarray)) else found == expected
    if not same:
        wrong.append(f"{what}: expected {str(expected)[:200]}, got {str(found)[:200]}")


class Question:
    """The options of a command line as numbers."""

    def __init__(self, run):
        asked, self.run, self.files = run.asked, run, run.files
        self.mesh = run.files.plain("--weld" in asked, "--cut" in asked)
        self.metric, self.method = asked.get("--metric", "straight"), asked.get("--method", "exact")
        self.walls, self.ignored = (name if f"--{name}" in asked else "" for name in ("walls", "ignored"))
        self.unit = float(self.mesh.mean_edge) if asked.get("--unit") == "edge" else 1
        if "--fwhm" in asked:
            self.unit *= math.sqrt(math.log(1000) / (4 * math.log(2)))  # of the width, where a Gaussian is 1/1000
        self.radii = [float(r) * self.unit for r in asked.get("--radius", "").split(",") if r]
        self.point = tuple(self.files.point.tolist()) if "--point" in asked else None
        self.seeds = None
        if self.point:
            squared = np.where(self.mesh.mask(self.walls), np.inf, self.mesh.squared(np.array(self.point)))
            self.seeds = (int(asked.get("--seed", np.argmin(squared))),)
        self.sort, self.json = asked.get("--sort", "id"), "--json" in asked

    @property
    def starts(self):
        """The query vertices that were typed; None for the point."""
        if self.point:
            return [None]
        return [int(self.mesh.kept[int(v)]) for v in self.run.value_of("--vertex").split(",")]

    @property
    def rows(self):
        """The query vertices of a command of rows, or the numbers of its points."""
        if "--points" in self.run.asked:
            return np.arange(len(self.files.points))
        return self.files.vertices if "--vertices" in self.run.asked else np.arange(self.files.count)

    def radii_of(self, row):
        """One for each scale."""
        return [self.files.radii[row] * self.unit] if "--radii" in self.run.asked else self.radii

    def neighborhood(self, v, r):
        metric = "space" if self.method == "ball" else self.metric
        return self.mesh.neighborhood(v, r, metric, self.walls, self.ignored, self.point, self.seeds)

    def in_order(self, found):
        """Sorted as --sort says."""
        if self.sort == "distance":
            return sorted(found, key=lambda v: (found[v], v))
        if self.sort == "index":
            places = places_in_index(self.files, self.run.file, words_of(self.run, READING))
            return sorted(found, key=places.__getitem__)
        return sorted(found)

    def compare(self, wrong, what, ids, v, found):
        """The ids of an answer with a neighborhood. The method of the paper may find more."""
        if self.method != "paper":
            expect(wrong, what, list(ids), self.in_order(found))
        elif not set(found) <= set(ids):
            wrong.append(f"{what}: lacks {sorted(set(found) - set(ids))}")


def words_of(run, names):
    """Those of the options that a command line has, as typed."""
    words = ()
    for name in set(names) & set(run.asked):
        words += (name,) if run.asked[name] in (None, True) else (name, str(run.value_of(name)))
    return words


@functools.lru_cache(maxsize=None)
def places_in_index(files, file, words):
    done = files.run(["batch", files.folder / file, *words, "-r", "0", "-o", "-"])
    vertices = np.load(io.BytesIO(done.stdout))["vertices"]
    return {int(v): place for place, v in enumerate(vertices)}


def sample(count):
    """Some rows, among them the first and the last, of an answer of at least one."""
    return sorted({0, min(1, count - 1), count - 1, *np.random.default_rng(count).integers(0, count, ROWS).tolist()})


def arrays_of(run, name="--output"):
    if name == "--output" and "--csv" in run.asked:
        return TABLES.get(run.command, table_of_rows)(run)
    return dict(np.load(io.BytesIO(run.output(name))))


# Tables of text, as the arrays that the same command writes. They have no radii but those of --radii.


def columns_of(run):
    """The numbers of each column by its name, in their order."""
    lines = run.output().decode().splitlines()
    names = lines[0].split(",")
    numbers = np.array([line.split(",") for line in lines[1:]], float).reshape(-1, len(names))
    return dict(zip(names, numbers.T))


def table_of_rows(run):
    columns = columns_of(run)
    if "--points" in run.asked:
        arrays = {"start_face": columns.pop("start_face"),
                  "start_point": np.stack([columns.pop(f"start_point_{axis}") for axis in "xyz"], axis=1)}
        rows = len(arrays["start_face"])
    else:
        arrays = {"vertices": columns.pop("vertex").astype(int)}
        rows = len(arrays["vertices"])
    if "--radii" in run.asked:
        arrays["radii"] = columns.pop("radius")[None]
    if run.command == "aggregate":
        names = reductions(run)
        shape = (-1, run.files.values.shape[1], len(names), rows)
        arrays["values"] = np.moveaxis(np.stack(list(columns.values())).reshape(shape), 3, 1)
        if len(names) == 1:
            arrays["values"] = arrays["values"][..., 0]
        return arrays
    if run.command == "features":
        kinds = run.asked.get("--kinds", "crease").split(",")
        of_kinds = [[columns.pop(f"{kind}_{name}") for kind in kinds] for name in ("scales", "strength", "radius")]
        arrays.update(zip(("scales", "strength", "radius"), (np.stack(one, axis=1) for one in of_kinds)))
        arrays["features"] = np.stack(list(columns.values())).reshape(len(kinds), -1, rows)
        arrays["features"] = np.moveaxis(arrays["features"], 0, 2)
        return arrays
    for name in dict.fromkeys(re.sub(r"_r?[^_]+(_[xyz012])?$", "", name) for name in columns):
        of_name = [column for key, column in columns.items() if re.fullmatch(rf"{name}_r?[^_]+", key)]
        if not of_name:
            of_name = [column for key, column in columns.items() if re.fullmatch(rf"{name}_r?[^_]+_[xyz012]", key)]
            of_name = np.stack(of_name).reshape(-1, 3, rows).swapaxes(1, 2)
        arrays[name] = np.stack(list(of_name))
    return arrays


def table_of_pairs(run):
    """Rows of ids: one after the other for each vertex, and none where it is empty."""
    if "--count" in run.asked:
        return table_of_rows(run)
    columns = columns_of(run)
    of, ids = columns["vertex"].astype(int), columns["neighbor"].astype(int)
    begins = np.flatnonzero(np.diff(of, prepend=-1))
    rows = {}
    for begin, end in zip(begins, [*begins[1:], len(of)]):
        rows.setdefault(of[begin], slice(begin, end))
    is_in_index_order = run.asked.get("--order") == "index"
    if is_in_index_order:
        vertices = list(places_in_index(run.files, run.file, words_of(run, READING)))
    elif "--vertices" in run.asked:
        vertices = run.files.plain("--weld" in run.asked).kept[run.files.vertices]
    else:
        vertices = range(run.files.count)
    found = [rows.get(v, slice(0, 0)) for v in vertices]
    arrays = {"indptr": np.cumsum([0, *(one.stop - one.start for one in found)]),
              "indices": np.concatenate([ids[one] for one in found])}
    arrays.update({"vertices": np.array(vertices)} if is_in_index_order else
                  {"shape": np.array([len(vertices), run.files.count])})
    name = "distances" if is_in_index_order else "data"
    if "--distances" in run.asked:
        arrays[name] = np.concatenate([columns["distance"][one] for one in found])
    return arrays


def table_of_points(run):
    columns = columns_of(run)
    arrays = {name: columns[name] for name in ("face", "distance")}
    return arrays | {"point": np.stack([columns[f"point_{axis}"] for axis in "xyz"], axis=1)}


TABLES = {"batch": table_of_pairs, "closest": table_of_points}


# Single queries.


def answers_of_query(question, text):
    """For each start: the counts, the vertices, their distances and their radii, as printed."""
    asked, starts, radii = question.run.asked, question.starts, question.radii
    if "--csv" in asked:
        yield from answers_of_table(question)
        return
    if question.json:
        for one in json.loads(text)["answers"]:
            counts = one["counts"]
            rings = np.searchsorted(counts, np.arange(counts[-1]), side="right")
            yield counts, one.get("vertices"), one.get("distances"), [radii[i] for i in rings]
        return
    lines = [line.split() for line in text.splitlines()]
    for start in starts:
        rows = [line[1:] for line in lines if int(line[0]) == start] if len(starts) > 1 else lines
        if "--count" in asked:
            yield [int(row[-1]) for row in rows], None, None, None
            continue
        distances = [float(row[1]) for row in rows] if "--distances" in asked else None
        ring = [float(row[-1]) for row in rows] if len(radii) > 1 else [radii[0]] * len(rows)
        counts = [sum(one <= r * (1 + 1e-9) for one in ring) for r in radii]
        yield counts, [int(row[0]) for row in rows], distances, ring


def answers_of_table(question):
    columns, radii = columns_of(question.run), question.radii
    for start in question.starts:
        mine = slice(None) if start is None else columns["vertex"] == start
        if "count" in columns:
            yield columns["count"][mine].astype(int).tolist(), None, None, None
            continue
        ids = columns["neighbor"][mine].astype(int).tolist()
        ring = columns["radius"][mine].tolist() if "radius" in columns else [radii[0]] * len(ids)
        distances = columns["distance"][mine] if "distance" in columns else None
        counts = [sum(one <= r * (1 + 1e-9) for one in ring) for r in radii]
        yield counts, ids, distances, ring


def query(run, wrong):
    question = Question(run)
    answers = list(answers_of_query(question, run.text()))
    expect(wrong, "answers", len(answers), len(question.starts))
    for start, (counts, vertices, distances, rings) in zip(question.starts, answers):
        nested = [question.neighborhood(start, r) for r in question.radii]
        if question.method != "paper":
            expect(wrong, f"counts of {start}", counts, [len(one) for one in nested])
        if vertices is None:
            continue
        expect(wrong, f"number of vertices of {start}", len(vertices), counts[-1])
        begin = 0
        for inner, found, r, end in zip([{}, *nested], nested, question.radii, counts):
            ring = {v: d for v, d in found.items() if v not in inner}
            question.compare(wrong, f"ring {r} of {start}", vertices[begin:end], start, ring)
            expect(wrong, f"radii of {start}", rings[begin:end], np.full(end - begin, r))
            begin = end
        if distances is not None:
            known = nested[-1]
            of = {v: known.get(v, math.dist(question.mesh.V[v], question.mesh.V[start or 0])) for v in vertices}
            expect(wrong, f"distances of {start}", distances, np.array([of[v] for v in vertices]))
    if "--output" in run.asked:
        painted, _, _ = read_ply(run, "--output")
        expect(wrong, "painted vertices", len(painted), question.files.count)
    return len(answers)


def read_ply(run, name):
    file = run.folder / "read.ply"
    file.write_bytes(run.output(name))
    return plain.read_ply(file)


def clip(run, wrong):
    """The patch has the vertices of the region, and others where sides dip into the ball."""
    question = Question(run)
    mesh, arrays, start, r = question.mesh, arrays_of(run, "--arrays"), question.starts[0], question.radii[0]
    vertices, weights = arrays["vertices"], arrays["weights"]
    written, _, corners = read_ply(run, "--output")
    written = np.stack([written[axis] for axis in "xyz"], axis=1)
    expect(wrong, "points", written, np.einsum("ij,ijk->ik", weights, mesh.V[vertices].astype(np.float64)))
    triangles = written[corners.reshape(-1, 3)]
    crossed = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    expect(wrong, "triangles", len(crossed), len(arrays["faces"]))
    if "--json" in run.asked:
        document, chords = json.loads(run.done.stdout), np.linalg.norm(crossed, axis=1).sum() / 2
        area, volume, gap = (document[name] for name in ("area", "volume", "gap"))
        expect(wrong, "area of chords", bool(0.9 * area < chords < area * (1 + 1e-12)), True)
        expect(wrong, "volume in the ball", volume is None or 0 <= volume <= 4 / 3 * math.pi * r**3 * (1 + 1e-12), True)
        expect(wrong, "gap in the ball", gap is None or 0 <= gap <= r, True)
    if start is None:
        return 1
    whole = (vertices == vertices[:, :1]).all(axis=1)
    distances = np.linalg.norm(written - mesh.V[start], axis=1)
    expect(wrong, "points on the sphere", distances[~whole], np.full((~whole).sum(), r))
    expect(wrong, "vertices in the ball", bool((distances[whole] <= r * (1 + 1e-12)).all()), True)
    if not question.walls:  # a face with a wall is not there, so that fewer vertices are connected
        found = set(mesh.corners.tolist()).intersection(question.neighborhood(start, r))
        expect(wrong, "missing vertices of the region", found - set(vertices[whole, 0].tolist()), set())
    return 1


def region(run, wrong):
    if run.asked.get("--faces") == "clip":
        return clip(run, wrong)
    question = Question(run)
    mesh, arrays = question.mesh, arrays_of(run, "--arrays")
    found = question.neighborhood(question.starts[0], question.radii[0])
    inside = np.isin(mesh.corners, list(found))
    of_face = np.add.reduceat(inside, mesh.offsets[:-1])
    faces = np.flatnonzero(of_face == np.diff(mesh.offsets) if run.asked.get("--faces") != "any" else of_face > 0)
    expect(wrong, "faces", arrays["faces"].tolist(), faces.tolist())
    corners = mesh.corners[np.isin(np.repeat(np.arange(len(of_face)), np.diff(mesh.offsets)), faces)]
    vertices = sorted(set(corners.tolist()))
    expect(wrong, "vertices", sorted(arrays["vertices"].tolist()), vertices)
    written, offsets, _ = read_ply(run, "--output")
    expect(wrong, "written", (len(written), len(offsets) - 1), (len(vertices), len(faces)))
    return 1


def connect(run, wrong):
    question = Question(run)
    nearest = run.asked.get("--nearest")
    start = (question.walls, question.ignored, question.point, question.seeds)
    if question.metric == "straight":
        radii = connecting_radii(question.mesh, question.starts[0], int(nearest) if nearest else None, *start)
    else:
        radii = question.mesh.neighborhood(question.starts[0], math.inf, question.metric, *start)
    targets = list(radii) if nearest else [int(question.mesh.kept[int(v)]) for v in run.value_of("--to").split(",")]
    if question.json:
        document = json.loads(run.text())
        found = list(zip(document["vertices"], (math.inf if r is None else r for r in document["radii"])))
    else:
        found = [(int(v), float(r)) for v, r in (line.split() for line in run.text().splitlines())]
    if nearest and question.metric != "straight":  # equal ones are in index order, which only the index knows
        targets = list(dict.fromkeys(v for v, _ in found))
        expect(wrong, "least radii", [r for _, r in found], np.sort(list(radii.values()))[: int(nearest)])
    expect(wrong, "vertices", [v for v, _ in found], targets)
    expect(wrong, "radii", [r for _, r in found], np.array([radii.get(v, math.inf) for v in targets]))
    return len(found)


@functools.lru_cache(maxsize=None)
def connecting_radii(mesh, v, most, walls, ignored, point, seeds):
    return mesh.connecting_radii(v, most, walls, ignored, point, seeds)


def closest(run, wrong):
    question = Question(run)
    points = np.array([question.point]) if question.point else question.files.points
    if {"--output", "--csv"} & set(run.asked):
        arrays = arrays_of(run)
        found = np.column_stack([arrays["face"], arrays["point"], arrays["distance"]])
    elif question.json:
        found = np.array([[one["face"], *one["point"], one["distance"]] for one in json.loads(run.text())])
    else:
        found = np.array([line.split() for line in run.text().splitlines()], float)
    expect(wrong, "points", len(found), len(points))
    some = sample(len(points))[:4]
    for i in some:
        expect(wrong, f"distance of point {i}", found[i, 4], distance_to_surface(question.mesh, tuple(points[i])))
        expect(wrong, f"point {i}", np.linalg.norm(found[i, 1:4] - points[i]), found[i, 4])
    return len(some)


@functools.lru_cache(maxsize=None)
def distance_to_surface(mesh, p):
    return mesh.distance_to_surface(np.array(p))


def compare(run, wrong):
    question = Question(run)
    v, r = question.starts[0], question.radii[0]
    text = run.text()
    rows = json.loads(text)["methods"] if question.json else [
        dict(zip(("method", "count", "extra", "missing"), line.split())) for line in text.splitlines()[2:]]
    counts = {row["method"]: int(row["count"]) for row in rows}
    exact = len(question.neighborhood(v, r))
    expect(wrong, "exact", (counts["exact"], counts["bfs"]), (exact, exact))
    kept = question.mesh.kept == np.arange(question.files.count)
    expect(wrong, "ball", counts["ball"], int(((question.mesh.squared(question.mesh.V[v]) <= r * r) & kept).sum()))
    return len(rows)


# Rows.


def check_limit(run, wrong):
    """With --max-bytes, the same bytes as without; and a refusal where it is too small."""
    if "--max-bytes" not in run.asked:
        return
    if run.output() != run.without.output():
        wrong.append("another answer with --max-bytes")
    arguments = run.arguments()
    arguments[arguments.index("--max-bytes") + 1] = str(run.enough // 2)
    expect(wrong, "exit code with half of the bytes", run.files.run(arguments, folder=run.folder).returncode, 6)


def batch(run, wrong):
    question = Question(run)
    check_limit(run, wrong)
    asked, arrays = run.asked, arrays_of(run)
    counts = "--count" in asked
    in_index_order = asked.get("--order") == "index" if counts else "shape" not in arrays
    rows = arrays["vertices"] if in_index_order else question.rows
    if in_index_order:
        expect(wrong, "vertices", sorted(rows.tolist()), np.unique(question.mesh.kept).tolist())
    if counts:
        expect(wrong, "shape", arrays["count"].shape, (len(question.radii_of(0)), len(rows)))
    else:
        expect(wrong, "rows", len(arrays["indptr"]), len(rows) + 1)
        if not in_index_order:
            expect(wrong, "shape", arrays["shape"].tolist(), [len(rows), question.files.count])
    for row in sample(len(rows)):
        v = int(question.mesh.kept[rows[row]])
        # In index order, the radii of a file are still those of the vertices.
        radii = question.radii_of(rows[row] if in_index_order else row)
        if counts:
            found = [len(question.neighborhood(v, r)) for r in radii]
            if question.method == "paper":
                found = np.maximum(found, arrays["count"][:, row]).tolist()
            expect(wrong, f"counts of row {row}, vertex {v}", arrays["count"][:, row].tolist(), found)
            continue
        ids = arrays["indices"][arrays["indptr"][row] : arrays["indptr"][row + 1]].tolist()
        found = question.neighborhood(v, radii[0])
        question.compare(wrong, f"row {row}, vertex {v}", ids, v, found)
        if "--distances" in asked:
            name = "distances" if in_index_order else "data"
            distances = arrays[name][arrays["indptr"][row] : arrays["indptr"][row + 1]]
            of = np.array([found.get(w, math.dist(question.mesh.V[w], question.mesh.V[v])) for w in ids])
            expect(wrong, f"distances of row {row}, vertex {v}", distances, of)
    return len(sample(len(rows)))


def check_radii(question, arrays, wrong):
    per_row = "--radii" in question.run.asked
    expected = question.files.radii[None, : len(question.rows)] * question.unit if per_row else np.array(question.radii)
    if "--csv" in question.run.asked and "--points" in question.run.asked:
        expect(wrong, "starts", len(arrays["start_point"]), len(question.rows))
    elif "--csv" in question.run.asked:
        rows = question.mesh.kept[question.rows] if "--vertices" in question.run.asked else question.rows
        expect(wrong, "vertices", arrays["vertices"].tolist(), rows.tolist())
    if "--csv" in question.run.asked and not per_row:
        return
    expect(wrong, "radii", arrays["radii"].shape, expected.shape)
    expect(wrong, "radii", arrays["radii"], expected)


def check_mesh_files(run, wrong, quality):
    """The values that a program shows: the property quality of PLY, an array of VTK."""
    quality = np.asarray(quality, np.float32)
    if "--ply" in run.asked:
        expect(wrong, "quality", read_ply(run, "--ply")[0]["quality"], quality)
    if "--vtk" in run.asked and quality.astype(">f4").tobytes() not in run.output("--vtk"):
        wrong.append("the file of --vtk lacks the values")


def reductions(run):
    return run.asked.get("--reduce", "mean").split(",")


def aggregate(run, wrong):
    question = Question(run)
    check_limit(run, wrong)
    asked, arrays, files = run.asked, arrays_of(run), question.files
    rows, values = question.rows, files.values
    names, results = reductions(run), arrays["values"]
    axis = (len(names),) if len(names) > 1 else ()
    expect(wrong, "shape", results.shape, (len(question.radii_of(0)), len(rows), values.shape[1], *axis))
    if axis:
        expect(wrong, "kinds", arrays.get("kinds", np.array(names)).tolist(), names)
    results = results.reshape(*results.shape[:3], len(names))
    check_radii(question, arrays, wrong)
    weights = None
    if "--weights" in asked:
        weights = files.weights if asked["--weights"] == "weights" else areas(question.mesh)
    kernel = "gaussian" if "--fwhm" in asked else asked.get("--kernel", "box")
    how = (kernel, weights, asked.get("--nan", "propagate"), float(asked.get("--quantile", 0.5)))
    for row in sample(len(rows)):
        v, radii = int(question.mesh.kept[rows[row]]), question.radii_of(row)
        for scale, r in enumerate(radii):
            found = question.neighborhood(v, max(radii) if asked.get("--nesting") == "patch" else r)
            found = {w: d for w, d in found.items() if d <= r}
            ids, distances = list(found), list(found.values())
            expected = [[plain.aggregate(ids, distances, x, name, *how, r) for name in names] for x in values.T]
            expect(wrong, f"row {row}, vertex {v}, radius {r}", results[scale, row], np.array(expected))
    check_mesh_files(run, wrong, results[-1, :, 0, 0])
    return len(sample(len(rows)))


@functools.lru_cache(maxsize=None)
def areas(mesh):
    return mesh.vertex_areas()


def unconnected(run, wrong):
    question = Question(run)
    arrays, rows = arrays_of(run), question.rows
    expect(wrong, "shape", arrays["distance"].shape, (len(question.radii_of(0)), len(rows)))
    check_radii(question, arrays, wrong)
    for row in sample(len(rows)):
        for scale, r in enumerate(question.radii_of(row)):
            other, distance = question.mesh.nearest_unconnected(int(rows[row]), r, question.walls, question.ignored, question.metric)
            expect(wrong, f"other of row {row}, vertex {rows[row]}", int(arrays["other"][scale, row]), other)
            expect(wrong, f"distance of row {row}", arrays["distance"][scale, row], distance)
    check_mesh_files(run, wrong, arrays["distance"][-1])
    return len(sample(len(rows)))


FITS = (*READING, "--metric", "--walls", "--ignored", "--unit", "--no-filter", "--like-libigl", "--kinds", "--threshold")


@functools.lru_cache(maxsize=None)
def fitted(files, command, file, options, radius, option, row):
    """The answer for one line of a list of vertices or points and one list of radii, from the mesh itself."""
    listed = files.folder / "one_row"
    listed.write_text(row, encoding="utf-8")
    alone = ["-r", radius, option, listed, "--threads", "1", "-o", "-"]
    done = files.run([command, files.folder / file, *options, *alone])
    return dict(np.load(io.BytesIO(done.stdout)))


def fits(run, wrong):
    """Curvatures, features, invariants and gaps of the surface, against the same for one row at a time."""
    question = Question(run)
    asked, arrays, rows = run.asked, arrays_of(run), question.rows
    options = words_of(run, FITS)
    radii = asked.get("--radius")
    if "--largest" in asked:
        largest, count = float(asked["--largest"]), int(asked.get("--count", 16))
        smallest = float(asked.get("--smallest", largest / count))
        radii = largest * np.arange(1, count + 1) / count
        if "--smallest" in asked:
            radii = smallest * (largest / smallest) ** (np.arange(count) / (count - 1))
        radii = radii * question.unit
        expect(wrong, "radii", arrays.setdefault("radii", radii), radii)
        if "--unit" in options:
            options = tuple(word for word in options if word not in ("--unit", "edge"))
        radii = ",".join(map(repr, arrays["radii"].tolist()))
    else:
        check_radii(question, arrays, wrong)
    is_rounded = {"--csv", "--largest"} <= set(asked)  # text does not have the radii that were computed
    some = sample(len(rows))[:: 60 if "--points" in asked else 20]
    for row in some:
        of_row = repr(question.files.radii[row].item()) if "--radii" in asked else radii
        listed = ("--vertices", f"{rows[row]}")
        if "--points" in asked:
            listed = ("--points", " ".join(map(repr, question.files.points[row].tolist())))
        one = fitted(question.files, run.command, run.file, options, of_row, *listed)
        for name in set(one) - {"radii", "vertices", "kinds"}:
            axis = 0 if name in ("scales", "strength", "radius", "start_face", "start_point") else 1
            found = np.take(arrays[name], [row], axis)
            same = agree(found, one[name]) if is_rounded else np.array_equal(found, one[name], equal_nan=True)
            if not same:
                what = f"{name} of row {row}, {' '.join(listed)}"
                wrong.append(f"{what}: expected {one[name].ravel()}, got {found.ravel()}")
    shown = {"features": lambda: arrays["features"][-1, :, 0], "invariants": lambda: arrays["volume"][-1],
             "gaps": lambda: arrays["distance"][-1], "curvature": lambda: (arrays["k1"][-1] + arrays["k2"][-1]) / 2}
    check_mesh_files(run, wrong, shown[run.command]())
    if run.command == "gaps":
        found = arrays["face"] >= 0
        corners = question.mesh.V[arrays["corners"][found].astype(int)].astype(np.float64)
        points = np.einsum("ij,ijk->ik", arrays["barycentric"][found], corners)
        expect(wrong, "points of gaps", points, arrays["point"][found])
    return len(some)


# Files.


@functools.lru_cache(maxsize=None)
def figures(mesh):
    _, faces_of_side = mesh.sides
    left, components = set(mesh.corners.tolist()), 0
    while left:
        left -= set(mesh.neighborhood(min(left), math.inf))
        components += 1
    welded = mesh.kept != np.arange(len(mesh.V))
    return {"faces": len(mesh.offsets) - 1, "components": components, "border_edges": int((faces_of_side == 1).sum()),
            "nonmanifold_edges": int((faces_of_side > 2).sum()), "welded_vertices": int(welded.sum()),
            "repeated_positions": len(mesh.V) - len(np.unique(mesh.V, axis=0))}


def info(run, wrong):
    question = Question(run)
    text = run.text()
    numbers = re.findall(r"^(\w+) +(\d+)$", text, re.MULTILINE)
    document = json.loads(text) if question.json else {key: int(number) for key, number in numbers}
    expect(wrong, "vertices", document["vertices"], question.files.count)
    expect(wrong, "edges", document["edges"], len(question.mesh.edges))
    if question.json:
        expect(wrong, "figures", {name: document[name] for name in figures(question.mesh)}, figures(question.mesh))
    if "--index" in run.asked and not ("paper" in document["index"] if question.json else "index of the paper" in text):
        wrong.append("no sizes of the indexes")
    return 1


def build(run, wrong):
    question = Question(run)
    (run.folder / "built.mhi").write_bytes(run.output())
    paper = run.asked.get("--index") == "paper"
    for v in (17, 20011):
        method = ["--method", "paper"] if paper else []
        done = question.files.run(["query", "built.mhi", "-v", str(v), "-r", "3.5", *method], folder=run.folder)
        found = set(map(int, done.stdout.split()))
        expected = set(question.mesh.neighborhood(int(question.mesh.kept[v]), 3.5))
        if found != expected and not (paper and expected <= found):
            wrong.append(f"of {v}: expected {sorted(expected)}, got {sorted(found)} {done.stderr.decode()}")
    if not paper:
        done = question.files.run(["region", "built.mhi", "-v", "17", "-r", "2", "-o", "x.ply"], folder=run.folder)
        expect(wrong, "faces", done.returncode == 0, "--faces" in run.asked)
    return 2


def verify(run, wrong):
    text = run.text()
    compared = json.loads(text)["mesh"] is not None if "--json" in run.asked else "the same as" in text
    expect(wrong, "compared", compared, "--mesh" in run.asked)
    return 1


def partition(run, wrong):
    question = Question(run)
    folder = run.folder / run.asked["--output"]
    parts = sorted(folder.glob("part-*"))
    if "--parts" in run.asked:
        expect(wrong, "parts", len(parts), int(run.asked["--parts"]))
    radius = float(run.asked["--halo"]) * question.unit
    for part in parts:
        numbers = np.load(part / "vertices.npy")
        v = int(np.median(np.load(part / "owned.npy"))) if (part / "owned.npy").exists() else 0
        done = question.files.run(["query", part / "index.mhi", "-v", str(v), "-r", repr(radius)])
        found = sorted(numbers[np.array(done.stdout.split(), int)].tolist())
        start = int(question.mesh.kept[numbers[v]])
        expect(wrong, f"{part.name}, vertex {numbers[v]}", found, sorted(question.mesh.neighborhood(start, radius)))
    return len(parts)


def generate(run, wrong):
    if "--list" in run.asked:
        names = [one["kind"] for one in json.loads(run.text())] if "--json" in run.asked else run.text().split()
        expect(wrong, "plates is listed", "plates" in names, True)
        return 1
    vertices, _, _ = read_ply(run, "--output")
    asked = int(run.asked.get("--vertices", 10000))
    if abs(len(vertices) - asked) > asked / 20:
        wrong.append(f"{len(vertices)} vertices, expected {asked}")
    return 1


def view(run, wrong):
    question = Question(run)
    page = run.output().decode()
    settings = json.loads(re.search(r'id="meshhood-settings">(.*)</script>', page)[1])
    asked = run.asked
    expect(wrong, "vertex", settings.get("vertex"), question.starts[0] if "--vertex" in asked else None)
    expect(wrong, "radius", settings.get("radius", math.nan), question.radii[0] if question.radii else math.nan)
    expect(wrong, "weld", settings.get("weld", math.nan), 0.0 if "--weld" in asked else math.nan)
    if "--ids" in asked:
        expect(wrong, "ids", settings["ids"], question.mesh.kept[question.files.vertices].tolist())
    expect(wrong, "values", "scalar" in settings, "--values" in asked)
    return 1


CHECKS = {"query": query, "region": region, "connect": connect, "closest": closest, "compare": compare, "batch": batch,
          "aggregate": aggregate, "unconnected": unconnected, "curvature": fits, "features": fits, "invariants": fits,
          "gaps": fits, "info": info,
          "build": build, "check": verify, "partition": partition, "generate": generate, "view": view}
