# SPDX-License-Identifier: MIT
"""`python3 -m bench.kept_rows INDEX`: what bench/kept_rows.cpp does, from Python."""
import sys
import time

import meshhood
import numpy as np


def microseconds(index, vertices, radius):
    begin = time.thread_time()
    rows = index.neighborhoods(radius, vertices, workers=1)
    took = time.thread_time() - begin
    del rows
    return 1e6 * took / len(vertices)


def main(file):
    index = meshhood.load(file)
    for line in sys.stdin:
        first, count, radius = line.split()
        vertices = np.arange(int(first), int(first) + int(count))
        print(microseconds(index, vertices, float(radius)), flush=True)


if __name__ == "__main__":
    main(sys.argv[1])
