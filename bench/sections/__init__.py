# SPDX-License-Identifier: MIT
"""The sections of the benchmarks, by the results from which each is made. A section has

    TITLE           its heading
    text(data)      its page, docs/benchmarks/NAME.md
    summary(data)   its part of docs/benchmarks.md; may be absent
"""
from . import (accuracy, all_vertices, arrays, batch, before, curvature, curvature_growth, exact_index, figure4,
               paper_tables, peers, reading, scaling, tasks)

SECTIONS = {
    "batch": batch,
    "arrays": arrays,
    "exact_index": exact_index,
    "before": before,
    "paper_tables": paper_tables,
    "accuracy": accuracy,
    "all_vertices": all_vertices,
    "curvature": curvature,
    "curvature_growth": curvature_growth,
    "peers": peers,
    "tasks": tasks,
    "reading": reading,
    "scaling": scaling,
    "figure4": figure4,
}
