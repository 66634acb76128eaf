# SPDX-License-Identifier: MIT
"""The memory of a call, from the counters of Linux. As a program, that of two equal calls of all vertices, at 5 mean
edges and at 16 radii up to that, in bytes a vertex beyond the mesh and the index, each pair in a process of its own. The
first of them makes what the index keeps for patches:

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


def two_calls(path, call, options, radii):
    import meshhood

    index = meshhood.MeshIndex(*meshhood.read_mesh(path))
    scales = [5 * index.mean_edge_length * (i + 1) / radii for i in range(radii)]
    return [peak_of(lambda: getattr(index, call)(scales=scales, **options)) / len(index) for _ in range(2)]


KINDS = (("moments", {"degree": 2}), ("moments", {"degree": 4}), ("invariants", {}), ("gaps", {}))
CALLS = [(*kind, radii) for kind in KINDS for radii in (1, 16)]

if __name__ == "__main__" and sys.argv[1] != "--one":
    for file in sys.argv[1:]:
        for number in range(len(CALLS)):
            subprocess.run([sys.executable, __file__, "--one", file, str(number)], check=True)
elif __name__ == "__main__":
    name, given, radii = CALLS[int(sys.argv[3])]
    first, second = two_calls(sys.argv[2], name, given, radii)
    print(f"{Path(sys.argv[2]).name}, {name} {given or ''}, {radii} radii: {first:.0f}, {second:.0f} bytes a vertex")
