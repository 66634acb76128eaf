# SPDX-License-Identifier: MIT
"""How much memory this process may still take."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

try:
    import resource
except ImportError:  # Windows
    resource = None  # type: ignore[assignment]

_UNLIMITED = 2**64 - 1
_CGROUPS = Path("/sys/fs/cgroup")


def free_bytes() -> int:
    """The memory that this process may still take: the least of what the machine has free, what the limits of its
    control groups leave, and what the limit of its address space leaves."""
    return max(0, min([_UNLIMITED, *_of_machine(), *_of_control_groups(), *_of_address_space()]))


def _of_machine() -> Iterator[int]:
    try:
        for line in Path("/proc/meminfo").read_text(encoding="ascii").splitlines():
            name, value, *_ = line.split()
            if name == "MemAvailable:":
                yield 1024 * int(value)
                return
    except (OSError, ValueError):
        pass
    if hasattr(os, "sysconf"):
        yield os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")


def _of_control_groups() -> Iterator[int]:
    """Of each group from that of this process to the root. Pages of files that have not been used lately are free."""
    try:
        lines = Path("/proc/self/cgroup").read_text(encoding="utf-8").splitlines()
    except OSError:
        return
    for line in lines:
        _, controllers, name = line.split(":", 2)
        if controllers == "":
            yield from _left(_CGROUPS, name, "memory.max", "memory.current", "inactive_file")
        elif "memory" in controllers.split(","):
            names = "memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"
            yield from _left(_CGROUPS / "memory", name, *names)


def _left(root: Path, name: str, limit: str, usage: str, reclaimable: str) -> Iterator[int]:
    group = root / name.lstrip("/")
    for folder in (group, *group.parents):
        try:
            most = (folder / limit).read_text(encoding="ascii").strip()
            if most != "max":
                lines = (folder / "memory.stat").read_text(encoding="ascii").splitlines()
                free = int(dict(line.split() for line in lines).get(reclaimable, 0))
                yield int(most) - int((folder / usage).read_text(encoding="ascii")) + free
        except (OSError, ValueError):  # the root group has no limits, and in a container other groups are not visible
            pass
        if folder == root:
            return


def _of_address_space() -> Iterator[int]:
    if resource is None:
        return
    limit = resource.getrlimit(resource.RLIMIT_AS)[0]
    if limit == resource.RLIM_INFINITY:
        return
    try:
        pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
    except (OSError, ValueError):
        pages = 0
    yield limit - pages * resource.getpagesize()
