#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs a long batch on a pseudo-terminal and looks for the progress line: share, rate and time left. Then interrupts it.

usage: run_terminal.py PROGRAM
"""
import os
import pty
import re
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

TIMEOUT_SECONDS = 120
LINE = re.compile(rb"computing 30000 rows, about [0-9.]+ GB: \d+ %, \d+ s, [0-9]{1,3}(,[0-9]{3})* rows/s, \d+ s left")
CLEAR_LINE = b"\r\x1b[K"


def main():
    program = Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "generate", "sphere", "--vertices", "30000", "-o", "sphere.ply"], cwd=folder, check=True)
        command = [program, "batch", "sphere.ply", "-r", "inf", "--max-bytes", "1000000000000", "-o", "out.npz"]
        ours, theirs = pty.openpty()
        with subprocess.Popen(command, cwd=folder, stderr=theirs) as process:
            os.close(theirs)
            end = time.monotonic() + TIMEOUT_SECONDS
            output = b""
            while not LINE.search(output) and time.monotonic() < end and process.poll() is None:
                output += os.read(ours, 4096)
            process.send_signal(signal.SIGINT)
            try:
                while chunk := os.read(ours, 4096):
                    output += chunk
            except OSError:  # the terminal of a process that has ended
                pass
        left = sorted(os.listdir(folder))
    last = output.splitlines()[-1] if output else b""
    print(f"exit code {process.returncode}, files {left}, output {output[-300:]!r}")
    is_cleared = CLEAR_LINE in output[output.rfind(b"left"):]
    passed = LINE.search(output) and is_cleared and last.endswith(b"cancelled") and process.returncode == 130
    return 0 if passed and left == ["sphere.ply"] else 1


if __name__ == "__main__":
    sys.exit(main())
