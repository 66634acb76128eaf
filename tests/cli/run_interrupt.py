#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Ends `meshhood batch` by a signal while it writes, and looks for what it left behind: nothing.

usage: run_interrupt.py PROGRAM
"""
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

VERTICES = "30000"
PATIENCE_SECONDS = 120
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


def hear_signals():
    """What runs in the background, or under nohup, hands down that some are ignored, and the program keeps to that."""
    for number in SIGNALS:
        signal.signal(number, signal.SIG_DFL)


def wait_for_file(folder, before, process):
    """Until there is a new file in the folder, which is the one being written."""
    end = time.monotonic() + PATIENCE_SECONDS
    while set(folder.iterdir()) == before:
        if process.poll() is not None or time.monotonic() > end:
            sys.exit(f"no file was begun: {process.communicate()[1].decode()}")
        time.sleep(0.01)


def interrupt(program, folder, number):
    before = set(folder.iterdir())
    command = [program, "batch", "sphere.ply", "-r", "inf", "-o", "out.npz"]
    with subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          preexec_fn=hear_signals) as process:
        wait_for_file(folder, before, process)
        process.send_signal(number)
        stdout, stderr = process.communicate(timeout=PATIENCE_SECONDS)
    left = set(folder.iterdir()) - before
    print(f"{number.name}: exit code {process.returncode}, {stderr.decode().strip()}, left behind: {left or 'nothing'}")
    return process.returncode == 130 and not left and not stdout and stderr.count(b"\n") == 1


def main():
    program = Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        subprocess.run([program, "generate", "sphere", "--vertices", VERTICES, "-o", "sphere.ply"], cwd=folder,
                       check=True, stdout=subprocess.DEVNULL)
        ended = [interrupt(program, folder, number) for number in SIGNALS]
    return 0 if all(ended) else 1


if __name__ == "__main__":
    sys.exit(main())
