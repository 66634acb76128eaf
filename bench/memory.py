# SPDX-License-Identifier: MIT
"""The memory of a call, from the counters of Linux. As a program, that of the first call of all vertices at 5 mean edges,
in bytes a vertex beyond the mesh and the index, each call in a process of its own:

    PYTHONPATH=PACKAGE python3 bench/memory.py MESH...
"""

import ctypes
import gc
import re
import subprocess
import sys
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


def first_call(path, call, options):
    import meshhood

    index = meshhood.MeshIndex(*meshhood.read_mesh(path))
    radius = 5 * index.mean_edge_length
    return peak_of(lambda: getattr(index, call)(radius, **options)) / len(index)


CALLS = (("moments", {"degree": 2}), ("moments", {"degree": 4}), ("invariants", {}), ("gaps", {}))

if __name__ == "__main__" and sys.argv[1] != "--one":
    for file in sys.argv[1:]:
        for number in range(len(CALLS)):
            subprocess.run([sys.executable, __file__, "--one", file, str(number)], check=True)
elif __name__ == "__main__":
    name, given = CALLS[int(sys.argv[3])]
    print(f"{Path(sys.argv[2]).name}, {name} {given or ''}: {first_call(sys.argv[2], name, given):.0f} bytes a vertex")
