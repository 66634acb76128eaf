# SPDX-License-Identifier: MIT
"""Long calls: progress, Ctrl-C, and other threads that run meanwhile (reliability rows P3 and P5)."""

import contextlib
import itertools
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
METHODS = ("exact", "paper", "bfs", "ball")


@pytest.fixture(scope="module")
def index():
    return meshhood.MeshIndex(*meshes.two_plates(SIDE))


def without_end(index, progress):
    """Batches without a receiver, in little memory."""
    while True:
        index.counts(SIDE / 3.0, progress=progress)


# Each is called again and again.
CALLS = (
    *(f"index.counts(SIDE / 3.0, method={method!r})" for method in METHODS),
    "index.neighborhoods(4.0, sort='distance')",
    *(f"index.aggregate(ones, SIDE / 3.0, workers={workers})" for workers in (1, 2)),
    *(f"index.curvature(SIDE / 3.0, workers={workers})" for workers in (1, 2)),
    "index.count(0, 1.0, method=meshhood.Paper(fusion_growth=next(growth)))",
    "meshhood.MeshIndex(index.positions, index.faces)",
    "meshhood.read_mesh(folder / 'large.obj')",
    "meshhood.load(folder / 'index')",
    "meshhood.load(folder / 'index', mmap=True)",
    "index.save(folder / 'index')",
    "pickle.dumps(index)",
    "pickle.loads(pickled)",
)


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


OPEN_FILES = Path("/proc/self/fd")


@contextlib.contextmanager
def nothing_stays_open():
    before = len(list(OPEN_FILES.iterdir())) if OPEN_FILES.is_dir() else 0
    yield
    assert before == (len(list(OPEN_FILES.iterdir())) if OPEN_FILES.is_dir() else 0)


@pytest.fixture(scope="module")
def names(index, tmp_path_factory):
    folder = tmp_path_factory.mktemp("files")
    (folder / "large.obj").write_text("v 1.25 2.5 3.75\n" * 1_000_000)
    index.save(folder / "index")
    made = {"ones": np.ones(len(index)), "growth": itertools.count(0.001, 0.001), "pickled": pickle.dumps(index)}
    return {**globals(), **made, "index": index, "folder": folder}


@pytest.mark.parametrize("call", CALLS)
def test_ctrl_c_ends_a_call(names, ctrl_c, call):
    index, folder = names["index"], names["folder"]
    # Python ends by SIGINT if Ctrl-C has ever ended the `eval` of a text, even where the exception was caught.
    compiled = compile(call, "call", "eval")

    def call_without_end():
        while True:
            eval(compiled, names)

    with nothing_stays_open():
        seconds = ctrl_c(call_without_end)
    print(f"{call}: KeyboardInterrupt after {1000 * seconds:.0f} ms")
    assert {path.name for path in folder.iterdir()} == {"index", "large.obj"}
    assert len(meshhood.load(folder / "index")) == len(index)
    assert [index.count(0, 1.0, method=method) for method in METHODS] == [3, 3, 3, 4]


def test_ctrl_c_while_saving_leaves_the_old_file(index, tmp_path):
    file = tmp_path / "index"
    file.write_text("old")
    with nothing_stays_open(), pytest.raises(KeyboardInterrupt):
        index.save(file, progress=lambda done, total: done == total and signal.raise_signal(signal.SIGINT))
    assert list(tmp_path.iterdir()) == [file]
    assert file.read_text() == "old"


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes with names here")
@pytest.mark.parametrize("read", (meshhood.read_mesh, meshhood.load))
def test_ctrl_c_while_waiting_for_a_pipe(tmp_path, ctrl_c, read):
    pipe = tmp_path / "pipe.ply"
    os.mkfifo(pipe)
    with open(pipe, "r+b", buffering=0), nothing_stays_open():  # a writer that never writes
        seconds = ctrl_c(lambda: read(pipe))
    print(f"{read.__name__}: KeyboardInterrupt after {1000 * seconds:.0f} ms")


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
        without_end(index, watch)
    thread.join()
