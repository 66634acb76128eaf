# SPDX-License-Identifier: MIT
"""What every peer offers."""
from importlib import metadata


class Peer:
    """One way to ask for neighborhoods. It is built and asked in a process of its own, and `ask` alone is timed."""

    name = ""
    package = None  # as PyPI calls it, for the version
    module = None  # what it is imported as, before any time is taken
    answers = ""  # which question: "exact", "ball", or what else
    remark = ""
    whole = False  # answers for all vertices at once, and for nothing less
    largest_answer = None  # ids of all answers of one call, where more would not fit into memory or never end

    def __init__(self, positions, triangles, path, threads):
        """positions: #V by 3 float32. triangles: #F by 3 int32. path: the same mesh as PLY. threads: 1, or all."""

    def ask(self, vertices, radius):
        """The neighborhoods of `vertices` (int32; ignored by who answers for all), in whatever form this peer has."""
        raise NotImplementedError

    def rows(self, answer, vertices):
        """Of what `ask` gave: an array of ids for each of `vertices`, or None where it has none to compare."""
        return answer

    def version(self):
        return metadata.version(self.package) if self.package else ""


def rows_of(offsets, ids, places):
    return [ids[offsets[place]:offsets[place + 1]] for place in places]
