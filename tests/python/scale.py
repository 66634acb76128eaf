# SPDX-License-Identifier: MIT
"""The length of long tests."""

import os


def scaled(count, least=1):
    """`count` times $MESHHOOD_TEST_SCALE (default 1), at least `least`, as in the tests of C++."""
    return max(least, round(count * float(os.environ.get("MESHHOOD_TEST_SCALE", "1"))))
