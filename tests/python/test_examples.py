# SPDX-License-Identifier: MIT
"""The Python programs of examples/, run as users run them."""

import resource
import subprocess
import sys
from pathlib import Path

import meshes
import meshhood
import numpy as np
import pytest

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
FOUR_GB = 4 << 30


def run(script, *arguments, memory=None):
    """Runs the program with a limit on the address space, and prints its output."""

    def limit():
        resource.setrlimit(resource.RLIMIT_AS, (memory, memory))

    done = subprocess.run(
        [sys.executable, EXAMPLES / script, *arguments],
        capture_output=True,
        text=True,
        check=False,
        preexec_fn=limit if memory else None,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    print(done.stdout, end="")
    return done.stdout


def test_smooth_signal():
    pytest.importorskip("trimesh")
    assert "10242 vertices" in run("smooth_signal.py")


def wall_of(surface, name):
    """Writes a map that is 1 on a wall, as a medial wall, and returns the mask."""
    V, F = meshhood.read_mesh(surface)
    wall = V[:, 0] > np.quantile(V[:, 0], 0.97)
    meshhood.write_mesh(name, V, F, values={"wall": wall})
    return wall


def test_smooth_cortex(tmp_path):
    nibabel = pytest.importorskip("nibabel")
    surface = meshes.shared("scan/cortex_left_41k.ply.zst", tmp_path)
    first, second = tmp_path / "once.shape.gii", tmp_path / "twice.shape.gii"
    run("smooth_cortex.py", surface, "-", "6", first)
    assert "40962 vertices" in run("smooth_cortex.py", surface, first, "6", second)
    once, twice = (nibabel.load(name).agg_data() for name in (first, second))
    assert twice.std() < once.std() < 0.5
    wall = wall_of(surface, tmp_path / "wall.shape.gii")
    run("smooth_cortex.py", surface, first, "6", second, tmp_path / "wall.shape.gii")
    np.testing.assert_array_equal(np.isnan(nibabel.load(second).agg_data()), wall)


def test_curvature_map(tmp_path):
    surface = meshes.shared("scan/cortex_left_41k.ply.zst", tmp_path)
    assert "40962 vertices, 40962 fitted" in run("curvature_map.py", surface, "5", tmp_path / "map.ply")
    assert (tmp_path / "map.ply").stat().st_size > 40962 * 15


def test_relief(tmp_path):
    assert "57600 vertices" in run("relief.py", tmp_path / "features.npz")


def test_searchlight(tmp_path):
    surface = meshes.shared("scan/cortex_left_41k.ply.zst", tmp_path)
    run("searchlight.py", surface)
    pytest.importorskip("nibabel")
    wall_of(surface, tmp_path / "wall.shape.gii")
    run("searchlight.py", surface, "8", tmp_path / "wall.shape.gii")


def test_scan_graph(tmp_path):
    scan = meshes.shared("paper/head_skin_1m.ply.zst", tmp_path)
    assert "1002496 vertices" in run("scan_graph.py", scan, memory=FOUR_GB)


SCRIPTS = {"scan_graph.py": ["2"], "searchlight.py": ["3"], "curvature_map.py": ["5", "colors.ply"]}


@pytest.mark.parametrize("script", SCRIPTS)
def test_a_scan_may_be_flat_have_polygons_and_vertices_without_a_position(script, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    x, y = (axis.ravel().astype(float) for axis in np.meshgrid(range(20), range(20), indexing="ij"))
    a = np.arange(400).reshape(20, 20)
    quads = np.stack([a[:-1, :-1], a[1:, :-1], a[1:, 1:], a[:-1, 1:]], axis=-1).reshape(-1, 4)
    V = np.vstack([np.column_stack([x, y, 0 * x]), np.full((1, 3), np.nan)])
    meshhood.write_mesh("scan.ply", V, (np.arange(0, 4 * len(quads) + 1, 4), quads.ravel()))
    run(script, "scan.ply", *SCRIPTS[script])
    if script == "curvature_map.py":
        assert Path("colors.ply").read_bytes().count(bytes([244, 243, 239])) == len(V)  # white


@pytest.mark.parametrize("script", SCRIPTS)
@pytest.mark.parametrize("count", [0, 5])
def test_a_wrong_number_of_arguments_shows_the_usage(script, count):
    command = [sys.executable, EXAMPLES / script, *["x"] * count]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 1 and f"    {script} " in done.stderr and "Traceback" not in done.stderr


def test_curvature_map_says_that_a_radius_is_too_small(tmp_path):
    surface = meshes.shared("scan/cortex_left_41k.ply.zst", tmp_path)
    command = [sys.executable, EXAMPLES / "curvature_map.py", surface, "0", tmp_path / "map.ply"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.stderr.startswith("EDGES: 0, expected a larger radius") and not (tmp_path / "map.ply").exists()


TASKS = sorted((EXAMPLES / "tasks").glob("*.py"))


@pytest.mark.parametrize("task", TASKS, ids=[task.stem for task in TASKS])
def test_a_task_is_a_program_of_at_most_ten_lines(task, tmp_path):
    if "nilearn" in task.stem:
        pytest.importorskip("nilearn")
    lines = task.read_text(encoding="utf-8").splitlines()
    assert len(lines) <= 10
    assert lines[0].startswith("# ") and "" in lines
    run(task, meshes.shared("scan/cortex_left_41k.ply.zst", tmp_path))
