# SPDX-License-Identifier: MIT
"""The tools that answer for every vertex of a mesh in memory, in the order of the tables."""
from .others import Libigl, Open3d, Potpourri3d, Pygeodesic, PyVista, ScipyMatrix, ScipyTree
from .ours import BreadthFirst, Meshhood, MeshhoodRings
from .trueform_rings import Curvature, Neighborhoods, Rings

TOOLS = {tool.name: tool for tool in (Meshhood, MeshhoodRings, BreadthFirst, Neighborhoods, Rings, Curvature, Libigl,
                                      ScipyTree, ScipyMatrix, Open3d, PyVista, Potpourri3d, Pygeodesic)}
