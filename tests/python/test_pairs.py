# SPDX-License-Identifier: MIT
"""Every pair of options of every call. The options are those of the signatures: a new one needs a value here, or its call
fails by name. A pair that is allowed is asked for all vertices of a mesh, more than any sample, window or chunk has, and
compared for some of them with the same question asked plainly: one vertex at a time, one radius, one thread, no masks
but a mesh without the walls; and, where `tests/cli/plain.py` can answer it, without the library. A pair that is refused names both
options."""

import inspect
import itertools
import re
import sys
from pathlib import Path

import meshes
import meshhood
import numpy as np
import pytest
from scale import scaled

sys.path.append(str(Path(__file__).parents[1] / "cli"))
import plain  # noqa: E402: beside the pairs of the command line

RANDOM = np.random.default_rng(11)
V, F = meshes.folded(100)
V = (V + RANDOM.uniform(-0.05, 0.05, V.shape)).astype(np.float32)  # no two distances are equal
COUNT = len(V)
INDEX = meshhood.MeshIndex(V, F)
PLACE = np.argsort(INDEX.permutation)
AREAS = meshhood.vertex_areas(V, F)
VALUES = RANDOM.normal(size=(COUNT, 2))
VALUES[RANDOM.random(COUNT) < 0.002, 1] = np.nan
NORMALS = RANDOM.normal(size=(COUNT, 3)) + [0, 0, 3]
WALLS, IGNORED = RANDOM.random(COUNT) < 0.1, RANDOM.random(COUNT) < 0.1
ROWS = RANDOM.integers(COUNT, size=20_000)
MASK = np.isin(np.arange(COUNT), ROWS)
R = 2.3
SCALES = [1.4, 2.3]


def index_without(walls):
    sides = np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]])
    return meshhood.MeshIndex(V, F, cut=sides[walls[sides].any(axis=1)])


WITHOUT_WALLS = index_without(WALLS)
MASKS = {"walls": np.flatnonzero(WALLS), "ignored": np.flatnonzero(IGNORED)}
PLAIN = plain.Plain(V, 3 * np.arange(len(F) + 1), F.ravel(), MASKS)


def masks_of(words):
    """By their names in `PLAIN`."""
    return {name: name if name in words else "" for name in MASKS}


def arrays_of(found):
    """Ascending ids, and their distances."""
    ids = np.array(sorted(found), np.int64)
    return ids, np.array([found[v] for v in ids.tolist()], np.float64)


def distances_from(center):
    return np.sqrt(PLAIN.squared(np.asarray(center, np.float64)))


class Watch:
    """Progress that must begin with 0, ascend, and end with the total."""

    def __init__(self):
        self.last, self.total = -1, None

    def __call__(self, done, total):
        assert self.last <= done <= total and self.total in (None, total)
        assert done == 0 or self.last >= 0
        self.last, self.total = done, total


def radii_of(words):
    """One for each row, from 1.2 up to R."""
    rows = words.get("vertices")
    count = COUNT if rows is None else int(np.sum(rows)) if rows is MASK else np.size(rows)
    return R if np.ndim(rows) == 0 and rows is not None else 1.2 + (R - 1.2) * np.arange(count) % 1.0


# The values of each option besides its default. A function is called with the other words.
OPTIONS = {
    "vertices": {"list": ROWS, "mask": MASK, "one": 4711},
    "r": {"each": radii_of},
    "fwhm": {"each": radii_of},
    "scales": {"two": SCALES},
    "walls": {"mask": WALLS},
    "ignored": {"mask": IGNORED},
    "metric": {"path": "path", "surface": "surface", "rings": "rings", "space": "space"},
    "unit": {"edge": "edge"},
    "workers": {"3": 3},
    "progress": {"function": lambda words: Watch()},
    "dtype": {"single": np.float32},
    "max_bytes": {"enough": 2**33},
    "method": {"bfs": "bfs", "ball": "ball", "paper": "paper", "Paper": meshhood.Paper(radius_ratio=20)},
    "sort": {"index": "index", "id": "id", "distance": "distance"},
    "return_distance": {"yes": True},
    "mode": {"distance": "distance"},
    "chunk": {"odd": 4999},
    "order": {"index": "index"},
    "reduce": {name: name for name in ("sum", "min", "max", "var", "std", "count", "median", "quantile")},
    "kernel": {name: name for name in ("box", "epanechnikov", "biweight", "gaussian")},
    "nan": {"omit": "omit"},
    "nesting": {"patch": "patch"},
    "ddof": {"1": 1},
    "q": {"0.9": 0.9},
    "weights": {"area": "area", "numbers": AREAS + 0.25},
    "F": {"faces": F},
    "like": {"libigl": "libigl"},
    "fit": {"jet": "jet"},
    "filter": {"no": False},
    "normals": {"given": NORMALS},
    "degree": {"4": 4},
    "kinds": {"three": ("mean", "variation", "height"), "names": "k1"},
    "k": {"9": 9},
    "area": {"9": 9.0},
    "fill": {"-2": -2},
}
# What else an option needs to have an effect.
WITH = {
    "ddof": {"reduce": "var"},
    "q": {"reduce": "quantile"},
    "nesting": {"scales": SCALES},
    "F": {"weights": "area"},
    "kernel": {},
    "weights": {},
}
# Options that decide how an answer is found or given, not what it is.
HOW = ("workers", "progress", "max_bytes", "chunk", "order", "F")


class Call:
    """A call on many vertices. `rows(answer, words)` gives the columns of each row of an answer, all scales."""

    def __init__(self, name, rows, radius="r", **given):
        self.name, self.rows, self.radius, self.given = name, rows, radius, given

    def parameters(self):
        method = getattr(meshhood.MeshIndex, self.name)
        parameters = inspect.signature(method).parameters.items()
        one_choice = 'Literal["straight"]'
        no_options = ("self", "values", "points", "face")  # points in place of vertices: see test_patches.py
        return [name for name, it in parameters if name not in no_options and it.annotation != one_choice]

    def words(self, *options):
        words = dict(itertools.chain.from_iterable(WITH.get(name, {}).items() for name, _ in options))
        words = {name: value for name, value in words.items() if name in self.parameters()}
        words |= dict(options)
        if not ({self.radius, "scales"} & set(words)) and not words.get("scales"):
            words[self.radius] = R
        words = {**{"k_nearest": {"k": 7}, "discs": {"area": 8.0}}.get(self.name, {}), **words}
        if words.get("metric") == "rings" and not callable(words.get(self.radius)) and self.radius in words:
            words[self.radius] = 3
        return {name: value(words) if callable(value) and name != "dtype" else value for name, value in words.items()}

    def ask(self, index, words):
        answer = getattr(index, self.name)(*self.given.values(), **words)
        return list(answer) if self.name == "iter_neighborhoods" else answer


def lists(answer, words):
    if isinstance(answer, list):  # chunks
        parts = [lists((part.indptr, part.indices, *([] if part.distances is None else [part.distances])), {})
                 for part in answer]  # fmt: skip
        return list(itertools.chain.from_iterable(parts))
    indptr, *columns = answer
    return [tuple(column[a:b] for column in columns) for a, b in zip(indptr[:-1], indptr[1:])]


def matrix(answer, words):
    return lists((answer.indptr, answer.indices, answer.data), {})


def columns(answer, words):
    arrays = answer if isinstance(answer, tuple) else (answer,)
    axes = ("scales" in words) + (np.ndim(words.get("vertices", ROWS)) > 0 or words.get("vertices") is None)
    return list(zip(*(np.reshape(array, (-1, *np.shape(array)[axes:])) for array in arrays)))


CALLS = [
    Call("neighborhoods", lists),
    Call("iter_neighborhoods", lists),
    Call("radius_neighbors_graph", matrix),
    Call("counts", columns),
    Call("aggregate", columns, values=VALUES),
    Call("smooth", columns, "fwhm", values=VALUES),
    Call("smoothing_matrix", matrix, "fwhm"),
    Call("curvature", columns),
    Call("corrected_curvature", columns),
    Call("moments", columns),
    Call("principal_components", columns),
    Call("features", columns),
    Call("k_nearest", columns),
    Call("discs", lists),
    Call("nearest_unconnected", columns),
    Call("invariants", columns),
    Call("gaps", columns),
]


def questions(call, words):
    """The vertex and the radius of each row, in the unit of the mesh."""
    rows = words.get("vertices")
    ids = np.arange(COUNT) if rows is None else np.flatnonzero(rows) if rows is MASK else np.atleast_1d(rows)
    radii = [words[call.radius]] if "scales" not in words else words["scales"]
    unit = INDEX.mean_edge_length if "unit" in words else 1.0
    for radius in radii:
        yield from zip(ids, np.broadcast_to(unit * np.asarray(radius, float), len(ids)))


def in_query_order(call, words):
    """For each row of the answer, its number in the query."""
    count = COUNT if words.get("vertices") is None else None
    asked = list(questions(call, words))
    if words.get("order") != "index":
        return asked
    size = count or len(asked) // len(words.get("scales", [0]))
    scales = [asked[i : i + size] for i in range(0, len(asked), size)]
    return [row for scale in scales for row in sorted(scale, key=lambda row: PLACE[row[0]])]


def asked_plainly(call, words, v, radius):
    plain = {name: value for name, value in words.items() if name not in HOW}
    for name in ("vertices", "scales", "unit", "dtype", "walls", "nesting", call.radius):
        plain.pop(name, None)
    plain |= {call.radius: radius, "vertices": [int(v)], "workers": 1}
    index = WITHOUT_WALLS if "walls" in words else INDEX
    has_other_edges = "like" in words or (call.name == "features" and words.get("metric") == "rings")
    if call.name in ("invariants", "gaps") and "walls" in words:  # whose faces have numbers; see test_patches.py
        index, plain["walls"] = INDEX, WALLS
    has_other_edges |= call.name in ("k_nearest", "discs") and "metric" in words  # of equal lengths, by their places
    if has_other_edges and "walls" in words:  # whose values depend on the order or the mean length of all edges
        index, plain["walls"] = INDEX, WALLS
    is_in_space = words.get("metric") == "space" or words.get("method") == "ball"
    if (call.name == "nearest_unconnected" or is_in_space) and "walls" in words:  # a vertex without edges is found, too
        plain["ignored"] = WALLS | words.get("ignored", False)
    return call.rows(call.ask(index, plain), plain)[0]


def check_plain(call, words, v, radius, found):
    wanted = asked_plainly(call, words, v, radius)
    assert len(found) == len(wanted)
    if "walls" in words and call.rows in (lists, matrix) and words.get("sort") in (None, "index"):
        found, wanted = ([column[np.argsort(row[0])] for column in row] for row in (found, wanted))  # other places
    for a, b in zip(found, wanted):
        b = np.asarray(b, words.get("dtype") if np.asarray(b).dtype == np.float64 else None)
        if "walls" in words or (call.radius == "fwhm" and "unit" in words):  # sums in another order, radii rounded twice
            np.testing.assert_allclose(a, b, rtol=1e-5 if "dtype" in words else 1e-8, atol=1e-8)
        else:
            np.testing.assert_array_equal(a, b)


PLAIN_METRICS = ("straight", "path", "surface", "rings", "space")


def near(words, v, radius):
    """By `PLAIN`, the ids and the distances of a row; none where only the library knows the answer."""
    how = words.get("method", words.get("metric", "straight"))
    how = {"exact": "straight", "bfs": "straight", "ball": "space"}.get(how, how)
    if how not in PLAIN_METRICS:
        return None
    return arrays_of(PLAIN.neighborhood(int(v), float(radius), how, **masks_of(words)))


def weights_of(words):
    given = words.get("weights")
    return np.ones(COUNT) if given is None else AREAS if isinstance(given, str) else given


def reduced(words, ids, distances, radius):
    how = words.get("kernel") or "box", weights_of(words), words.get("nan"), words.get("q", 0.5), radius, words.get("ddof", 0)
    return np.array([plain.aggregate(ids, distances, x, words.get("reduce", "mean"), *how) for x in VALUES.T])


def by_hand(call, words, v, radius):
    """The columns of a row without the library, or as many of the first as are known; none if there are none."""
    if call.name == "nearest_unconnected":
        return PLAIN.nearest_unconnected(int(v), float(radius), **masks_of(words), metric=words.get("metric", "straight"))
    if call.name in ("k_nearest", "discs"):
        return nearest_by_hand(words, v, radius)
    largest = max(words["scales"]) * (radius / radius) if words.get("nesting") == "patch" else radius
    if words.get("nesting") == "patch" and "unit" in words:
        largest *= INDEX.mean_edge_length
    found = near(words, v, largest)
    if found is None:
        return ()
    ids, distances = (column[found[1] <= radius] for column in found)
    if call.name in ("neighborhoods", "iter_neighborhoods"):
        keys = {"index": PLACE[ids], "distance": distances}.get(words.get("sort"), ids)
        order = np.lexsort([ids, keys])
        return (ids[order], distances[order]) if words.get("return_distance") else (ids[order],)
    if call.name == "radius_neighbors_graph":
        return ids, distances if words.get("mode") == "distance" else np.ones(len(ids))
    if call.name == "counts":
        return (len(ids),)
    if call.name == "aggregate":
        return (reduced(words, ids, distances, radius),)
    if call.name in ("smooth", "smoothing_matrix"):
        radius = meshhood.smoothing_radius(radius)
        ids, distances = near(words, v, radius)
        if call.name == "smooth":
            return (reduced({**words, "kernel": "gaussian"}, ids, distances, radius),)
        if not len(ids):
            return [v], [np.nan]
        w = weights_of(words)[ids] * plain.fall("gaussian", distances, radius)
        return ids, w / w.sum()
    w, offsets = weights_of(words)[ids], V[ids].astype(float) - V[v]
    if call.name == "moments":
        return (np.concatenate([[w.sum()], w @ offsets]),)
    if call.name == "principal_components":
        with np.errstate(invalid="ignore"):
            return w.sum(), w @ offsets / w.sum() if len(ids) else np.full(3, np.nan)
    return ()


def nearest_by_hand(words, v, radius):
    straight = words.get("metric", "straight") == "straight"
    by_radius = PLAIN.connecting_radii(int(v), None, **masks_of(words), r=radius) if straight else None
    ids, keys = arrays_of(by_radius) if straight else near(words, v, radius)
    order = np.lexsort([ids, distances_from(V[v])[ids], keys] if straight else [PLACE[ids], keys])
    if "area" in words:
        needed = 1 + np.searchsorted(np.cumsum(weights_of({"weights": "area", **words})[ids[order]]), words["area"])
        return ids[order[:needed]], keys[order[:needed]]
    k, missing = words["k"], max(0, words["k"] - len(ids))
    fill = np.full(missing, words.get("fill", -1))
    return np.append(ids[order[:k]], fill), np.append(keys[order[:k]], np.full(missing, np.inf))


def check_by_hand(call, words, v, radius, found):
    wanted = by_hand(call, words, v, radius)
    if call.name in ("neighborhoods", "iter_neighborhoods") and wanted and "sort" not in words:
        found = [column[np.argsort(found[0])] for column in found]
    for a, b in zip(found, wanted):
        a = a[: np.size(b)] if call.name == "moments" else a
        np.testing.assert_allclose(a, b, rtol=1e-5 if "dtype" in words else 1e-8, atol=1e-5 if "dtype" in words else 1e-8)
    if words.get("method") in ("paper", OPTIONS["method"]["Paper"]) and call.rows in (lists, matrix):
        exact, ball = (near({"metric": metric}, v, radius)[0] for metric in ("straight", "space"))
        assert np.isin(exact, found[0]).all() and np.isin(found[0], ball).all()
    return bool(wanted)


def is_empty(call, row):
    """Whether a row is that of a wall."""
    if call.name == "smoothing_matrix":
        return len(row[0]) == 1 and np.isnan(row[1]).all()
    if call.rows in (lists, matrix):
        return all(len(column) == 0 for column in row)
    return all(np.all(np.isnan(a) | np.isin(a, (0, -1, -2, 2, np.inf))) for a in map(np.asarray, row))


def check(call, words, answer, random, rows):
    """Returns how many rows were found without the library."""
    found, asked = call.rows(answer, words), in_query_order(call, words)
    assert len(found) == len(asked)
    by_hand = 0
    for k in random.integers(len(asked), size=rows):
        v, radius = asked[k]
        if "walls" in words and WALLS[v]:
            assert is_empty(call, found[k]), (v, found[k])
            continue
        if words.get("nesting") != "patch" or radius == max(words["scales"]):  # a smaller one has what is in the patch
            check_plain(call, words, v, radius, found[k])
        by_hand += check_by_hand(call, words, v, radius, found[k])
    # One vertex and one radius have no progress.
    if "progress" in words and (len(found) > 1 or words["progress"].total):
        assert words["progress"].last == words["progress"].total
    return by_hand


def check_pairs(name, options, ask, check, companions=None):
    """Asks for every pair of options, given as name and value. `ask` returns words and answer, `check` how many answers
    were found without the library. A refusal of a value alone names its option, one of a pair both, or what an option is
    given with (`companions`)."""

    def names_option(text, option):
        return any(re.search(rf"\b{word}\b", text) for word in (option, *(companions or {}).get(option, ())))

    alone, refused, by_hand, wrong = set(), 0, 0, []
    values = [(option, label) for option in options for label in options[option]]
    pairs = [(a, b) for a, b in itertools.combinations(values, 2) if a[0] != b[0]]
    pairs = [pairs[i] for i in np.random.default_rng(1).permutation(len(pairs))[: scaled(len(pairs), 20)]]
    for chosen in [*((value,) for value in values), *pairs]:
        if set(chosen) & alone:
            continue
        try:
            try:
                words, answer = ask(*((option, options[option][label]) for option, label in chosen))
            except (ValueError, TypeError) as error:
                assert all(names_option(str(error), option) for option, _ in chosen), error
                alone |= set(chosen) if len(chosen) == 1 else set()
                refused += len(chosen) == 2
            else:
                by_hand += check(words, answer)
        except Exception as error:  # noqa: BLE001: a list of all pairs that are wrong says more than the first
            wrong.append(f"{name}({', '.join(map('='.join, chosen))}): {type(error).__name__}: {error}"[:600])
    print(f"{name}: {len(pairs)} pairs, {refused} refused, {len(alone)} values refused alone, {by_hand} by hand")
    assert not wrong, f"{len(wrong)} wrong\n" + "\n".join(wrong)


def options_of(name, parameters, table):
    missing = [option for option in parameters if option not in table]
    assert not missing, f"{name}: no values for {', '.join(missing)}: this test needs them"
    return {option: table[option] for option in parameters}


@pytest.mark.parametrize("call", CALLS, ids=lambda call: call.name)
def test_pairs_of_options_for_all_vertices(call):
    random = np.random.default_rng(1)

    def ask(*options):
        words = call.words(*options)
        return words, call.ask(INDEX, words)

    options = options_of(call.name, call.parameters(), OPTIONS)
    check_pairs(call.name, options, ask, lambda words, answer: check(call, words, answer, random, 4), WITH)


@pytest.mark.parametrize("call", CALLS, ids=lambda call: call.name)
def test_a_wrong_value_is_refused_by_name(call):
    """Also for one vertex, and whatever else is given."""
    flags = ("return_distance", "filter")  # anything is true or false
    lists = ("neighborhoods", "iter_neighborhoods", "radius_neighbors_graph", "smooth", "smoothing_matrix")
    one = [4711] if call.name in lists else 4711
    for option, vertex in itertools.product(call.parameters(), (None, one)):
        if option in flags or (option in WITH and option != "kernel"):
            continue
        words = call.words(("vertices", vertex), (option, object()))
        with pytest.raises((ValueError, TypeError), match=rf"\b{option}\b"):
            next(iter(call.ask(INDEX, words)), None)


@pytest.mark.parametrize("call", [call for call in CALLS if "progress" in call.parameters()], ids=lambda call: call.name)
def test_an_exception_of_progress_ends_the_call(call):
    def enough(done, total):
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        call.ask(INDEX, {**call.words(), "progress": enough})


@pytest.mark.parametrize("call", [call for call in CALLS if "max_bytes" in call.parameters()], ids=lambda call: call.name)
def test_the_limit_of_bytes_holds_with_every_option(call):
    for option in call.parameters():
        if option in ("max_bytes", "vertices"):
            continue
        for value in OPTIONS[option].values():
            words = call.words((option, value), ("max_bytes", 1000))
            with pytest.raises((MemoryError, ValueError, TypeError)) as refused:
                next(iter(call.ask(INDEX, words)))
            assert "max_bytes" in str(refused.value) or option in str(refused.value)


# Of one start: a vertex, or a point near one.
POINTS = V[RANDOM.integers(COUNT, size=12)] + np.float32(0.03)
STARTS = {"vertex": [int(v) for v in RANDOM.integers(COUNT, size=12)], "point": [point.astype(float) for point in POINTS]}
OPTIONS_OF_START = {
    "return_distance": {"yes": True},
    "seeds": {"two": lambda start: np.argsort(distances_from(start))[[0, 5]].astype(np.int32)},
    "face": {"given": lambda start: int(INDEX.closest_point(start)[0])},
    "walls": {"mask": WALLS},
    "ignored": {"mask": IGNORED},
    "sort": {"id": "id", "index": "index", "distance": "distance"},
    "metric": {"path": "path", "surface": "surface", "rings": "rings", "space": "space"},
    "unit": {"edge": "edge"},
    "method": {"bfs": "bfs", "ball": "ball"},
    "dtype": {"single": np.float32},
}


def start_of(words, start):
    """As `PLAIN` takes it, with the masks."""
    if np.ndim(start) == 0:
        return {"v": int(start), **masks_of(words)}
    distances = np.where(WALLS & ("walls" in words), np.inf, distances_from(start))
    seeds = F[words["face"]] if "face" in words else words.get("seeds", [np.argmin(distances)])
    return {"v": None, **masks_of(words), "point": tuple(start.tolist()), "seeds": tuple(int(v) for v in seeds)}


def region_by_hand(words, start, r):
    """Ascending ids, and their distances or lengths."""
    how = words.get("method", words.get("metric", "straight"))
    how = {"bfs": "straight", "ball": "space"}.get(how, how)
    return arrays_of(PLAIN.neighborhood(r=float(r), metric=how, **start_of(words, start)))


def check_region(words, start, answer):
    r = R * (INDEX.mean_edge_length if "unit" in words else 1)
    how = words.get("method", words.get("metric", "straight"))
    ids, distances = region_by_hand(words, start, r)
    found = answer if isinstance(answer, tuple) else (answer,)
    if "sort" not in words and how == "bfs":  # an order of its own
        found = [column[np.argsort(PLACE[found[0]])] for column in found]
    place = {"id": ids, "distance": distances}.get(words.get("sort", "distance" if how in ("path", "surface") else "index"), PLACE[ids])
    order = np.lexsort([ids, place])
    np.testing.assert_array_equal(found[0], ids[order])
    if "return_distance" in words:
        np.testing.assert_allclose(found[1], distances[order], rtol=1e-6 if "dtype" in words else 1e-12)


def check_count(words, start, answer):
    r = R * (INDEX.mean_edge_length if "unit" in words else 1)
    assert type(answer) is int and answer == len(region_by_hand(words, start, r)[0])


def check_nested(words, start, answer):
    counts, ids = answer
    for r, begin, end in zip((1.4, 2.3), (0, *counts), counts):
        r *= INDEX.mean_edge_length if "unit" in words else 1
        np.testing.assert_array_equal(np.sort(ids[:end]), region_by_hand(words, start, r)[0])
        assert np.all(np.diff(PLACE[ids[begin:end]]) > 0)
    assert len(ids) == counts[-1]


def connecting_by_hand(words, start, r):
    """The keys that order vertices of one connecting radius, the vertices, and their radii, up to r."""
    if "metric" in words:
        ids, lengths = region_by_hand(words, start, r)
        return [PLACE[ids]], ids, lengths
    ids, radii = arrays_of(PLAIN.connecting_radii(most=None, **start_of(words, start), r=r))
    return [ids, distances_from(V[start] if np.ndim(start) == 0 else start)[ids]], ids, radii


def check_contains(words, start, answer):
    r = R * (INDEX.mean_edge_length if "unit" in words else 1)
    assert answer == (near_of(start) in connecting_by_hand(words, start, r)[1])


def check_connecting(words, start, answer):
    _, ids, radii = connecting_by_hand(words, start, 8.0)
    wanted = radii[ids == near_of(start)]
    expected = wanted[0] if len(wanted) else np.inf
    np.testing.assert_allclose(answer if answer <= 8.0 else np.inf, expected, rtol=rounding(words))


def check_nearest(words, start, answer):
    keys, ids, radii = connecting_by_hand(words, start, 5.0)
    order = np.lexsort([*keys, radii])[:9]
    for found, wanted in zip(answer, (ids[order], radii[order])):
        np.testing.assert_allclose(found, wanted, rtol=rounding(words))


def rounding(words):
    """Relative: lines over triangles are computed another way by `PLAIN`, all else is the same to the last bit."""
    return 1e-12 if words.get("metric") == "surface" else 0


def near_of(start):
    """A vertex near the start."""
    return int(np.argsort(distances_from(V[start] if np.ndim(start) == 0 else start))[7])


CALLS_OF_START = {
    "neighborhood": (lambda start, **words: INDEX.neighborhood(start, R, **words), check_region),
    "count": (lambda start, **words: INDEX.count(start, R, **words), check_count),
    "nested": (lambda start, **words: INDEX.nested(start, [1.4, 2.3], **words), check_nested),
    "contains": (lambda start, **words: INDEX.contains(start, near_of(start), R, **words), check_contains),
    "connecting_radius": (lambda start, **words: INDEX.connecting_radius(start, near_of(start), **words), check_connecting),
    "nearest_connected": (lambda start, **words: INDEX.nearest_connected(start, 9, **words), check_nearest),
}


def keywords_of(method):
    """The options of a call."""
    return [p.name for p in inspect.signature(method).parameters.values() if p.default is not p.empty]


@pytest.mark.filterwarnings("ignore:start. the point is farther")
@pytest.mark.parametrize(("name", "kind"), list(itertools.product(CALLS_OF_START, STARTS)))
def test_pairs_of_options_for_one_start(name, kind):
    call, by_hand = CALLS_OF_START[name]
    names = keywords_of(getattr(meshhood.MeshIndex, name))
    options = options_of(name, names, OPTIONS_OF_START)

    def ask(*given):
        asked = []
        for start in STARTS[kind]:
            of_point = [(option, value(start) if callable(value) and kind == "point" else value) for option, value in given]
            asked.append((dict(of_point), start, call(start, **dict(of_point))))
        return asked, None

    def check_all(asked, _):
        for words, start, answer in asked:
            by_hand(words, start, answer)
        return len(asked)

    check_pairs(f"{name} of a {kind}", options, ask, check_all, {"seeds": ["start"], "face": ["start"], "metric": ["start"],
                "sort": [], "return_distance": []})  # fmt: skip


def test_pairs_of_options_of_a_stroke():
    options = {
        "r": {"each": np.linspace(1.3, R, len(POINTS))},
        **{name: OPTIONS_OF_START[name] for name in ("seeds", "face", "metric", "walls", "ignored", "unit")},
        "sort": {"id": "id"},
    }
    names = keywords_of(meshhood.MeshIndex.stroke)
    assert set(names) | {"r"} == set(options)

    def ask(*given):
        words = {name: np.array([value(p) for p in POINTS]) if callable(value) else value for name, value in given}
        return words, INDEX.stroke(STARTS["vertex"] if words.get("metric") == "rings" else POINTS, **{"r": R, **words})

    def check_stroke(words, answer):
        unit, found = INDEX.mean_edge_length if "unit" in words else 1, set()
        for i, r in enumerate(np.broadcast_to(words.get("r", R), len(POINTS))):
            of_point = {name: value[i] if name in ("seeds", "face") else value for name, value in words.items()}
            start = STARTS["vertex"][i] if words.get("metric") == "rings" else POINTS[i].astype(float)
            found |= set(connecting_by_hand(of_point, start, r * unit)[1].tolist())
        ids = np.array(sorted(found))
        np.testing.assert_array_equal(answer, ids if "sort" in words else ids[np.argsort(PLACE[ids])])
        return 1

    check_pairs("stroke", options, ask, check_stroke, {"seeds": ["points"], "face": ["points"], "metric": ["points"]})


# Calls of which only `HOW` has options, or whose options change the answer by themselves.
POLYGONS = (np.arange(0, 3 * len(F) + 1, 3), F.ravel())
REGION = INDEX.neighborhood(4711, 3.0)
HOW_ELSE = ("F", "workers", "progress", "max_edges", "keep_faces", "mmap", "trusted", "memory", "resume", "faces", "order",
            "vertices_per_part", "parts")  # fmt: skip
OPTIONS_ELSE = {
    "vertices": {"some": np.array([7, 3, 7, 40], np.int32)},
    "points": {"centers": V[F[:40]].mean(axis=1)},
    "face": {"first": np.arange(40)},
    "method": {"sphere": "sphere"},
    "F": {"faces": F, "polygons": POLYGONS},
    "workers": {"3": 3},
    "progress": {"function": lambda: Watch()},
    "max_edges": {"enough": 10**6},
    "keep_faces": {"no": False},
    "cut": {"walls": F[WALLS[F].any(axis=1)][:, :2]},
    "changed": {"all": np.arange(COUNT), "mask": np.ones(COUNT, bool)},
    "corners": {"any": "any"},
    "faces": {"yes": True},
    "mmap": {"yes": True},
    "trusted": {"yes": True},
    "values": {"given": {"quality": AREAS, "normal": NORMALS}},
    "colors": {"given": np.zeros((COUNT, 3), np.uint8)},
    "eps": {"small": 1e-6},
    "unit": {"edge": "edge"},
    "parts": {"5": 5},
    "vertices_per_part": {"9000": 9000},
    "memory": {"text": "512MiB"},
    "resume": {"no": False},
    "radius": {"3": 3},
    "useKring": {"yes": True},
    "reduce": {"max": "max", "var": "var"},
    "weights": {"area": "area", "numbers": AREAS + 0.25},
    "kernel": {"gaussian": "gaussian"},
    "nan": {"omit": "omit"},
    "ddof": {"1": 1},
    "q": {"0.9": 0.9},
    "order": {"parts": "parts"},
    "like": {"libigl": "libigl"},
    "fit": {"jet": "jet"},
    "filter": {"no": False},
    "dtype": {"single": np.float32},
}


def counts_of(index):
    return index.counts(R), index.n_vertices


def saved(folder, mmap=False, trusted=False, progress=None, **words):
    INDEX.save(folder / "index", **words)
    return counts_of(meshhood.load(folder / "index", mmap=mmap, trusted=trusted, progress=progress))


def written(folder, name="m.ply", **words):
    meshhood.write_mesh(folder / name, V, F, **words)
    return tuple(meshhood.read_mesh(folder / name))


def partitioned(folder, parts=None, vertices_per_part=None, **words):
    np.save(folder / "V.npy", V), np.save(folder / "F.npy", F)
    parts = 3 if parts is None and vertices_per_part is None else parts
    made = meshhood.partition((folder / "V.npy", folder / "F.npy"), folder / "parts", halo=2.6, parts=parts,
                              vertices_per_part=vertices_per_part, **words)  # fmt: skip
    return made.counts(R).compute(), made.n_vertices


CALLS_ELSE = {
    meshhood.MeshIndex: lambda folder, F=F, **words: counts_of(meshhood.MeshIndex(V, F, **words)),
    meshhood.MeshIndex.of_faces: lambda folder, F=F, **words: counts_of(meshhood.MeshIndex.of_faces(V, F, **words)),
    meshhood.MeshIndex.from_points: lambda folder, **words: counts_of(meshhood.MeshIndex.from_points(V, 1.1, **words)),
    meshhood.MeshIndex.refit: lambda folder, **words: counts_of(INDEX.refit(V + np.float32(1), **words)),
    meshhood.MeshIndex.closest_point: lambda folder, **words: INDEX.closest_point(V + np.float32(0.02), **words),
    meshhood.MeshIndex.first_hit: lambda folder, **words: INDEX.first_hit(V + np.float32(9), -np.ones_like(V), **words),
    meshhood.MeshIndex.thickness: lambda folder, face=None, **words: INDEX.thickness(
        face=np.arange(40) if "points" in words else face, **words
    ),
    meshhood.MeshIndex.submesh: lambda folder, **words: INDEX.submesh(REGION, **words)[::2],  # positions and vertices
    meshhood.MeshIndex.rim: lambda folder, **words: [line.points for line in INDEX.rim(REGION, 4711, 3.0, **words)],
    meshhood.MeshIndex.save: saved,
    meshhood.load: saved,
    meshhood.read_mesh: lambda folder, **words: (written(folder), tuple(meshhood.read_mesh(folder / "m.ply", **words)))[1],
    meshhood.write_mesh: lambda folder, F=F, **words: written(folder, **words),
    meshhood.vertex_areas: lambda folder, F=F: meshhood.vertex_areas(V, F),
    meshhood.weld: lambda folder, F=F, **words: meshhood.weld(V, F, **words).ids,
    meshhood.principal_curvature: lambda folder, **words: meshhood.principal_curvature(V, F, **words),
    meshhood.partition: partitioned,
}
# Calls without options, and those of which other tests ask for all that they have.
WITHOUT_PAIRS = {
    "nearest", "quality", "stroke", "rim", "geometric_radii", "open_parts", "persistence", "show_config",
    "smoothing_radius", "plot_neighborhood", "view", "open", "ids", "masked", "patch", "clip", "measure", "gap", "padded",
}  # fmt: skip


@pytest.fixture(scope="module")
def parts(tmp_path_factory):
    pytest.importorskip("dask.array")
    folder = tmp_path_factory.mktemp("parts")
    np.save(folder / "V.npy", V), np.save(folder / "F.npy", F)
    return meshhood.partition((folder / "V.npy", folder / "F.npy"), folder / "parts", parts=2, halo=3.0)


@pytest.mark.parametrize("name", ("counts", "aggregate", "curvature"))
def test_pairs_of_options_of_parts(name, parts):
    """Against those of one index."""
    import dask

    given, in_order = {"values": VALUES} if name == "aggregate" else {}, parts.ids().compute()
    names = keywords_of(getattr(meshhood.distributed.Parts, name))
    options = options_of(f"Parts.{name}", [word for word in names if word != "r"], OPTIONS_ELSE)

    def ask(*chosen):
        words = {**(WITH["ddof"] if "ddof" in dict(chosen) else {}), **dict(chosen)}
        made = getattr(parts, name)(r=R, **given, **words)
        return words, flat(dask.compute(*made) if name == "curvature" else made.compute())

    def check_parts(words, found):
        order = in_order if words.pop("order", "mesh") == "parts" else slice(None)
        wanted = getattr(INDEX, name)(**{"vertices": None, "r": R}, **given, **words)
        for a, b in zip(found, flat(tuple(wanted) if name == "curvature" else wanted)):
            if a.ndim == 1 or name == "aggregate":  # directions may be any where both curvatures are equal
                np.testing.assert_allclose(a, b[order], rtol=1e-7, atol=1e-8)
        return 0

    check_pairs(f"Parts.{name}", options, ask, check_parts, WITH)


def flat(answer):
    if isinstance(answer, (tuple, list)):
        return [array for part in answer for array in flat(part)]
    return [np.asarray(answer)]


@pytest.mark.parametrize("method", CALLS_ELSE, ids=lambda method: method.__qualname__)
def test_options_of_how_do_not_change_an_answer(method, tmp_path):
    """Whatever else is given."""
    call, number = CALLS_ELSE[method], itertools.count()
    names = keywords_of(method.__init__ if inspect.isclass(method) else method)
    options = options_of(method.__qualname__, names, OPTIONS_ELSE)

    def ask(*given):
        words = {name: value() if name == "progress" else value for name, value in given}
        folder = tmp_path / str(next(number))
        folder.mkdir()
        return words, (call(folder, **words), folder)

    def check_same(words, found):
        answer, folder = found
        plain = {name: value for name, value in words.items() if name not in HOW_ELSE}
        (folder / "plain").mkdir()
        for a, b in zip(flat(answer), flat(call(folder / "plain", **plain))):
            np.testing.assert_array_equal(a, b)
        if "progress" in words:
            assert words["progress"].last == words["progress"].total
        return 0

    check_pairs(method.__qualname__, options, ask, check_same, {"trusted": ["mmap"], "parts": [], "colors": []})


def test_every_call_has_its_pairs():
    known = {call.name for call in CALLS} | set(CALLS_OF_START) | WITHOUT_PAIRS
    known |= {method.__name__ for method in CALLS_ELSE} | {"of_faces", "from_points"}
    places = [getattr(meshhood, name) for name in meshhood.__all__]
    calls = {name for name in dir(meshhood.MeshIndex) if callable(getattr(meshhood.MeshIndex, name))}
    calls |= {place.__name__ for place in places if inspect.isfunction(place)}
    missing = sorted(name for name in calls if not name.startswith("_") and name not in known)
    assert not missing, f"no pairs of options for {', '.join(missing)}"
