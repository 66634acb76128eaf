# SPDX-License-Identifier: MIT
"""The command line of a wheel says and writes what the program does, in all its streams, errors and signals."""
import os
import subprocess
import sys
from pathlib import Path

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
        "batch --help",
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
    subprocess.run([sys.executable, TESTS / "run_transcript.py", COMMAND, TESTS / f"{name}.txt"], check=True)


def test_ends_at_a_signal():
    subprocess.run([sys.executable, TESTS / "run_interrupt.py", COMMAND], check=True)


def test_finds_the_page_of_the_package(folder, monkeypatch):
    if not (Path(meshhood.__file__).parent / "viewer.html").exists():
        pytest.skip("the page is not built")
    monkeypatch.delenv("MESHHOOD_VIEWER", raising=False)
    assert run(COMMAND, ["view", "scroll.ply", "-o", "scroll.html"], folder)[0] == 0


def test_starts_without_numpy(folder):
    done = subprocess.run([sys.executable, "-X", "importtime", COMMAND, "--version"], capture_output=True, text=True, check=True)
    assert "meshhood._core" in done.stderr
    assert "numpy" not in done.stderr
