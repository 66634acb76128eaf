# SPDX-License-Identifier: MIT
"""How wide `smooth` is along a cortex, measured by exact geodesics."""

import sys
from pathlib import Path

import meshes
import numpy as np
import pytest

import meshhood

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))


@pytest.mark.parametrize("fwhm", (3.0, 6.0))
def test_the_second_moment_along_the_surface_is_within_3_percent(fwhm, tmp_path):
    pytest.importorskip("igl")
    from bench.geodesic_width import geodesics, width

    V, F = meshhood.read_mesh(meshes.shared("scan/cortex_left_41k.ply.zst", tmp_path))
    index = meshhood.MeshIndex(V, F)
    vertices = np.random.default_rng(1).choice(len(V), 20, replace=False)
    weights = index.smoothing_matrix(fwhm, vertices=vertices, metric="surface", weights="area").tolil()
    widths = []
    for v, row, row_weights in zip(vertices.tolist(), weights.rows, weights.data):
        distances = np.full(len(V), np.nan)
        ends, lengths = geodesics(index, v, meshhood.smoothing_radius(fwhm))
        distances[ends] = lengths
        widths.append(width(row_weights, distances[row]))
    print(f"fwhm {fwhm}: {np.mean(widths):.3f}, from {min(widths):.3f} to {max(widths):.3f}")
    assert abs(np.mean(widths) / fwhm - 1) < 0.03
