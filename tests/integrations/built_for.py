# SPDX-License-Identifier: MIT
"""Whether the package under test can be loaded by the Python of another program."""

import importlib.machinery
import importlib.util
import sys
from pathlib import Path


def skip_unless_loadable() -> None:
    """Skips the test (77) where the package on the path was built for another Python than this one."""
    found = importlib.util.find_spec("meshhood")
    assert found is not None and found.origin is not None, "meshhood is not on PYTHONPATH"
    package = Path(found.origin).parent
    if not any((package / f"_core{suffix}").exists() for suffix in importlib.machinery.EXTENSION_SUFFIXES):
        print(f"skipped: {package} is not built for Python {sys.version_info[0]}.{sys.version_info[1]} of this program")
        sys.exit(77)
