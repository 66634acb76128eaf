# SPDX-License-Identifier: MIT
"""How much memory this process may still take."""

from __future__ import annotations

import os
from collections.abc import Iterator

try:
    import resource
except ImportError:  # Windows
    resource = None  # type: ignore[assignment]

_UNLIMITED = 2**64 - 1
_CGROUPS = "/sys/fs/cgroup"


def free_bytes() -> int:
    """The memory that this process may still take: the least of what the machine has free, what the limits of its
    control groups leave, and what the limit of its address space leaves."""
    return max(0, min([_UNLIMITED, *_of_machine(), *_of_control_groups(), *_of_address_space()]))


def _read(path: str) -> str:
    """A file of the kernel. Without a Python file, which takes several times as long: each query of many vertices
    looks at the memory that is free."""
    file = os.open(path, os.O_RDONLY)
    try:
        return os.fsdecode(os.read(file, 1 << 16))  # names of control groups may have any bytes
    finally:
        os.close(file)


def _physical() -> int:
    pages = os.sysconf("SC_PHYS_PAGES") if hasattr(os, "sysconf") else -1
    return os.sysconf("SC_PAGE_SIZE") * pages if pages > 0 else _UNLIMITED


def _of_machine() -> Iterator[int]:
    try:
        _, found, rest = _read("/proc/meminfo").partition("MemAvailable:")
        if found:
            yield 1024 * int(rest.split(maxsplit=1)[0])
            return
    except (OSError, ValueError, IndexError):
        pass
    yield _physical()


def _of_control_groups() -> Iterator[int]:
    """Of each group from that of this process to the root. Pages of files that have not been used lately are free."""
    try:
        lines = _read("/proc/self/cgroup").split("\n")
    except OSError:
        return
    for line in lines:
        parts = line.split(":", 2)
        if len(parts) < 3:
            continue
        _, controllers, name = parts
        if controllers == "":
            yield from _left(_CGROUPS, name, "memory.max", "memory.current", "inactive_file")
        elif "memory" in controllers.split(","):
            names = "memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"
            yield from _left(_CGROUPS + "/memory", name, *names)


def _left(root: str, name: str, limit: str, usage: str, reclaimable: str) -> Iterator[int]:
    folder = root + name.rstrip("/")
    while folder == root or folder.startswith(root + "/"):
        try:
            most = _read(f"{folder}/{limit}").strip()
            if most != "max" and int(most) < _physical():  # control groups of version 1 have a huge limit for none
                free = dict(line.split() for line in _read(f"{folder}/memory.stat").splitlines()).get(reclaimable, 0)
                yield int(most) - int(_read(f"{folder}/{usage}")) + int(free)
        except (OSError, ValueError):  # the root group has no limits, and in a container other groups are not visible
            pass
        folder = os.path.dirname(folder)


def _of_address_space() -> Iterator[int]:
    if resource is None:
        return
    limit = resource.getrlimit(resource.RLIMIT_AS)[0]
    if limit == resource.RLIM_INFINITY:
        return
    try:
        pages = int(_read("/proc/self/statm").split()[0])
    except (OSError, ValueError):
        pages = 0
    yield limit - pages * resource.getpagesize()
