# SPDX-License-Identifier: MIT
"""What the package says about itself."""
import re

import meshhood


def test_show_config_names_the_version_and_the_kernels(capsys):
    meshhood.show_config()
    printed = capsys.readouterr().out
    assert re.fullmatch(rf"meshhood {re.escape(meshhood.__version__)}, kernels for [A-Z0-9_]+\n", printed)
