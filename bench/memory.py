# SPDX-License-Identifier: MIT
"""The memory of a call, from the counters of Linux."""
import ctypes
import gc
import re
from pathlib import Path

PROCESS = Path("/proc/self")


def peak_of(work):
    """The most bytes that this process has held during `work()`, beyond those before. Memory that the allocator has kept
    is given back first, since the call would use it again."""
    gc.collect()
    ctypes.CDLL(None).malloc_trim(0)
    before = status("VmRSS")
    (PROCESS / "clear_refs").write_text("5", encoding="ascii")  # VmHWM begins again
    work()
    return max(0, status("VmHWM") - before)


def status(name):
    text = (PROCESS / "status").read_text(encoding="ascii", errors="replace")
    return 1024 * int(re.search(rf"{name}:\s*(\d+) kB", text)[1])
