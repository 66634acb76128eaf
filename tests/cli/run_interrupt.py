#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Ends commands by a signal while they write, and looks for what they left behind: nothing, and the old file.

usage: run_interrupt.py PROGRAM
"""
import contextlib
import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

VERTICES = "30000"
PATIENCE_SECONDS = 120
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
BATCH = ("batch", "sphere.ply", "-r", "inf")
SAVES = (
    ("build", "sphere.ply"),
    ("build", "sphere.ply", "--clustering", "paper"),
    ("generate", "sphere", "--vertices", VERTICES),
    ("query", "sphere.ply", "-v", "0", "-r", "1"),
    ("compare", "sphere.ply", "-v", "0", "-r", "1"),
)


def hear_signals():
    """What runs in the background, or under nohup, hands down that some are ignored, and the program keeps to that."""
    for number in SIGNALS:
        signal.signal(number, signal.SIG_DFL)


@contextlib.contextmanager
def running(program, folder, command, output):
    """The command while it runs, killed if it outlives what is done with it."""
    with subprocess.Popen([program, *command, "-o", output], cwd=folder, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, preexec_fn=hear_signals) as process:
        try:
            yield process
        finally:
            process.kill()


def ended(process, what):
    """Whether it ended as one that was interrupted, with one line of complaint."""
    stdout, stderr = process.communicate(timeout=PATIENCE_SECONDS)
    print(f"{what}: exit code {process.returncode}, {stderr.decode().strip()}")
    return process.returncode == 130 and not stdout and stderr.count(b"\n") == 1


def wait_for_file(folder, before, process):
    """Until there is a new file in the folder, which is the one being written."""
    end = time.monotonic() + PATIENCE_SECONDS
    while set(folder.iterdir()) == before:
        if process.poll() is not None or time.monotonic() > end:
            sys.exit(f"no file was begun: {process.communicate()[1].decode()}")
        time.sleep(0.01)


def leaves_the_old_file(program, folder, number):
    """A batch takes so long that the signal finds it in the midst of its file."""
    target = folder / "out.npz"
    target.write_text("old")
    before = set(folder.iterdir())
    with running(program, folder, BATCH, target.name) as process:
        wait_for_file(folder, before, process)
        process.send_signal(number)
        was_ended = ended(process, f"{number.name} in batch")
    left = set(folder.iterdir()) - before
    print(f"  left behind: {left or 'nothing'}")
    return was_ended and not left and target.read_text() == "old"


def is_whole_or_old(program, folder, command):
    """A save may be over before the signal comes: then the code is 0, and the file whole."""
    target = folder / "out"
    target.write_text("old")
    before = set(folder.iterdir())
    with running(program, folder, command, target.name) as process:
        while set(folder.iterdir()) == before and process.poll() is None:
            pass
        process.send_signal(signal.SIGINT)
        code = process.wait(timeout=PATIENCE_SECONDS)
    left = set(folder.iterdir()) - before
    is_old = target.read_bytes() == b"old"
    is_whole = subprocess.run([program, "info", target], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                              check=False).returncode == 0
    print(f"SIGINT in {command[0]}: exit code {code}, the file is {'old' if is_old else 'whole' if is_whole else 'torn'}")
    return not left and (code == 130 and is_old or code == 0 and is_whole)


def hears_in_the_midst(program, folder, command, number):
    """Into a pipe that nobody empties, no save ends before the signal comes."""
    pipe = folder / "pipe"
    os.mkfifo(pipe)
    try:
        with running(program, folder, command, pipe.name) as process, pipe.open("rb", buffering=0) as reader:
            reader.read(1)
            process.send_signal(number)
            written = 1 + len(reader.readall())
            return ended(process, f"{number.name} in {command[0]}, after {written} bytes")
    finally:
        pipe.unlink()


def main():
    program = Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        subprocess.run([program, "generate", "sphere", "--vertices", VERTICES, "-o", "sphere.ply"], cwd=folder,
                       check=True, stdout=subprocess.DEVNULL)
        held = [leaves_the_old_file(program, folder, number) for number in SIGNALS]
        held += [is_whole_or_old(program, folder, command) for command in SAVES]
        held += [hears_in_the_midst(program, folder, command, number) for command in SAVES for number in SIGNALS]
    return 0 if all(held) else 1


if __name__ == "__main__":
    sys.exit(main())
