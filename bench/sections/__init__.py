# SPDX-License-Identifier: MIT
"""The sections of docs/benchmarks.md in their order, by the results each is made from."""
from . import accuracy, all_vertices, exact_index, figure4, paper_tables, peers, scaling

SECTIONS = {
    "paper_tables": paper_tables,
    "all_vertices": all_vertices,
    "exact_index": exact_index,
    "figure4": figure4,
    "accuracy": accuracy,
    "scaling": scaling,
    "peers": peers,
}
