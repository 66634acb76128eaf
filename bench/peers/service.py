# SPDX-License-Identifier: MIT
"""One library in the process of its worker: built at the start, then queried in blocks."""
import ctypes
import gc
import importlib
import os
import time

ONE_THREAD = 1
ALL_THREADS = -1


class Service:
    def __init__(self, name, mesh, threads):
        """mesh: the path of its arrays, see mesh_files.py."""
        from . import PEERS, mesh_files

        mesh = mesh_files.load(mesh)
        kind = PEERS[name]
        if kind.module:
            importlib.import_module(kind.module)
        before, begin = resident_bytes(), time.perf_counter()
        self.peer = kind(mesh, threads)
        seconds = getattr(self.peer, "build_seconds", time.perf_counter() - begin)
        self.started = {"build_seconds": seconds, "bytes": resident_bytes() - before, "version": self.peer.version()}

    def time(self, vertices, radius):
        """Seconds for all of `vertices`: as measured by the program that answers them, otherwise by the clock around the
        call."""
        return self.run(vertices, radius)[0]

    def judge(self, vertices, radius):
        """The seconds, and the answers as lists of ids, or None if there are no ids to compare."""
        seconds, answer = self.run(vertices, radius)
        rows = self.peer.rows(answer, vertices)
        return seconds, None if rows is None else [list(map(int, row)) for row in rows]

    def run(self, vertices, radius):
        begin = time.perf_counter()
        answer = self.peer.query(vertices, radius)
        return getattr(self.peer, "seconds", time.perf_counter() - begin), answer

    def end(self):
        self.peer.end()


def resident_bytes():
    """The memory of this process and its children, after free memory has been returned to the system."""
    gc.collect()
    ctypes.CDLL(None).malloc_trim(0)
    children = open(f"/proc/self/task/{os.getpid()}/children", encoding="ascii").read().split()
    return sum(resident_pages(process) for process in ["self", *children]) * os.sysconf("SC_PAGE_SIZE")


def resident_pages(process):
    with open(f"/proc/{process}/statm", encoding="ascii") as numbers:
        return int(numbers.read().split()[1])
