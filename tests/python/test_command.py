# SPDX-License-Identifier: MIT
"""The command line of a wheel says and writes what the program does, in all its streams, errors and signals."""
import base64
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import meshhood

TESTS = Path(__file__).resolve().parents[1] / "cli"
PROGRAM = os.environ.get("MESHHOOD_CLI", "")
COMMAND = Path(meshhood.__file__).parents[1] / "bin" / "meshhood"

if not PROGRAM:
    pytest.skip("the command line is not built", allow_module_level=True)


def run(program, arguments, folder, **options):
    done = subprocess.run([program, *arguments], cwd=folder, capture_output=True, check=False, **options)
    return done.returncode, done.stdout, done.stderr


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("meshes")
    run(PROGRAM, ["generate", "scroll", "--vertices", "2000", "-o", "scroll.ply"], folder)
    return folder


@pytest.mark.parametrize(
    "words",
    [
        "",
        "--help",
        "--version",
        "generate --help",
        "generate scroll --vertices 2000 -o -",
        "info scroll.ply",
        "query scroll.ply -v 7 -r 3",
        "info scroll.ply --json",
        "query scroll.ply -v 99999 -r 3",
        "query scroll.ply -v 7 -r",
        "query missing.ply -v 7 -r 3",
        "batch scroll.ply -r 3 -o -",
        "curvature scroll.ply -r 5 --unit edge -o -",
        "manual bash",
        "unknown",
    ],
)
def test_says_what_the_program_says(folder, words):
    assert run(COMMAND, words.split(), folder) == run(PROGRAM, words.split(), folder)


def test_says_what_else_it_reads(folder):
    others = ["GIFTI", "VTP", "VTU", "MSH", "GLB", "glTF", "3MF"]
    for words in ("batch --help", "closest --help", "build --help"):
        (code, ours, _), (_, of_program, _) = run(COMMAND, words.split(), folder), run(PROGRAM, words.split(), folder)
        assert code == 0 and all(name in ours.decode() for name in others)
        assert not any(name in of_program.decode() for name in others[1:])
        options = ours.partition(b"\n  -")[2]
        assert options and options == of_program.partition(b"\n  -")[2]


def test_takes_bytes_that_are_no_text(folder):
    name = b"no\xfftext\n.ply"
    assert run(COMMAND, ["info", name], folder) == run(PROGRAM, ["info", name], folder)
    (folder / os.fsdecode(name)).write_bytes((folder / "scroll.ply").read_bytes())
    for locale in ("C", "C.UTF-8"):
        environment = dict(os.environ, LC_ALL=locale)
        done = run(COMMAND, ["info", name], folder, env=environment)
        assert done[0] == 0
        assert done == run(PROGRAM, ["info", name], folder, env=environment)


@pytest.mark.parametrize("name", ["streams", "shell", "errors", "names", "help", "view"])
def test_behaves_as_the_transcript(name):
    subprocess.run([sys.executable, TESTS / "run_transcript.py", TESTS / f"{name}.txt", COMMAND], check=True)


def test_ends_at_a_signal():
    subprocess.run([sys.executable, TESTS / "run_interrupt.py", COMMAND], check=True)


def test_finds_the_page_of_the_package(folder, monkeypatch):
    if not (Path(meshhood.__file__).parent / "viewer.html").exists():
        pytest.skip("the page is not built")
    monkeypatch.delenv("MESHHOOD_VIEWER", raising=False)
    assert run(COMMAND, ["view", "scroll.ply", "-o", "scroll.html"], folder)[0] == 0


@pytest.mark.parametrize(("end", "library"), [("surf.gii", "nibabel"), ("vtp", "pyvista"), ("glb", "trimesh")])
def test_reads_what_the_package_reads(folder, end, library):
    pytest.importorskip(library)
    folder = folder / end
    folder.mkdir()
    meshhood.write_mesh(folder / f"mesh.{end}", *meshhood.read_mesh(folder.parent / "scroll.ply"))
    meshhood.write_mesh(folder / "mesh.ply", *meshhood.read_mesh(folder / f"mesh.{end}"))
    run(PROGRAM, ["build", "mesh.ply", "-o", "index.mhi"], folder)
    for words in ("info", "info --json", "query -v 7 -r 3", "curvature -r 9 --csv", "check index.mhi --mesh"):
        code, output, messages = run(PROGRAM, [*words.split(), "mesh.ply"], folder)
        assert code == 0
        output = output.replace(b"mesh.ply", f"mesh.{end}".encode()).replace(b"PLY", b"other")
        assert run(COMMAND, [*words.split(), f"mesh.{end}"], folder) == (0, output, messages)


@pytest.mark.parametrize(("end", "library"), [("surf.gii", "nibabel"), ("vtp", "pyvista"), ("glb", "trimesh")])
def test_what_the_program_says_converts_what_it_does_not_read(folder, tmp_path, end, library):
    pytest.importorskip(library)
    V, F = meshhood.read_mesh(folder / "scroll.ply")
    meshhood.write_mesh(tmp_path / f"a.{end}", V, F)
    message = run(PROGRAM, ["info", f"a.{end}"], tmp_path)[2].decode()
    line = message.partition("; ")[2].removesuffix(" converts it\n")
    words = [word.replace("FILE", f"a.{end}") for word in shlex.split(line)]
    assert run(sys.executable, words[1:], tmp_path) == (0, b"", b"")
    assert (meshhood.read_mesh(tmp_path / "mesh.ply").vertices == V).all()


def test_warns_of_files_of_other_libraries_as_the_package(folder):
    nibabel = pytest.importorskip("nibabel")
    meshhood.write_mesh(folder / "moved.gii", *meshhood.read_mesh(folder / "scroll.ply"))
    image = nibabel.load(folder / "moved.gii")
    image.darrays[0].coordsys.xform[0, 0] = 2
    nibabel.save(image, folder / "moved.gii")
    with pytest.warns(UserWarning, match="moved.gii: the coordinates are in the space") as noted:
        meshhood.read_mesh(folder / "moved.gii")
    done = run(COMMAND, ["query", "moved.gii", "-v", "7", "-r", "3"], folder)
    assert done[2].decode() == f"meshhood: warning: {noted[0].message}\n".replace(f"{folder}/", "")


def test_vertices_of_nan_keep_their_ids_and_are_walls(folder, tmp_path):
    pyvista = pytest.importorskip("pyvista")
    V, F = meshhood.read_mesh(folder / "scroll.ply")
    holes = np.concatenate([np.full((2, 3), np.nan, V.dtype), V])
    meshhood.write_mesh(tmp_path / "scan.vtp", holes, F + 2)
    with pytest.warns(UserWarning, match="scan.vtp: 2 vertices without a position") as noted:
        meshhood.read_mesh(tmp_path / "scan.vtp")
    code, ids, messages = run(COMMAND, ["query", "scan.vtp", "-v", "9", "-r", "3"], tmp_path)
    assert messages.decode() == f"meshhood: warning: {noted[0].message}\n".replace(f"{tmp_path}/", "")
    assert (code, sorted(map(int, ids.split()))) == (0, sorted(2 + meshhood.MeshIndex(V, F).neighborhood(7, 3)))
    assert run(COMMAND, ["query", "scan.vtp", "-v", "1", "-r", "3"], tmp_path) == (0, b"", messages)
    pyvista.PolyData.from_regular_faces(holes, F + 1).save(tmp_path / "scan.vtp")
    message = b"meshhood: scan.vtp: vertex 1 has no position (NaN), but face "
    code, _, messages = run(COMMAND, ["info", "scan.vtp"], tmp_path)
    assert code == 3 and messages.startswith(message)


def test_shows_and_cuts_what_the_package_reads(folder, tmp_path, monkeypatch):
    pytest.importorskip("pyvista")
    V, F = meshhood.read_mesh(folder / "scroll.ply")
    meshhood.write_mesh(tmp_path / "scroll.vtp", V, F)
    (tmp_path / "viewer.html").write_text("<!-- meshhood:page -->\n")
    monkeypatch.setenv("MESHHOOD_VIEWER", "viewer.html")
    assert run(COMMAND, ["view", "scroll.vtp", "-v", "7"], tmp_path) == (0, b"scroll.html\n", b"")
    page = (tmp_path / "scroll.html").read_text()
    assert '{"name":"scroll.vtp","vertex":7}' in page
    (tmp_path / "page.ply").write_bytes(base64.b64decode(re.search(r'id="meshhood-mesh">(.*)</script>', page)[1]))
    for shown, given in zip(meshhood.read_mesh(tmp_path / "page.ply"), (V, F)):
        np.testing.assert_array_equal(shown, given)
    meshhood.write_mesh(tmp_path / "scroll.ply", V, F)
    for end, cut in (("vtp", COMMAND), ("ply", PROGRAM)):
        words = ["partition", f"scroll.{end}", "-o", end, "--parts", "2", "--halo", "3"]
        assert run(cut, words, tmp_path)[::2] == (0, b"")
    for part in ("part-00000", "part-00001"):
        assert (tmp_path / "vtp" / part / "index.mhi").read_bytes() == (tmp_path / "ply" / part / "index.mhi").read_bytes()
    code, _, message = run(PROGRAM, ["partition", "scroll.vtp", "-o", "no", "--parts", "2", "--halo", "3"], tmp_path)
    assert code == 3 and b"converts it" in message


def test_names_a_file_that_another_library_cannot_read(folder, monkeypatch):
    pytest.importorskip("nibabel")
    (folder / "broken.gii").write_text("<GIFTI")
    (folder / "nibabel").mkdir()
    code, _, message = run(COMMAND, ["info", "broken.gii"], folder)
    assert code == 3
    assert message.startswith(b"meshhood: broken.gii: a GIFTI surface that nibabel cannot read: ")
    (folder / "nibabel" / "__init__.py").write_text("raise ModuleNotFoundError(name='nibabel')")
    monkeypatch.setenv("PYTHONPATH", str(folder), prepend=os.pathsep)
    message = b"meshhood: broken.gii: a GIFTI surface needs nibabel: pip install nibabel\n"
    assert run(COMMAND, ["info", "broken.gii"], folder) == (3, b"", message)


def test_starts_without_numpy(folder):
    done = subprocess.run([sys.executable, "-X", "importtime", COMMAND, "--version"], capture_output=True, text=True, check=True)
    assert "meshhood._core" in done.stderr
    assert "numpy" not in done.stderr
