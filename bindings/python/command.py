#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The program `meshhood` of a wheel, whose commands are in the module of the package."""

import os
import sys
from importlib.util import find_spec, module_from_spec

# The package itself is not run, because it imports NumPy, which takes many times as long as all else here.
sys.modules["meshhood"] = module_from_spec(find_spec("meshhood"))
from meshhood import _core  # noqa: E402

page = os.path.join(os.path.dirname(_core.__file__), "viewer.html")
if not os.environ.get("MESHHOOD_VIEWER") and os.path.exists(page):
    os.environ["MESHHOOD_VIEWER"] = page
# Standard output is closed: there is nothing that Python still has to do.
os._exit(_core.run_command([os.fsencode(argument) for argument in sys.argv[1:]]))
