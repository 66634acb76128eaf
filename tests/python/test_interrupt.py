# SPDX-License-Identifier: MIT
"""Long calls: progress, Ctrl-C, and other threads that run meanwhile (reliability rows P3 and P5)."""

import contextlib
import os
import pickle
import signal
import threading
import time
from pathlib import Path

import meshes
import meshhood
import numpy as np
import pytest

SIDE = 300


@pytest.fixture(scope="module")
def index():
    return meshhood.MeshIndex(*meshes.two_plates(SIDE))


def aggregate(index, r, **options):
    return index.aggregate(np.ones(len(index)), r, **options)


def curvature(index, r, **options):
    return index.curvature(r, normals=np.tile([0.0, 0, 1], (len(index), 1)), **options)


def without_end(index, method="exact", progress=None):
    """Batches without a receiver, in little memory."""
    while True:
        index.counts(SIDE / 3.0, method=method, progress=progress)


def again_and_again(call):
    def calls():
        while True:
            call()

    return calls


@pytest.fixture
def ctrl_c():
    """Calls a function that does not end, sends Ctrl-C, and returns how long the call continued."""
    if threading.current_thread() is not threading.main_thread():
        pytest.skip("signals reach the main thread alone")

    def press(call):
        pressed = []

        def interrupt():
            pressed.append(time.monotonic())
            signal.raise_signal(signal.SIGINT)

        timer = threading.Timer(0.3, interrupt)
        timer.start()
        try:
            with pytest.raises(KeyboardInterrupt):
                call()
        finally:
            timer.join()
        return time.monotonic() - pressed[0]

    return press


@pytest.mark.parametrize("method", ("exact", "paper", "bfs", "ball"))
def test_ctrl_c_in_a_batch(index, ctrl_c, method):
    before = index.count(0, 1.0, method=method)
    seconds = ctrl_c(lambda: without_end(index, method))
    print(f"{method}: KeyboardInterrupt after {1000 * seconds:.0f} ms")
    assert index.count(0, 1.0, method=method) == before


@pytest.mark.parametrize("call", (aggregate, curvature))
@pytest.mark.parametrize("workers", (1, 2))
def test_ctrl_c_in_sums_over_neighborhoods(index, ctrl_c, call, workers):
    seconds = ctrl_c(again_and_again(lambda: call(index, SIDE / 3.0, workers=workers)))
    print(f"{call.__name__}, {workers} workers: KeyboardInterrupt after {1000 * seconds:.0f} ms")
    assert index.aggregate(np.ones(len(index)), 0.0, "sum", vertices=7) == 1


def test_ctrl_c_in_a_build(ctrl_c):
    V, F = meshes.two_plates(SIDE)
    seconds = ctrl_c(again_and_again(lambda: meshhood.MeshIndex(V, F)))
    print(f"build: KeyboardInterrupt after {1000 * seconds:.0f} ms")


OPEN_FILES = Path("/proc/self/fd")


@contextlib.contextmanager
def nothing_stays_open():
    before = len(list(OPEN_FILES.iterdir())) if OPEN_FILES.is_dir() else 0
    yield
    assert before == (len(list(OPEN_FILES.iterdir())) if OPEN_FILES.is_dir() else 0)


def test_ctrl_c_while_reading_a_mesh(tmp_path, ctrl_c):
    file = tmp_path / "large.obj"
    file.write_text("v 1.25 2.5 3.75\n" * 1_000_000)
    with nothing_stays_open():
        seconds = ctrl_c(again_and_again(lambda: meshhood.read_mesh(file)))
    print(f"read_mesh: KeyboardInterrupt after {1000 * seconds:.0f} ms")
    assert len(meshhood.read_mesh(file).vertices) == 1_000_000


@pytest.mark.parametrize("mmap", (False, True))
def test_ctrl_c_while_loading_an_index(index, tmp_path, ctrl_c, mmap):
    index.save(tmp_path / "index")
    with nothing_stays_open():
        seconds = ctrl_c(again_and_again(lambda: meshhood.load(tmp_path / "index", mmap=mmap)))
    print(f"load: KeyboardInterrupt after {1000 * seconds:.0f} ms")


def test_ctrl_c_while_saving_an_index(index, tmp_path, ctrl_c):
    file = tmp_path / "index"
    index.save(file)  # so that there is a file, however slow the machine is
    with nothing_stays_open():
        seconds = ctrl_c(again_and_again(lambda: index.save(file)))
    print(f"save: KeyboardInterrupt after {1000 * seconds:.0f} ms")
    assert list(tmp_path.iterdir()) == [file]
    assert len(meshhood.load(file)) == len(index)


def test_ctrl_c_while_saving_leaves_the_old_file(index, tmp_path):
    file = tmp_path / "index"
    file.write_text("old")
    with nothing_stays_open(), pytest.raises(KeyboardInterrupt):
        index.save(file, progress=lambda done, total: done == total and signal.raise_signal(signal.SIGINT))
    assert list(tmp_path.iterdir()) == [file]
    assert file.read_text() == "old"


def test_ctrl_c_in_pickling(index, ctrl_c):
    seconds = ctrl_c(again_and_again(lambda: pickle.dumps(index)))
    print(f"pickling: KeyboardInterrupt after {1000 * seconds:.0f} ms")


def test_ctrl_c_in_unpickling(index, ctrl_c):
    pickled = pickle.dumps(index)
    seconds = ctrl_c(again_and_again(lambda: pickle.loads(pickled)))
    print(f"unpickling: KeyboardInterrupt after {1000 * seconds:.0f} ms")


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes with names here")
@pytest.mark.parametrize("read", (meshhood.read_mesh, meshhood.load))
def test_ctrl_c_while_waiting_for_a_pipe(tmp_path, ctrl_c, read):
    pipe = tmp_path / "pipe.ply"
    os.mkfifo(pipe)
    with open(pipe, "r+b", buffering=0), nothing_stays_open():  # a writer that never writes
        seconds = ctrl_c(lambda: read(pipe))
    print(f"{read.__name__}: KeyboardInterrupt after {1000 * seconds:.0f} ms")


def test_ctrl_c_in_a_build_of_the_paper(index, ctrl_c):
    def builds_without_end():
        growth = 0.0
        while True:
            growth += 0.001
            index.count(0, 1.0, method=meshhood.Paper(fusion_growth=growth))

    seconds = ctrl_c(builds_without_end)
    print(f"hierarchy: KeyboardInterrupt after {1000 * seconds:.0f} ms")


@pytest.mark.parametrize("method", ("exact", "paper", "bfs", "ball"))
def test_an_exception_of_progress_ends_the_call(index, method):
    def enough(done, total):
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        index.neighborhoods(1.0, method=method, progress=enough)
    with pytest.raises(LookupError, match="enough"):
        meshhood.MeshIndex(*meshes.two_plates(20), progress=enough)
    assert index.count(0, 0.0, method=method) == 1


def test_progress_bar(index, capsys):
    pytest.importorskip("tqdm")
    index.neighborhoods(1.0, range(100), progress=True)
    assert "100" in capsys.readouterr().err


def test_other_threads_run_during_a_batch(index):
    """This thread runs Python code during the batch, which is impossible if the batch holds the lock."""
    begun, seen = threading.Event(), []

    def watch(done, total):
        begun.set()
        if seen:
            raise StopIteration

    def beside():
        begun.wait()
        seen.append(True)

    thread = threading.Thread(target=beside)
    thread.start()
    with pytest.raises(StopIteration):
        without_end(index, progress=watch)
    thread.join()
