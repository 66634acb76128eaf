#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Interrupts commands by a signal while they write: the old file must stay, and no temporary file may remain.

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
TIMEOUT_SECONDS = 120
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
BATCH = ("batch", "sphere.ply", "-r", "inf", "--max-bytes", "1000000000000")
SAVES = (
    ("build", "sphere.ply"),
    ("build", "sphere.ply", "--index", "paper"),
    ("generate", "sphere", "--vertices", VERTICES),
    ("query", "sphere.ply", "-v", "0", "-r", "1"),
    ("compare", "sphere.ply", "-v", "0", "-r", "1"),
)


def reset_signals():
    """Background jobs and nohup pass on ignored signals, which the program must not handle."""
    for number in SIGNALS:
        signal.signal(number, signal.SIG_DFL)


@contextlib.contextmanager
def running(program, folder, command, output):
    """The running command; killed at the end."""
    with subprocess.Popen([program, *command, "-o", output], cwd=folder, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, preexec_fn=reset_signals) as process:
        try:
            yield process
        finally:
            process.kill()


def was_interrupted(process, what):
    """Whether it ended with the exit code of an interrupt and one line on standard error."""
    stdout, stderr = process.communicate(timeout=TIMEOUT_SECONDS)
    print(f"{what}: exit code {process.returncode}, {stderr.decode().strip()}")
    return process.returncode == 130 and not stdout and stderr.count(b"\n") == 1


def wait_for_file(folder, before, process):
    """Waits for a new file in the folder: the temporary file."""
    end = time.monotonic() + TIMEOUT_SECONDS
    while set(folder.iterdir()) == before:
        if process.poll() is not None or time.monotonic() > end:
            sys.exit(f"no file was created: {process.communicate()[1].decode()}")
        time.sleep(0.01)


def batch_keeps_old_file(program, folder, number, name):
    """A batch is slow enough for the signal to arrive while it writes."""
    target = folder / name
    target.write_text("old")
    before = set(folder.iterdir())
    with running(program, folder, BATCH, target.name) as process:
        wait_for_file(folder, before, process)
        process.send_signal(number)
        interrupted = was_interrupted(process, f"{number.name} in batch -o {name}")
    left = set(folder.iterdir()) - before
    print(f"  remaining files: {left or 'none'}")
    return interrupted and not left and target.read_text() == "old"


def is_whole_or_old(program, folder, command):
    """The save may finish before the signal arrives: then the exit code is 0 and the file is complete."""
    target = folder / "out"
    target.write_text("old")
    before = set(folder.iterdir())
    with running(program, folder, command, target.name) as process:
        while set(folder.iterdir()) == before and process.poll() is None:
            pass
        process.send_signal(signal.SIGINT)
        code = process.wait(timeout=TIMEOUT_SECONDS)
    left = set(folder.iterdir()) - before
    is_old = target.read_bytes() == b"old"
    is_whole = subprocess.run([program, "info", target], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                              check=False).returncode == 0
    print(f"SIGINT in {command[0]}: exit code {code}, the file is {'old' if is_old else 'complete' if is_whole else 'torn'}")
    return not left and (code == 130 and is_old or code == 0 and is_whole)


def pipe_is_interrupted(program, folder, command, number):
    """A save into a pipe that is not read cannot finish before the signal arrives."""
    pipe = folder / "pipe"
    os.mkfifo(pipe)
    try:
        with running(program, folder, command, pipe.name) as process, pipe.open("rb", buffering=0) as reader:
            reader.read(1)
            process.send_signal(number)
            written = 1 + len(reader.readall())
            return was_interrupted(process, f"{number.name} in {command[0]}, after {written} bytes")
    finally:
        pipe.unlink()


def main():
    program = Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        subprocess.run([program, "generate", "sphere", "--vertices", VERTICES, "-o", "sphere.ply"], cwd=folder,
                       check=True, stdout=subprocess.DEVNULL)
        passed = [batch_keeps_old_file(program, folder, number, name) for number in SIGNALS
                  for name in ("out.npz", "out.csv")]
        passed += [is_whole_or_old(program, folder, command) for command in SAVES]
        passed += [pipe_is_interrupted(program, folder, command, number) for command in SAVES for number in SIGNALS]
    return 0 if all(passed) else 1


if __name__ == "__main__":
    sys.exit(main())
