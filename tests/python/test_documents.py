# SPDX-License-Identifier: MIT
"""The Python code of the documents runs unchanged, on files with the names used there."""

import re
from pathlib import Path

import meshhood
import pytest

ROOT = Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"```python\n(.*?)```", re.DOTALL)
FOLDERS = [ROOT / "docs/readers", ROOT / "docs/coming_from"]
PAGES = ["README.md", "docs/curvature.md", "docs/index.md", "docs/python.md", "docs/queries.md"]
PAGES += sorted(str(page.relative_to(ROOT)) for folder in FOLDERS for page in folder.glob("*.md"))

@pytest.mark.parametrize("name", PAGES)
def test_code_runs(name, tmp_path, monkeypatch):
    blocks = BLOCK.findall((ROOT / name).read_text(encoding="utf-8"))
    if not blocks:
        pytest.skip("has no code in Python")
    pytest.importorskip("trimesh").creation.icosphere(subdivisions=3).export(tmp_path / "hand.ply")
    monkeypatch.chdir(tmp_path)
    names = {}
    for block in blocks:
        exec(compile(block, name, "exec"), names)
    print(f"{name}: {len(blocks)} pieces of code")
    assert isinstance(names["index"], meshhood.MeshIndex)


def test_everything_public_is_described():
    for name in set(meshhood.__all__) - {"__version__"}:
        thing = getattr(meshhood, name)
        assert thing.__doc__
        public = [part for part in vars(thing) if callable(getattr(thing, part)) and not part.startswith("_")]
        for part in public if thing.__module__ == "meshhood._index" else []:
            assert getattr(thing, part).__doc__, f"{name}.{part}"
