# SPDX-License-Identifier: MIT
"""The libraries to compare with, in the order of the tables: those with the same kind of answer come first."""
from .libigl_curvature import LibiglBall, LibiglRings
from .meshhood_exact import MeshhoodAll, MeshhoodBatch, MeshhoodCalls, MeshhoodCount, MeshhoodPaper
from .native import BreadthFirst, Curvature, CurvatureBreadthFirst, Nanoflann
from .open3d_radius import Open3d
from .pymeshlab_geodesic import PyMeshLab
from .pyvista_clip import PyVista
from .scipy_trees import Components, Dijkstra, KdTree
from .trueform_neighborhoods import Trueform

PEERS = {
    peer.name: peer
    for peer in (MeshhoodAll, MeshhoodBatch, MeshhoodCalls, MeshhoodCount, MeshhoodPaper, BreadthFirst, Trueform,
                 Components, PyVista, Nanoflann, KdTree, Open3d, Dijkstra, PyMeshLab, Curvature, CurvatureBreadthFirst,
                 LibiglBall, LibiglRings)
}
