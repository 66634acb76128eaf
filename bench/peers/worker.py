# SPDX-License-Identifier: MIT
"""The process of one peer: builds it, then answers and times blocks of queries as it is told to."""
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
    """A peer in a process of its own, so that threads can be held to one processor and memory be told apart."""

    def __init__(self, name, mesh, threads):
        """mesh: the path of its arrays, see mesh_files.py."""
        context = multiprocessing.get_context("spawn")
        self.pipe, theirs = context.Pipe()
        self.process = context.Process(target=serve, args=(name, mesh, threads, theirs), daemon=True)
        with one_processor() if threads == ONE_THREAD else contextlib.nullcontext():
            self.process.start()
        theirs.close()

    def ask(self, command, *arguments, timeout):
        """What the command returns. Raises RuntimeError where it fails, ends the process or takes too long."""
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
            raise RuntimeError("its process has ended, as where memory runs out") from None
        if kind == "error":
            raise RuntimeError(value)
        return value

    def end(self, patience=5):
        """Lets it end by itself, if it does."""
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
    except Exception as error:  # whatever a foreign library raises is told, not raised
        traceback.print_exc()
        pipe.send(("error", f"{type(error).__name__}: {error}".splitlines()[0]))
    finally:
        if peer is not None:
            peer.end()


@contextlib.contextmanager
def one_processor():
    """What is started meanwhile has but one, so that no library starts more threads than it should."""
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
    """Seconds for all of `vertices`: as the program says that answers them, else by the clock around the call."""
    return asked(peer, vertices, radius)[0]


def judged(peer, vertices, radius):
    """The seconds, and the answers as lists of ids, or None where there is nothing to compare."""
    seconds, answer = asked(peer, vertices, radius)
    rows = peer.rows(answer, vertices)
    return seconds, None if rows is None else [list(map(int, row)) for row in rows]


def asked(peer, vertices, radius):
    begin = time.perf_counter()
    answer = peer.ask(vertices, radius)
    return getattr(peer, "seconds", time.perf_counter() - begin), answer


def resident_bytes():
    """Of this process and its children, after what is free has been given back."""
    gc.collect()
    ctypes.CDLL(None).malloc_trim(0)
    children = open(f"/proc/self/task/{os.getpid()}/children", encoding="ascii").read().split()
    return sum(resident_pages(process) for process in ["self", *children]) * os.sysconf("SC_PAGE_SIZE")


def resident_pages(process):
    with open(f"/proc/{process}/statm", encoding="ascii") as numbers:
        return int(numbers.read().split()[1])
