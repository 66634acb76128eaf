# SPDX-License-Identifier: MIT
"""Small meshes made by formula, and the shared meshes beside the repository."""

import os
from pathlib import Path

import numpy as np
import pytest


def grid(side, height=0.0):
    """`side` by `side` vertices at whole numbers, quads: positions and (#F, 4)."""
    x, y = np.meshgrid(np.arange(side), np.arange(side))
    V = np.column_stack([x.ravel(), y.ravel(), np.full(side * side, height)])
    corner = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).ravel()
    return V, np.column_stack([corner, corner + 1, corner + side + 1, corner + side])


def triangles(quads):
    return np.concatenate([quads[:, :3], quads[:, [0, 2, 3]]])


def soup(V, F):
    """The same faces, each with vertices of its own."""
    return V[F].reshape(-1, 3), np.arange(F.size).reshape(F.shape)


def two_plates(side):
    """Two grids that nearly touch, so that every larger ball has vertices of both."""
    (low, quads), (high, _) = grid(side), grid(side, 0.25)
    return np.concatenate([low, high]).astype(np.float32), triangles(np.concatenate([quads, quads + len(low)]))


def folded(side):
    """One grid, folded so that its halves nearly touch."""
    V, quads = grid(2 * side)
    x = V[:, 0].copy()
    V[:, 0] = np.minimum(x, 2 * side - 1 - x)
    V[:, 2] = np.where(x < side, 0.0, 0.25)
    return V, triangles(quads)


_BESIDE = Path(__file__).resolve().parents[3] / "shared"


def shared(name, folder):
    """The path of a shared mesh, unpacked into `folder`; skips the test where there is none."""
    source = Path(os.environ.get("MESHHOOD_SHARED", _BESIDE)) / "meshes" / name
    if not source.is_file():
        pytest.skip(f"no {source}")
    if source.suffix != ".zst":
        return source
    zstandard = pytest.importorskip("zstandard")
    target = folder / source.stem
    with source.open("rb") as packed, target.open("wb") as plain:
        zstandard.ZstdDecompressor().copy_stream(packed, plain)
    return target
