# SPDX-License-Identifier: MIT
"""The long description of the Python package, for scikit-build-core: README.md without what a page of PyPI cannot show,
pictures with their captions, and links to other files of the repository, of which the text stays."""

import re
from pathlib import Path

PICTURE = re.compile(r"^(<img .*>|!\[.*\]\(.*\))\n\n(\*[^*]+\*\n\n)?", re.MULTILINE)
FILE_LINK = re.compile(r"\[([^]]+)\]\((?!https?:|#)[^)]*\)")


def dynamic_metadata(settings, project):
    text = PICTURE.sub("", Path("README.md").read_text(encoding="utf-8"))
    return {"readme": {"content-type": "text/markdown", "text": FILE_LINK.sub(r"\1", text)}}
