# SPDX-License-Identifier: MIT
"""Every method that writes a file, on a disk that is full after any number of pages: the old file or the new one, an
OSError that names the file, and no temporary file. tests/io/save_full_test.cpp does this for the writers of C++."""

import os
import subprocess
import sys

import meshes
import pytest
from scale import scaled

STEPS = scaled(40, least=8)

# What writes the file of this name, `target`, and an older file of that name.
WRITE_MESH = "meshhood.write_mesh(target, V, F, values={'height': V[:, 2]})"
WRITE_BYTES = "target.write_bytes(b'old')"
FILES = {
    "an index": ("index.save(target)", "smaller.save(target)"),
    "an index with faces": ("index.save(target, faces=True)", "smaller.save(target)"),
    "a page": ("page.save(target)", WRITE_BYTES),
    "mesh.ply": (WRITE_MESH, WRITE_BYTES),
    "mesh.vtk": (WRITE_MESH, WRITE_BYTES),
}
# What is written into the folder `target`.
FOLDERS = {
    "partition": "meshhood.partition(arrays, target, parts=3, halo=1.0)",
    "Parts.write": "parts.write(ids, 1.0, target)",
    "Parts.neighborhoods, npz": "parts.neighborhoods(1.0, target)",
    "Parts.neighborhoods, zarr": "parts.neighborhoods(1.0, target, format='zarr')",
    "map_meshes": "meshhood.distributed.map_meshes([mesh], counts, to=target)",
}

PREPARE = """
import sys
sys.path.insert(0, sys.argv[1])
from small_disk import SmallDisk
disk = SmallDisk(sys.argv[2])
import errno, os, pathlib, tempfile
import meshes, meshhood, meshhood.distributed
import numpy as np
def ids(part, index, owned):
    return np.repeat(part.vertices[owned], 20)[:, None].reshape(len(owned), 20)
def counts(index):
    return index.counts(1.0, workers=1)
place = pathlib.Path(tempfile.mkdtemp())
V, F = meshes.two_plates(30)
index, smaller = meshhood.MeshIndex(V, F), meshhood.MeshIndex(*meshes.two_plates(3))
page = meshhood.Page("<p>" + "x" * 70000, 600)
arrays, mesh = (place / "V.npy", place / "F.npy"), str(place / "mesh.mhi")
np.save(arrays[0], V), np.save(arrays[1], F), index.save(mesh)
parts = meshhood.partition(arrays, place / "parts", parts=3, halo=1.0)
def on_disk(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}
def check(error):
    assert error.errno == errno.ENOSPC, repr(error)
    assert str(root) in str(error.filename), repr(error)
root = pathlib.Path(sys.argv[2])
target = place / "target"
"""

WRITE_FILE = """
target = place / {name!r}
{write}
new = target.read_bytes()
target = root / {name!r}
refused = 0
for pages in range({steps}):
    disk.leave_free(4000)
    {write_old}
    old = target.read_bytes()
    disk.leave_free(pages)
    try:
        {write}
        done = True
    except OSError as error:
        check(error)
        done, refused = False, refused + 1
    assert target.read_bytes() == (new if done else old)
    assert list(root.iterdir()) == [target]
assert refused
print(refused, "of {steps} refused")
"""

# A call that failed is continued by the next one.
WRITE_FOLDER = """
import dask, shutil
dask.config.set(scheduler="synchronous")  # on threads, tasks of a call that failed may run on
{write}
new = on_disk(target)
target = root / "target"
refused = 0
for step in range({steps}):
    disk.leave_free(4000)
    shutil.rmtree(target, ignore_errors=True)
    disk.leave_free(1 + round({pages} * step / {steps}))
    try:
        {write}
    except OSError as error:
        check(error)
        refused += 1
        disk.leave_free(4000)
        left = [name for name in on_disk(target) if name.endswith(".tmp") or "/." in name] if target.exists() else []
        assert not left, left
        {write}
    assert on_disk(target) == new
assert refused
print(refused, "of {steps} refused")
"""


def run(program, folder):
    command = [sys.executable, "-W", "ignore", "-c", PREPARE + program, os.path.dirname(meshes.__file__), str(folder)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=300)
    if done.returncode == 77:
        pytest.skip(done.stdout.strip())
    assert done.returncode == 0, done.stdout + done.stderr
    print(done.stdout.strip())


@pytest.mark.parametrize("name", FILES)
def test_a_file_is_the_old_one_or_the_new_one(name, tmp_path):
    write, write_old = FILES[name]
    run(WRITE_FILE.format(name=name, write=write, write_old=write_old, steps=60), tmp_path)


@pytest.mark.parametrize("name", FOLDERS)
def test_a_folder_has_whole_files(name, tmp_path):
    pytest.importorskip("dask")
    if "zarr" in name:
        pytest.importorskip("zarr", "3")
    run(WRITE_FOLDER.format(write=FOLDERS[name], pages=250, steps=STEPS), tmp_path)
