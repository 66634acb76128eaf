# SPDX-License-Identifier: MIT
"""The tables of the pages, by the results from which each is made: functions of these results. See bench/report.py."""
from . import (accuracy, all_vertices, arrays, batch, curvature, curvature_growth, exact_index, figure4,
               paper_tables, peers, reading, scaling, tasks)

SECTIONS = {section.__name__.rpartition(".")[2]: section for section in (
    accuracy, all_vertices, arrays, batch, curvature, curvature_growth, exact_index, figure4, paper_tables, peers,
    reading, scaling, tasks)}
