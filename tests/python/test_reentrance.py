# SPDX-License-Identifier: MIT
"""Calls within calls, and forks during calls: by signal handlers, progress functions, finalizers and other threads."""

import multiprocessing
import os
import signal
import threading

import meshes
import meshhood
import numpy as np
import programs
import pytest

METHODS = ("exact", "paper", "bfs", "ball")
# Calls that sum over neighborhoods. Each gives one array.
SUMS = {
    "aggregate": "index.aggregate(index.positions, 2.5, workers=2)",
    "curvature": "index.curvature(2.5, F=F, workers=2).k1",
}
COUNTS = [f"index.counts(3.0, range(20), method={method!r}, workers=2)" for method in METHODS]


def run(program):
    programs.run(program, seconds=120)


@pytest.mark.parametrize("made", ("paper", "bfs"))
@pytest.mark.parametrize("other", METHODS)
def test_a_signal_handler_may_use_any_method_while_its_thread_makes_one(made, other):
    """The signal arrives while the main thread holds the lock under which a method is made."""
    run(f"""
from meshhood import _core
index = meshhood.MeshIndex(*meshes.two_plates(30))
answers = []
signal.signal(signal.SIGUSR1, lambda number, frame: answers.append(index.count(0, 2.0, method={other!r})))
graph = _core.graph
def interrupted(exact):
    _core.graph = graph
    os.kill(os.getpid(), signal.SIGUSR1)
    return graph(exact)
_core.graph = interrupted
index.neighborhood(0, 2.0, method={made!r})
assert len(answers) == 1 and answers[0] == index.count(0, 2.0, method={other!r})
""")


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")
@pytest.mark.parametrize("other", METHODS)
def test_a_fork_while_another_thread_makes_a_method_leaves_a_child_that_works(other):
    """The fork happens while another thread holds the lock, which the child's copy of the index must not wait for."""
    run(f"""
from meshhood import _core
index = meshhood.MeshIndex(*meshes.two_plates(30))
making, forked = threading.Event(), threading.Event()
graph = _core.graph
def slow(exact):
    making.set()
    forked.wait()
    return graph(exact)
_core.graph = slow
thread = threading.Thread(target=lambda: index.neighborhood(0, 2.0, method="paper"))
thread.start()
making.wait()
child = os.fork()
if child == 0:
    _core.graph = graph
    os._exit(0 if index.count(0, 2.0, method={other!r}) > 3 else 1)
forked.set()
thread.join()
assert os.waitpid(child, 0)[1] == 0
""")


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")
@pytest.mark.parametrize(
    "call",
    [
        "index.counts(3.0, workers=3, progress=progress)",
        "index.neighborhoods(3.0, workers=3, progress=progress)",
        "index.curvature(3.0, workers=3, progress=progress)",
        "meshhood.MeshIndex(*meshes.two_plates(60), workers=3, progress=progress)",
    ],
)
def test_a_progress_function_that_forks_ends_the_call_in_the_child_alone(call):
    """The threads of the call are the parent's: the child must not wait for them."""
    run(f"""
index = meshhood.MeshIndex(*meshes.two_plates(60))
children = []
def progress(done, total):
    if done > 0 and 0 not in children and len(children) < 3:
        children.append(os.fork())
        if children[-1] == 0:
            signal.alarm(60)
try:
    {call}
    ended = True
except KeyboardInterrupt:
    ended = False
if 0 in children:
    index.counts(2.0, workers=2)  # another call starts threads of its own
    os._exit(0)
assert ended and children
for child in children:
    assert os.waitpid(child, 0)[1] == 0
""")


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")
@pytest.mark.parametrize("call", [*SUMS.values(), *COUNTS])
def test_a_fork_at_any_moment_of_other_threads_leaves_a_child_that_works(call):
    run(f"""
V, F = meshes.two_plates(20)
index = meshhood.MeshIndex(V, F)
wanted = {call}
stop = threading.Event()
def run_query():
    while not stop.is_set():
        {call}
threads = [threading.Thread(target=run_query) for _ in range(3)]
for thread in threads:
    thread.start()
for _ in range(50):
    child = os.fork()
    if child == 0:
        os._exit(0 if ({call} == wanted).all() else 1)
    assert os.waitpid(child, 0)[1] == 0
stop.set()
for thread in threads:
    thread.join()
""")


@pytest.mark.parametrize("call", SUMS)
def test_a_progress_function_may_sum_over_neighborhoods_of_the_same_index(call):
    V, F = meshes.two_plates(12)
    index = meshhood.MeshIndex(V, F)
    wanted, inner = eval(SUMS[call]), []
    got = index.neighborhoods(2.5, progress=lambda done, total: inner.append(eval(SUMS[call], {"index": index, "F": F})))
    assert len(got[0]) == len(V) + 1
    assert len(inner) >= 2
    for answer in inner:
        np.testing.assert_array_equal(answer, wanted)


@pytest.mark.parametrize("method", METHODS)
def test_a_progress_function_may_query_the_same_index(method):
    index = meshhood.MeshIndex(*meshes.two_plates(12))
    wanted = index.neighborhoods(2.5, method=method)
    inner = []

    def query(done, total):
        for other in METHODS:
            inner.append(index.neighborhoods(2.5, method=other)[1] if other == method else 0)
            index.neighborhood(3, 2.5, method=other)

    got = index.neighborhoods(2.5, method=method, progress=query)
    np.testing.assert_array_equal(got[1], wanted[1])
    assert sum(isinstance(answer, np.ndarray) for answer in inner) >= 2
    for answer in inner:
        if isinstance(answer, np.ndarray):
            np.testing.assert_array_equal(answer, wanted[1])


def test_a_progress_function_may_build_save_and_load(tmp_path):
    V, F = meshes.two_plates(10)
    index = meshhood.MeshIndex(V, F)
    count = []

    def work(done, total):
        other = meshhood.MeshIndex(V, F)
        other.save(tmp_path / "inner")
        count.append(len(meshhood.load(tmp_path / "inner")))

    meshhood.MeshIndex(V, F, progress=work)
    index.save(tmp_path / "outer", progress=work)
    meshhood.load(tmp_path / "outer", progress=work)
    assert set(count) == {len(V)}
    assert (tmp_path / "inner").read_bytes() == (tmp_path / "outer").read_bytes()


def test_threads_that_make_the_same_method_make_it_once():
    index = meshhood.MeshIndex(*meshes.two_plates(20))
    start = threading.Barrier(4)
    made = []

    def run_query():
        start.wait()
        index.neighborhood(0, 1.0, method="paper")
        made.append(index._methods["paper"])

    threads = [threading.Thread(target=run_query) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len({id(method) for method in made}) == 1


def test_a_signal_during_a_batch_may_query(tmp_path):
    if threading.current_thread() is not threading.main_thread():
        pytest.skip("signals reach only the main thread")
    index = meshhood.MeshIndex(*meshes.two_plates(30))
    answers = []
    old = signal.signal(signal.SIGUSR1, lambda number, frame: answers.append(index.count(0, 2.0, method="bfs")))
    try:
        index.neighborhoods(3.0, progress=lambda done, total: signal.raise_signal(signal.SIGUSR1))
    finally:
        signal.signal(signal.SIGUSR1, old)
    assert len(answers) >= 2
    assert set(answers) == {index.count(0, 2.0)}


def test_a_child_that_was_forked_by_multiprocessing_may_make_every_method():
    if "fork" not in multiprocessing.get_all_start_methods():
        pytest.skip("no fork here")
    run("""
import multiprocessing
index = meshhood.MeshIndex(*meshes.two_plates(12))
def count(method):
    return index.counts(2.0, method=method).sum()
with multiprocessing.get_context("fork").Pool(2) as pool:
    counts = pool.map(count, ["exact", "paper", "bfs", "ball"])
assert counts[0] == counts[2] <= counts[1] <= counts[3]
""")


def test_a_child_that_was_forked_during_a_call_into_a_folder_does_not_keep_its_lock(tmp_path):
    run(f"""
from meshhood._result_files import result_folder
with result_folder({str(tmp_path)!r}, {{}}):
    child = os.fork()
    if child == 0:
        signal.pause()
try:
    with result_folder({str(tmp_path)!r}, {{}}):
        pass
finally:
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
""")
