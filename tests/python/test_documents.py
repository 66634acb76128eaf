# SPDX-License-Identifier: MIT
"""The Python and shell code of all documents runs unchanged, on files with the names used there. The blocks of a page
run in their order, in one folder."""

import gzip
import os
import shutil
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import meshes
import meshhood
import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools"))
from code_blocks import blocks_to_run, documents

PAGES = [name for name in documents() if blocks_to_run(name, "python", "sh")]
PAGE_OF_VIEWER = Path(meshhood.__file__).with_name("viewer.html")

# Another machine, and a scheduler with many: here this machine is all of them.
STAND_INS = """
ssh() { shift; bash -c "$*"; }
sbatch() {
  local task tasks=${1#--array=}
  for ((task = ${tasks%-*}; task <= ${tasks#*-}; ++task)); do SLURM_ARRAY_TASK_ID=$task bash -c "$3"; done
}
"""


def write_meshes():
    trimesh = pytest.importorskip("trimesh")
    sphere = trimesh.creation.icosphere(subdivisions=3)
    for name in ("hand", "cortex", "body"):
        sphere.export(f"{name}.ply")
    trimesh.Trimesh(50 * sphere.vertices, sphere.faces).export("lh.ply")
    if find_spec("nibabel"):
        meshhood.write_mesh("lh.midthickness.surf.gii", 50 * sphere.vertices, sphere.faces)
    hollow = np.concatenate([20 * sphere.vertices, 18 * sphere.vertices])  # a wall of 2 mm
    faces = np.concatenate([sphere.faces, sphere.faces[:, ::-1] + len(sphere.vertices)])
    meshhood.write_mesh("part.ply", hollow, faces)
    with gzip.open("hand.ply.gz", "wb") as file:
        file.write(Path("hand.ply").read_bytes())
    V, F = meshes.two_plates(60)
    order = np.random.default_rng(1).permutation(len(V))  # as a scan: near vertices have no near numbers
    meshhood.write_mesh("scan.ply", V[np.argsort(order)], order[F])
    meshhood.write_mesh("other.ply", *meshes.two_plates(9))
    return sphere


def write_values(sphere):
    thickness = np.asarray(sphere.vertices)[:, 2]
    np.save("thickness.npy", thickness)
    np.savetxt("thickness.txt", thickness)
    np.savetxt("widths.txt", 0.3 + 0.1 * thickness**2)
    np.savetxt("medial.txt", np.flatnonzero(thickness < -0.9), fmt="%d")
    np.savetxt("walls.txt", [1, 2, 3], fmt="%d")
    np.savetxt("seam.txt", sphere.edges_unique[:9], fmt="%d")


def run_shell(code):
    subprocess.run(["bash", "-euo", "pipefail", "-c", STAND_INS + code], check=True)


# Dask leaves sockets to the garbage collector, and names the port of its dashboard if another cluster has it.
@pytest.mark.filterwarnings(
    "ignore::ResourceWarning", "ignore::pytest.PytestUnraisableExceptionWarning", "ignore:Port 8787"
)
@pytest.mark.parametrize("name", PAGES)
def test_code_runs(name, tmp_path, monkeypatch):
    blocks = blocks_to_run(name, "python", "sh")
    code = "".join(block.code for block in blocks)
    if ("meshhood.view(" in code or "meshhood view " in code) and not PAGE_OF_VIEWER.exists():
        pytest.skip("the page of the viewer was not built")
    program = os.environ.get("MESHHOOD_CLI") or shutil.which("meshhood")
    if program is None and any(block.language == "sh" for block in blocks):
        pytest.skip("MESHHOOD_CLI does not name the command line")
    for tool in filter(None, (sys.executable, program)):
        monkeypatch.setenv("PATH", str(Path(tool).parent), prepend=os.pathsep)
    monkeypatch.setenv("MESHHOOD_VIEWER", str(PAGE_OF_VIEWER))
    monkeypatch.chdir(tmp_path)
    write_values(write_meshes())
    if "pyvista" in code:
        pytest.importorskip("pyvista").OFF_SCREEN = True
    if ".surf.gii" in code:
        pytest.importorskip("nibabel")
    names = {}
    for block in blocks:
        if block.language == "sh":
            run_shell(block.code)
        else:
            exec(compile(block.code, name, "exec"), names)
    print(f"{name}: {len(blocks)} pieces of code")


def test_there_are_pages():
    assert {"README.md", "docs/index.md", "docs/readers/scan.md", "docs/coming_from/scipy.md"} <= set(PAGES)
