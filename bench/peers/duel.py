# SPDX-License-Identifier: MIT
"""`python3 -m bench.peers.duel MESH NAME...`: some of the libraries alone, one thread, vertices as in the file. Prints
the times, and how many times as long as the first the others take; saves nothing.

    python3 -m bench.peers.duel dragon "meshhood, all vertices" "trueform neighborhoods"
"""
import argparse

from .. import meshes
from . import PEERS
from .contest import contest
from .service import ONE_THREAD

BLOCK_SECONDS = 0.3


def main():
    parser = argparse.ArgumentParser(prog="python3 -m bench.peers.duel", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", choices=meshes.MESHES)
    parser.add_argument("peers", nargs="+", choices=PEERS)
    options = parser.parse_args()
    for found in contest(options.mesh, "file", ONE_THREAD, BLOCK_SECONDS, options.peers):
        first = None
        for row in found["peers"]:
            if "microseconds" not in row:
                print(f"{found['radius_edges']} edges, {row['name']}: {row}")
                continue
            median = row["microseconds"]["median"]
            first = first or median
            print(f"{found['radius_edges']} edges, {row['name']}: {median:.3g} µs a row, {median / first:.1f}")


if __name__ == "__main__":
    main()
