# SPDX-License-Identifier: MIT
"""Index files and folders of parts that are damaged, or that a writer replaces all the time while others read them: the
answer of one of the states, or one error that names the file."""

import multiprocessing
import random
import threading
import time

import meshes
import meshhood
import numpy as np
import pytest
from scale import scaled

READS = scaled(400, least=40)
PART_READS = scaled(60, least=12)
DAMAGES = scaled(400, least=40)
HALO = 2.0
SIDES = (12, 20)

MESHES = [meshes.two_plates(side) for side in SIDES]
INDEXES = [meshhood.MeshIndex(V, F) for V, F in MESHES]
# Of meshes of different sizes, so that the total shows the state.
COUNTS = {len(index): index.counts(HALO) for index in INDEXES}


def check(index):
    np.testing.assert_array_equal(index.counts(HALO, workers=1), COUNTS[len(index)])
    return len(index)


def write_indexes(path, begun, stop):
    while not stop.is_set():
        for index in INDEXES:
            index.save(path)
        begun.set()


def write_parts(arrays, folder, begun, stop):
    while not stop.is_set():
        for files in arrays:
            meshhood.partition(files, folder, parts=3, halo=HALO, resume=False, workers=1)
            stop.wait(random.random() / 3)  # seconds in which it can be read
        begun.set()


@pytest.fixture
def writer():
    """Starts a process that calls `function(*arguments, begun, stop)`."""
    context = multiprocessing.get_context("spawn")
    begun, stop, started = context.Event(), context.Event(), []

    def start(function, *arguments):
        started.append(context.Process(target=function, args=(*arguments, begun, stop)))
        started[0].start()
        assert begun.wait(60)

    yield start
    stop.set()
    for process in started:
        process.join(60)
        assert process.exitcode == 0


@pytest.mark.parametrize("mmap", (False, True))
def test_an_index_file_that_is_replaced_all_the_time(mmap, tmp_path, writer):
    path = tmp_path / "mesh.mhi"
    INDEXES[0].save(path)
    writer(write_indexes, path)
    seen = {len(index): 0 for index in INDEXES}

    def read():
        kept, reads = [], 0
        while reads < READS or not all(seen.values()):  # the writer may begin late
            reads += 1
            index = meshhood.load(path, mmap=mmap)
            seen[check(index)] += 1
            kept = [*kept[-3:], index]
            check(kept[0])  # of a file that has been replaced since

    threads = [threading.Thread(target=read) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert sum(seen.values()) >= 2 * READS and all(seen.values())
    print(f"reads of either file: {seen}")


def test_parts_that_are_replaced_all_the_time(tmp_path, writer):
    arrays = []
    for side, (V, F) in zip(SIDES, MESHES):
        arrays.append((tmp_path / f"V{side}.npy", tmp_path / f"F{side}.npy"))
        np.save(arrays[-1][0], V), np.save(arrays[-1][1], F)
    folder = tmp_path / "parts"
    meshhood.partition(arrays[0], folder, parts=3, halo=HALO)
    writer(write_parts, arrays, folder)
    outcomes = {"answered": 0, "replaced": 0, "missing": 0}

    def counts(parts):
        found = np.full(parts.n_vertices, -1)
        for number in range(len(parts)):
            part = parts.open(number)
            time.sleep(random.random() / 100)
            assert part.mesh.faces.max() < len(part.vertices)
            found[part.vertices[part.owned]] = part.index.counts(HALO, part.owned, workers=1)
        return found

    while sum(outcomes.values()) < PART_READS or outcomes["answered"] < PART_READS // 4:
        try:
            parts = meshhood.open_parts(folder)
            np.testing.assert_array_equal(counts(parts), COUNTS[parts.n_vertices])
            outcomes["answered"] += 1
        except ValueError as error:
            assert str(folder) in str(error), repr(error)
            outcomes["replaced"] += 1
        except FileNotFoundError as error:
            assert str(folder) in str(error.filename), repr(error)
            outcomes["missing"] += 1
            time.sleep(0.01)
    print(f"parts while they are replaced: {outcomes}")


def damaged(data, draw):
    """`data` with some bits flipped, cut, extended, or with a piece of it elsewhere."""
    data = bytearray(data)
    kind = draw.randrange(4)
    if kind == 0:
        for _ in range(draw.choice((1, 1, 2, 9))):
            data[draw.randrange(len(data))] ^= 1 << draw.randrange(8)
    elif kind == 1:
        del data[draw.randrange(len(data)) :]
    elif kind == 2:
        data += draw.randbytes(draw.choice((1, 8, 4096)))
    else:
        size = draw.randrange(1, len(data) // 2)
        begin, to = draw.randrange(len(data) - size), draw.randrange(len(data) - size)
        data[to : to + size] = data[begin : begin + size]
    return bytes(data)


def replace(path, content):
    path.unlink()  # a mapped file must not be changed in place
    path.write_bytes(content)


@pytest.mark.parametrize("mmap", (False, True))
def test_a_damaged_index_file_is_refused(mmap, tmp_path):
    path = tmp_path / "mesh.mhi"
    INDEXES[0].save(path)
    whole = path.read_bytes()
    draw = random.Random(1)
    for _ in range(DAMAGES):
        content = damaged(whole, draw)
        replace(path, content)
        if content == whole:
            continue
        with pytest.raises(ValueError, match="mesh.mhi: "):
            meshhood.load(path, mmap=mmap)
    print(f"{DAMAGES} damaged files refused")


def test_a_damaged_file_of_a_part_is_refused(tmp_path):
    V, F = MESHES[0]
    arrays = tmp_path / "V.npy", tmp_path / "F.npy"
    np.save(arrays[0], V), np.save(arrays[1], F)
    folder = tmp_path / "parts"
    meshhood.partition(arrays, folder, parts=2, halo=HALO)
    draw = random.Random(2)
    refused = {}
    files = sorted(path for path in folder.rglob("*") if path.suffix in (".mhi", ".npy") or path.name == "manifest.json")
    assert len(files) == 11
    for path in files:
        whole = path.read_bytes()
        for trial in range(max(2, DAMAGES // len(files))):
            content = b"" if trial == 0 else damaged(whole, draw)
            if content == whole:
                continue
            replace(path, content)
            meshhood._open_part._opened.cache_clear()  # an opened part does not need its files
            with pytest.raises(ValueError, match=path.name):
                for number in range(2):
                    meshhood.open_parts(folder).open(number)
            refused[path.name] = refused.get(path.name, 0) + 1
        replace(path, whole)
        moved = path.with_suffix(".moved")
        path.rename(moved)
        with pytest.raises(FileNotFoundError, match=path.name):
            for number in range(2):
                meshhood.open_parts(folder).open(number)
        moved.rename(path)
    meshhood._open_part._opened.cache_clear()
    meshhood.open_parts(folder).open(1)
    print(f"damaged files refused: {refused}")


def test_an_index_does_not_need_its_file(tmp_path):
    path = tmp_path / "mesh.mhi"
    for old, new in ((0, 1), (1, 0)):
        INDEXES[old].save(path)
        loaded, mapped = meshhood.load(path), meshhood.load(path, mmap=True)
        INDEXES[new].save(path)
        assert check(loaded) == check(mapped) == len(INDEXES[old])
        assert check(meshhood.load(path)) == check(meshhood.load(path, mmap=True)) == len(INDEXES[new])
        path.unlink()
        assert check(loaded) == check(mapped) == len(INDEXES[old])


def test_a_mesh_file_that_is_replaced_is_read_again(tmp_path):
    for path in (tmp_path / "mesh.mhi", tmp_path / "mesh.off"):
        for index, (V, F) in zip(INDEXES, MESHES):
            if path.suffix == ".mhi":
                index.save(path)
            else:
                rows = [f"{x} {y} {z}" for x, y, z in V.tolist()] + [f"3 {a} {b} {c}" for a, b, c in F.tolist()]
                path.write_text(f"OFF\n{len(V)} {len(F)} 0\n" + "\n".join(rows))
            pytest.importorskip("dask")
            counts = meshhood.distributed.map_meshes([path], counts_of)
            np.testing.assert_array_equal(counts[0], COUNTS[len(index)])


def counts_of(index):
    return index.counts(HALO, workers=1)
