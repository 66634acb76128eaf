# SPDX-License-Identifier: MIT
"""A process of its own for a library that is measured: its threads can be bound to processors, its memory measured, and
it can be stopped if it takes too long."""
import contextlib
import multiprocessing
import os
import traceback


class Worker:
    """An object in another process: `make(*arguments)`. The first result is its attribute `started`; at the end, its
    method `end` is called."""

    def __init__(self, make, *arguments, processors=None):
        """make: found by its name in its module. processors: how many the process may use; None for all."""
        context = multiprocessing.get_context("spawn")
        self.pipe, theirs = context.Pipe()
        self.process = context.Process(target=serve, args=(make, arguments, theirs), daemon=True)
        with bound_to(processors):
            self.process.start()
        theirs.close()

    def call(self, method, *arguments, timeout):
        """What the method of the object returns. Raises RuntimeError if it fails, ends the process or takes too long."""
        try:
            self.pipe.send((method, *arguments))
            return self.result(timeout)
        except (BrokenPipeError, ConnectionResetError):
            raise RuntimeError("its process has ended") from None

    def result(self, timeout):
        """The next result. Raises as `call`."""
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


def serve(make, arguments, pipe):
    served = None
    try:
        served = make(*arguments)
        pipe.send(("ok", served.started))
        while True:
            method, *arguments = pipe.recv()
            pipe.send(("ok", getattr(served, method)(*arguments)))
    except EOFError:
        pass
    except Exception as error:  # any exception of the library is reported, not raised
        traceback.print_exc()
        pipe.send(("error", f"{type(error).__name__}: {error}".splitlines()[0]))
    finally:
        if served is not None:
            served.end()


@contextlib.contextmanager
def bound_to(processors):
    """Processes started meanwhile have this number of processors, so that no library starts more threads."""
    mine = os.sched_getaffinity(0)
    os.sched_setaffinity(0, sorted(mine)[:processors])
    try:
        yield
    finally:
        os.sched_setaffinity(0, mine)
