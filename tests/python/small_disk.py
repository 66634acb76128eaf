# SPDX-License-Identifier: MIT
"""A small file system in memory, for one process that is started for it. Needs Linux; imported before NumPy, whose threads
forbid new name spaces."""

import ctypes
import os
import sys

_PAGE = 4096
_NEW_MOUNTS, _NEW_USER = 0x00020000, 0x10000000
_RECURSIVE, _PRIVATE, _REMOUNT = 16384, 1 << 18, 32

_libc = ctypes.CDLL(None, use_errno=True)


class SmallDisk:
    """Mounted on a folder, seen by this process alone."""

    def __init__(self, folder):
        self._folder = os.fsencode(folder)
        if not _enter_namespace() or _mount(b"none", b"/", None, _RECURSIVE | _PRIVATE, None) != 0:
            _skip()
        if _mount(b"none", self._folder, b"tmpfs", 0, b"size=64m") != 0:
            _skip()

    def leave_free(self, pages):
        """Limits the free space to `pages` of 4 KiB."""
        status = os.statvfs(self._folder)
        used = (status.f_blocks - status.f_bfree) * status.f_frsize
        size = b"size=%d" % (used + pages * _PAGE)
        if _mount(b"none", self._folder, b"tmpfs", _REMOUNT, size) != 0:
            raise OSError(ctypes.get_errno(), "cannot resize the disk")


def _mount(*arguments):
    return _libc.mount(*arguments)


def _enter_namespace():
    """Without the rights of root, a user namespace gives them if the system allows it."""
    user, group = os.getuid(), os.getgid()
    if _libc.unshare(_NEW_MOUNTS) == 0:
        return True
    if _libc.unshare(_NEW_USER | _NEW_MOUNTS) != 0:
        return False
    for name, text in (("setgroups", "deny"), ("uid_map", f"0 {user} 1"), ("gid_map", f"0 {group} 1")):
        with open(f"/proc/self/{name}", "w") as file:
            file.write(text)
    return True


def _skip():
    print("skipped: this process may not mount a file system")
    sys.exit(77)
