#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The program `meshhood` of a wheel, whose commands are in the module of the package."""

import os
import sys
from importlib.util import find_spec, module_from_spec

# The package itself is only run to read a file, because it imports NumPy, which takes many times as long as all else here.
package = find_spec("meshhood")
sys.modules["meshhood"] = module_from_spec(package)
from meshhood import _core  # noqa: E402


def read_other(file):
    package.loader.exec_module(sys.modules["meshhood"])
    from meshhood._other_files import as_ply

    return as_ply(os.fsdecode(file))


page = os.path.join(os.path.dirname(_core.__file__), "viewer.html")
if not os.environ.get("MESHHOOD_VIEWER") and os.path.exists(page):
    os.environ["MESHHOOD_VIEWER"] = page
# Standard output is closed: there is nothing that Python still has to do.
os._exit(_core.run_command([os.fsencode(argument) for argument in sys.argv[1:]], read_other))
