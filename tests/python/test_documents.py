# SPDX-License-Identifier: MIT
"""The Python code of the documents runs unchanged, on files with the names used there."""

import re
from pathlib import Path

import meshhood
import pytest

ROOT = Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"```python\n(.*?)```", re.DOTALL)
FOLDERS = [ROOT / "docs/readers", ROOT / "docs/coming_from"]
PAGES = ["README.md"]
PAGES += [f"docs/{name}.md" for name in ("aggregate", "curvature", "index", "python", "queries", "web")]
PAGES += sorted(str(page.relative_to(ROOT)) for folder in FOLDERS for page in folder.glob("*.md"))

@pytest.mark.parametrize("name", PAGES)
def test_code_runs(name, tmp_path, monkeypatch):
    blocks = BLOCK.findall((ROOT / name).read_text(encoding="utf-8"))
    if not blocks:
        pytest.skip("has no code in Python")
    if "meshhood.view(" in "".join(blocks) and not Path(meshhood.__file__).with_name("viewer.html").exists():
        pytest.skip("the page of the viewer was not built")
    pytest.importorskip("trimesh").creation.icosphere(subdivisions=3).export(tmp_path / "hand.ply")
    monkeypatch.chdir(tmp_path)
    names = {}
    for block in blocks:
        exec(compile(block, name, "exec"), names)
    print(f"{name}: {len(blocks)} pieces of code")
    assert names["meshhood"] is meshhood


def test_everything_public_is_described():
    for name in set(meshhood.__all__) - {"__version__"}:
        thing = getattr(meshhood, name)
        assert thing.__doc__
        public = [part for part in vars(thing) if callable(getattr(thing, part)) and not part.startswith("_")]
        for part in public if thing.__module__ == "meshhood._index" else []:
            assert getattr(thing, part).__doc__, f"{name}.{part}"
