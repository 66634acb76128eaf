# SPDX-License-Identifier: MIT
import signal

import meshes
import meshhood
import pytest

# A process that is started in the background ignores Ctrl-C, and Python then installs no handler of its own.
signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(params=(meshes.two_plates, meshes.folded), ids=("plates", "folded"))
def mesh(request):
    """A mesh whose parts nearly touch, and its index."""
    V, F = request.param(12)
    return V, F, meshhood.MeshIndex(V, F)
