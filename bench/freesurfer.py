#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How mean curvatures correlate with the curvature of FreeSurfer, on the white surface of fsaverage5, which nilearn
brings along.

    PYTHONPATH=PACKAGE bench/freesurfer.py [RADIUS IN MM...]
"""

import sys
from pathlib import Path

import meshhood
import nibabel
import nilearn.datasets
import numpy as np

folder = Path(nilearn.datasets.__file__).parent / "data" / "fsaverage5"
V, F = nibabel.load(folder / "white_left.gii.gz").agg_data()
theirs = nibabel.load(folder / "curv_left.gii.gz").agg_data()
index = meshhood.MeshIndex(V, F)
print(f"{len(V)} vertices, mean edge {index.mean_edge_length:.2f} mm")
for r in [float(word) for word in sys.argv[1:]] or [2.0, 4.0, 6.0, 8.0]:
    found = {
        "quadric": index.curvature(r).mean,
        "jet": index.curvature(r, fit="jet").mean,
        "corrected": index.corrected_curvature(r).mean,
    }
    print(f"{r:g} mm:", *(f"{name} {np.corrcoef(mean, theirs)[0, 1]:.2f}" for name, mean in found.items()))
