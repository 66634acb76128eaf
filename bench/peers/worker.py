# SPDX-License-Identifier: MIT
"""The process of one library: builds it, then answers and times blocks of queries on command."""
import contextlib
import ctypes
import gc
import importlib
import multiprocessing
import os
import time
import traceback

ONE_THREAD = 1
ALL_THREADS = -1


class Worker:
    """A library in a process of its own, so that its threads can be bound to one processor and its memory measured."""

    def __init__(self, name, mesh, threads):
        """mesh: the path of its arrays, see mesh_files.py."""
        context = multiprocessing.get_context("spawn")
        self.pipe, theirs = context.Pipe()
        self.process = context.Process(target=serve, args=(name, mesh, threads, theirs), daemon=True)
        with one_processor() if threads == ONE_THREAD else contextlib.nullcontext():
            self.process.start()
        theirs.close()

    def call(self, command, *arguments, timeout):
        """The result of the command. Raises RuntimeError if the command fails, ends the process or takes too long."""
        try:
            self.pipe.send((command, *arguments))
            return self.result(timeout)
        except (BrokenPipeError, ConnectionResetError):
            raise RuntimeError("its process has ended") from None

    def result(self, timeout):
        if not self.pipe.poll(timeout):
            self.end(patience=0)
            raise RuntimeError(f"took longer than {timeout:.0f} s")
        try:
            kind, value = self.pipe.recv()
        except EOFError:
            raise RuntimeError("its process has ended, perhaps because memory ran out") from None
        if kind == "error":
            raise RuntimeError(value)
        return value

    def end(self, patience=5):
        """Waits for the process to end by itself, then kills it."""
        self.pipe.close()
        self.process.join(patience)
        self.process.kill()
        self.process.join()


def serve(name, mesh, threads, pipe):
    peer = None
    try:
        peer, built = build(name, mesh, threads)
        pipe.send(("ok", built))
        commands = {"time": timed, "judge": judged}
        while True:
            command, *arguments = pipe.recv()
            pipe.send(("ok", commands[command](peer, *arguments)))
    except EOFError:
        pass
    except Exception as error:  # any exception of the library is reported, not raised
        traceback.print_exc()
        pipe.send(("error", f"{type(error).__name__}: {error}".splitlines()[0]))
    finally:
        if peer is not None:
            peer.end()


@contextlib.contextmanager
def one_processor():
    """Processes started meanwhile have one processor, so that no library starts more threads."""
    mine = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {min(mine)})
    try:
        yield
    finally:
        os.sched_setaffinity(0, mine)


def build(name, mesh, threads):
    from . import PEERS, mesh_files

    mesh = mesh_files.load(mesh)
    kind = PEERS[name]
    if kind.module:
        importlib.import_module(kind.module)
    before, begin = resident_bytes(), time.perf_counter()
    peer = kind(mesh, threads)
    seconds = getattr(peer, "build_seconds", time.perf_counter() - begin)
    return peer, {"build_seconds": seconds, "bytes": resident_bytes() - before, "version": peer.version()}


def timed(peer, vertices, radius):
    """Seconds for all of `vertices`: as measured by the program that answers them, otherwise by the clock around the
    call."""
    return run_timed(peer, vertices, radius)[0]


def judged(peer, vertices, radius):
    """The seconds, and the answers as lists of ids, or None if there are no ids to compare."""
    seconds, answer = run_timed(peer, vertices, radius)
    rows = peer.rows(answer, vertices)
    return seconds, None if rows is None else [list(map(int, row)) for row in rows]


def run_timed(peer, vertices, radius):
    begin = time.perf_counter()
    answer = peer.query(vertices, radius)
    return getattr(peer, "seconds", time.perf_counter() - begin), answer


def resident_bytes():
    """The memory of this process and its children, after free memory has been returned to the system."""
    gc.collect()
    ctypes.CDLL(None).malloc_trim(0)
    children = open(f"/proc/self/task/{os.getpid()}/children", encoding="ascii").read().split()
    return sum(resident_pages(process) for process in ["self", *children]) * os.sysconf("SC_PAGE_SIZE")


def resident_pages(process):
    with open(f"/proc/{process}/statm", encoding="ascii") as numbers:
        return int(numbers.read().split()[1])
