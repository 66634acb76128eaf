# SPDX-License-Identifier: MIT
"""What is made from an index, or from parts, and used after a change: a refit, other masks, other faces, another
partition. The answer is that of an index on which nothing was asked before, or there is one clear error. What can be
made is read from the classes; a parameter without a value in `ARGUMENTS` fails by name."""

import inspect
import itertools
import pickle
import re

import meshes
import meshhood
import numpy as np
import pytest
from meshhood import distributed

V, F = meshes.two_plates(12)
V[:, 2] += np.sin(V[:, 0]) * np.cos(V[:, 1] / 2) / 8
COUNT = len(V)
RANDOM = np.random.default_rng(3)
MOVED = (V * [1.1, 0.9, 1] + RANDOM.uniform(-0.2, 0.2, V.shape)).astype(np.float32)
SOME = np.arange(COUNT) % 7 == 3  # that move alone
OTHER_FACES = F[: len(F) // 2]
START = 43  # with OTHER_FACES its gap has another face
ARGUMENTS = {
    "vertices": [5, 80, 200],
    "r": 2.0,
    "fwhm": 2.0,
    "k": 3,
    "area": 3.0,
    "v": 42,
    "w": 44,
    "start": START,
    "radii": [1.0, 2.0],
    "points": V[:4] + np.float32(0.1),
    "q": V[:4] + np.float32(0.1),
    "origins": V[:4] + np.float32(1),
    "directions": np.array([[0.1, 0.2, -1], [-0.3, 0.1, -1], [-1, -1, -1], [1, 0, 0]]),
    "ids": meshhood.MeshIndex(V, F).neighborhood(START, 2.0),
    "values": RANDOM.normal(size=(COUNT, 2)),
    "V": V,
    "P": V,
    "link": 1.0,
}
MASKS = [{"walls": RANDOM.random(COUNT) < share, "ignored": RANDOM.random(COUNT) < share} for share in (0.2, 0.3)]
NAMES = [name for name in dir(meshhood.MeshIndex) if not name.startswith("_")]


def values_of(answer):
    """An answer as nested lists that can be compared."""
    if isinstance(answer, np.ndarray):
        return [str(answer.dtype), answer.shape, answer.tobytes()]
    if hasattr(answer, "indptr") and not isinstance(answer, tuple):
        return values_of((answer.indptr, answer.indices, answer.data))
    if isinstance(answer, meshhood.MeshIndex):
        return values_of((answer.positions, answer.counts(2.0)))
    if isinstance(answer, (tuple, list)) or inspect.isgenerator(answer):
        return [values_of(part) for part in answer]
    assert answer is None or isinstance(answer, (bool, int, float, str)), type(answer)
    return repr(answer)


def made(index, name, tmp_path, **words):
    """What a member of an index makes."""
    member = getattr(index, name)
    if not callable(member):
        return member
    if name == "save":
        index.save(tmp_path / "saved", **words)
        return meshhood.load(tmp_path / "saved")
    parameters = inspect.signature(member).parameters
    wanted = [p.name for p in parameters.values() if p.default is p.empty and p.kind != p.VAR_KEYWORD]
    wanted += [word for word in ("r", "fwhm", "k", "vertices") if word in parameters and word not in wanted]
    missing = [word for word in wanted if word not in ARGUMENTS]
    assert not missing, f"{name}: no values for {', '.join(missing)}"
    if name == "of_faces":
        words = {"F": F, **words}
    try:
        return member(**{word: ARGUMENTS[word] for word in wanted}, **words)
    except ValueError as error:  # of other positions, `ids` are no region
        return str(error)


def takes(name, *words):
    try:
        made(meshhood.MeshIndex(V, F), name, None, **dict.fromkeys(words))
    except TypeError:
        return False
    return callable(getattr(meshhood.MeshIndex, name))


@pytest.mark.parametrize("name", NAMES)
def test_what_was_made_before_a_refit(name, tmp_path):
    index = meshhood.MeshIndex(V, F)
    before, held = values_of(made(index, name, tmp_path)), made(index, name, tmp_path)
    for changed, moved in ((None, MOVED), (np.arange(COUNT), MOVED), (SOME, np.where(SOME[:, None], MOVED, V))):
        unused = meshhood.MeshIndex(V, F).refit(moved, changed)
        back = values_of(made(unused.refit(V, changed), name, tmp_path))
        fresh = values_of(made(unused, name, tmp_path))
        refitted = index.refit(moved, changed)
        assert values_of(made(refitted, name, tmp_path)) == fresh
        assert values_of(made(refitted.refit(V, changed), name, tmp_path)) == back
        assert back == before or name == "quality"  # of other bounds
        assert values_of(made(pickle.loads(pickle.dumps(refitted)), name, tmp_path)) == fresh
    assert values_of(made(index, name, tmp_path)) == before
    assert values_of(held) == before


@pytest.mark.parametrize("name", [name for name in NAMES if takes(name, "walls", "ignored")])
def test_what_was_made_with_other_masks(name, tmp_path):
    """Also where the arrays have other contents than before."""
    index = meshhood.MeshIndex(V, F)
    changing = {word: mask.copy() for word, mask in MASKS[0].items()}
    first, held = values_of(made(index, name, tmp_path, **changing)), made(index, name, tmp_path, **changing)
    for word in changing:
        changing[word][:] = MASKS[1][word]
    second = values_of(made(meshhood.MeshIndex(V, F), name, tmp_path, **MASKS[1]))
    assert values_of(made(index, name, tmp_path, **changing)) == second
    assert values_of(held) == first
    assert values_of(made(index, name, tmp_path)) == values_of(made(meshhood.MeshIndex(V, F), name, tmp_path))
    refitted = index.refit(MOVED)
    fresh = meshhood.MeshIndex(V, F).refit(MOVED)
    assert values_of(made(refitted, name, tmp_path, **changing)) == values_of(made(fresh, name, tmp_path, **MASKS[1]))


@pytest.mark.parametrize("name", [name for name in NAMES if takes(name, "F")])
def test_what_was_made_with_other_faces(name, tmp_path):
    index, changing = meshhood.MeshIndex(V, F), F.copy()
    by_area = {"weights": "area"} if takes(name, "weights") else {}

    def answer(of, **words):
        return values_of(made(of, name, tmp_path, **by_area, **words))

    whole = answer(index)
    assert answer(index, F=changing) == whole
    changing[len(OTHER_FACES) :] = OTHER_FACES[: len(F) - len(OTHER_FACES)]
    fresh = answer(meshhood.MeshIndex(V, F), F=changing.copy())
    assert answer(index, F=changing) == fresh != whole
    assert answer(index) == whole
    assert answer(index.refit(MOVED), F=changing) == answer(meshhood.MeshIndex(V, F).refit(MOVED), F=changing)


@pytest.mark.parametrize("name", NAMES)
def test_what_was_made_from_a_file_that_is_replaced(name, tmp_path):
    path = tmp_path / "file"
    meshhood.MeshIndex(V, F).save(path, faces=True)
    for mmap in (False, True):
        index = meshhood.load(path, mmap=mmap)
        before, held = values_of(made(index, name, tmp_path)), made(index, name, tmp_path)
        meshhood.MeshIndex(MOVED[:100], F[(F < 100).all(axis=1)]).save(path)
        assert values_of(made(index, name, tmp_path)) == before
        assert values_of(held) == before
        meshhood.MeshIndex(V, F).save(path, faces=True)


def total(part, index, owned):
    return index.counts(1.0, owned, workers=1)


def of_parts(parts, name, to):
    """What a member of parts makes: arrays, of which nothing is computed yet, where it can."""
    member = getattr(parts, name)
    arguments = {"number": 1, "r": 1.0, "values": ARGUMENTS["values"], "function": total, "to": to}
    if not callable(member):
        return member
    wanted = [p.name for p in inspect.signature(member).parameters.values() if p.default is p.empty]
    missing = [word for word in wanted if word not in arguments]
    assert not missing, f"Parts.{name}: no values for {', '.join(missing)}"
    return member(**{word: arguments[word] for word in wanted})


def computed(answer):
    """The numbers of what a member of parts has made."""
    if isinstance(answer, distributed.OpenPart):
        members = [name for name in dir(answer) if not name.startswith("_")]
        return [values_of(getattr(answer, name)) for name in members]
    if hasattr(answer, "compute"):
        return values_of(answer.compute())
    if isinstance(answer, list) and all(isinstance(part, str) for part in answer):  # files
        return values_of([np.fromfile(path, np.uint8) for path in answer])
    if isinstance(answer, tuple):
        return [computed(part) for part in answer]
    return values_of(answer)


PARTS = [name for name in {*dir(distributed.Parts), *distributed.Parts.__annotations__} if not name.startswith("_")]


@pytest.mark.parametrize("name", sorted(PARTS))
def test_what_was_made_before_another_partition(name, tmp_path):
    """Another halo, another number of parts, another mesh."""
    pytest.importorskip("dask.array")
    others = ((V, F, 3, 2.0), (V, F, 4, 1.0), (MOVED, F, 3, 1.0), (V[:144], F[(F < 144).all(axis=1)], 3, 1.0))
    outcomes = []
    for number, (points, faces, count, halo) in enumerate(others):
        folder = tmp_path / f"{number}"
        parts = write(folder, V, F, 3, 1.0)
        before = computed(of_parts(parts, name, tmp_path / f"{number}-before"))
        lazy = of_parts(parts, name, tmp_path / f"{number}-lazy")
        write(folder, points, faces, count, halo)
        distributed.open_parts(folder).open(0)
        for use in (lambda: lazy, lambda: of_parts(parts, name, tmp_path / f"{number}-after")):
            try:
                assert computed(use()) == before, name
                outcomes.append("right")
            except (ValueError, FileNotFoundError) as error:
                assert re.search(re.escape(str(folder)), str(error)), error
                outcomes.append("refused")
    print(f"Parts.{name}: {outcomes.count('right')} right, {outcomes.count('refused')} refused")


def write(folder, points, faces, count, halo):
    files = [folder.with_name(f"{folder.name}-{name}.npy") for name in "VF"]
    for file, array in zip(files, (points, faces)):
        np.save(file, array)
    return meshhood.partition(tuple(files), folder, parts=count, halo=halo, resume=False)


def test_results_of_other_parts_are_not_continued(tmp_path):
    pytest.importorskip("dask.array")
    for name, (points, count, halo) in itertools.product(("write", "neighborhoods"), ((MOVED, 3, 1.0), (V, 4, 1.0))):
        folder, to = tmp_path / f"{name}{count}", tmp_path / f"{name}{count}-to"
        of_parts(write(folder, V, F, 3, 1.0), name, to)
        with pytest.raises(ValueError, match=re.escape(str(to))):
            of_parts(write(folder, points, F, count, halo), name, to)
