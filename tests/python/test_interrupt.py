# SPDX-License-Identifier: MIT
"""Long calls: progress, Ctrl-C, and that others run meanwhile (reliability rows P3 and P5)."""

import signal
import threading
import time

import meshes
import meshhood
import pytest

SIDE = 300


@pytest.fixture(scope="module")
def index():
    return meshhood.MeshIndex(*meshes.two_plates(SIDE))


def without_end(index, method="exact", progress=None):
    """Batches that nobody waits for, in little memory."""
    while True:
        index.query_ball_count(None, SIDE / 3.0, method=method, progress=progress)


def builds_without_end():
    V, F = meshes.two_plates(SIDE)
    while True:
        meshhood.MeshIndex(V, F)


@pytest.fixture
def ctrl_c():
    """Calls a function that does not end, presses Ctrl-C, and tells how long it went on."""
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
    before = index.query_ball_count(0, 1.0, method=method)
    seconds = ctrl_c(lambda: without_end(index, method))
    print(f"{method}: KeyboardInterrupt after {1000 * seconds:.0f} ms")
    assert index.query_ball_count(0, 1.0, method=method) == before


def test_ctrl_c_in_a_build(ctrl_c):
    seconds = ctrl_c(builds_without_end)
    print(f"build: KeyboardInterrupt after {1000 * seconds:.0f} ms")


def told(call):
    calls = []
    call(lambda done, total: calls.append((done, total)))
    assert calls[0][0] == 0
    assert calls == sorted(calls)
    assert len({total for _, total in calls}) == 1
    assert calls[-1][0] == calls[-1][1]


@pytest.mark.parametrize("method", ("exact", "paper", "bfs", "ball"))
def test_progress_of_a_batch(index, method):
    told(lambda watch: index.query_ball(range(100), 3.0, method=method, progress=watch))
    told(lambda watch: index.query_ball_count(range(100), 3.0, method=method, progress=watch))


def test_progress_of_a_build():
    told(lambda watch: meshhood.MeshIndex(*meshes.two_plates(20), progress=watch))


@pytest.mark.parametrize("method", ("exact", "paper", "bfs", "ball"))
def test_what_progress_raises_ends_the_call(index, method):
    def enough(done, total):
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        index.query_ball(None, 1.0, method=method, progress=enough)
    with pytest.raises(LookupError, match="enough"):
        meshhood.MeshIndex(*meshes.two_plates(20), progress=enough)
    assert index.query_ball_count(0, 0.0, method=method) == 1


def test_progress_bar(index, capsys):
    pytest.importorskip("tqdm")
    index.query_ball(range(100), 1.0, progress=True)
    assert "100" in capsys.readouterr().err


def test_others_run_during_a_batch(index):
    """Another thread hands over to this one while the batch runs, which it could not if the batch held the lock."""
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
