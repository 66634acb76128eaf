# SPDX-License-Identifier: MIT
"""The parts of the harness that need Python packages, on a small shape; tests/repo/bench_test.py has the others."""

import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from bench import curvature, machine, pictures, places, results  # noqa: E402: from the checkout
from bench.arrays import contest as arrays  # noqa: E402
from bench.peers import contest  # noqa: E402
from bench.sections import arrays as array_tables, curvature_growth, peers as peer_tables  # noqa: E402


@pytest.fixture
def elsewhere(monkeypatch, tmp_path):
    for program in (places.MESHHOOD, places.PROGRAMS / "race", places.PROGRAMS / "native_peers"):
        if not program.is_file():
            pytest.skip(f"no {program}")
    monkeypatch.setattr(places, "RESULTS", tmp_path)
    monkeypatch.setattr(places, "PAGES", tmp_path)
    monkeypatch.setattr(places, "SCRATCH", tmp_path)
    monkeypatch.setattr(machine, "WAITED", 0.1)


PEERS = (
    "meshhood, one call",
    "meshhood, a call for each",
    "our breadth-first search (C++)",
    "scipy cKDTree, then connected_components",
    "scipy cKDTree",
    "Open3D fixed_radius_search",
)


def test_peers(elsewhere, monkeypatch):
    monkeypatch.setattr(contest, "PEERS", PEERS)
    monkeypatch.setattr(contest, "RUNS", (("shuffled", contest.ONE_THREAD),))
    contest.run(["tiny"], block_seconds=0.01)
    data = results.load("peers")
    near, far = ({peer["name"]: peer for peer in part["peers"]} for part in data["contests"])
    for rows in (near, far):
        for name in PEERS[:4]:
            assert (rows[name]["extra"], rows[name]["missing"]) == (0, 0)
            assert rows[name]["microseconds"]["median"] > 0
    assert far["scipy cKDTree"]["extra"] > 0
    assert far["scipy cKDTree"]["missing"] == 0
    assert "failure" in far["Open3D fixed_radius_search"] or far["Open3D fixed_radius_search"]["missing"] == 0
    assert "| answers | tiny, 5 | tiny, 20 |" in peer_tables.times(data)


def test_arrays(elsewhere, monkeypatch):
    names = ("meshhood", "our breadth-first search (C++)", "meshhood rings", "SciPy power of the sparse matrix")
    if not (places.PROGRAMS / "breadth_first").is_file():
        pytest.skip("no breadth_first")
    monkeypatch.setattr(arrays, "TOOLS", {name: arrays.TOOLS[name] for name in names})
    monkeypatch.setattr(arrays, "ENOUGH_SECONDS", 0.01)
    for edges in (3, 4):  # results are added to those of before
        arrays.run(["tiny"], [edges], [2])
    data = results.load("arrays")
    assert list(data["pieces"]) == ["tiny, 2, 3", "tiny, 2, 4"]
    for question in ("counts", "ids"):
        rows = data["pieces"]["tiny, 2, 3"]["questions"][question]
        assert rows[names[0]]["found"] == pytest.approx(rows[names[1]]["found"])
        listed = data["pieces"]["tiny, 2, 3"]["questions"]["ids"]
        assert rows[names[2]]["found"] == pytest.approx(listed[names[3]]["found"])
        assert all(row["seconds"]["median"] > 0 for row in rows.values())
    assert [line[:12] for line in array_tables.times(data).splitlines()[2:]] == ["| tiny | 3 |", "| tiny | 4 |"]


def test_growth(elsewhere, monkeypatch):
    monkeypatch.setattr(curvature, "SIZES", (500,))
    monkeypatch.setattr(curvature, "LIBIGL_SIZE", 0)
    curvature.run_growth(500)
    data = results.load("curvature_growth")
    assert data["rows"][0]["ours"] > 0
    assert curvature_growth.growth(data).splitlines()[2].startswith("| 5")


def test_pictures(elsewhere, monkeypatch):
    pyvista = pytest.importorskip("pyvista")
    above = pictures.Picture("z", "tiny", 20, (0.5, 0.5, 0.5), (0, 0, 1), (0, 1, 0))
    monkeypatch.setattr(pictures, "PICTURES", (above,))
    pictures.run(None)
    found = results.load("figure4")["pictures"][0]["found"]
    assert 1 < found["exact"] <= found["paper"] <= found["ball"]
    colors = pyvista.read(places.RESULTS / "figure4z.png").active_scalars[:, :3].astype(int)
    red = (colors[:, 0] > 150) & (colors[:, 1:] < 80).all(axis=1)
    print(f"{red.sum()} red of {len(colors)} pixels")
    assert red.sum() > 50
