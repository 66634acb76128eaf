# SPDX-License-Identifier: MIT
"""The order of the gallery."""

from pathlib import Path

EXAMPLES = (
    "smooth_map",
    "searchlight",
    "learning",
    "curvature_scales",
    "creases",
    "worn_relief",
    "patch_rim",
    "wall_thickness",
    "gaps_of_parts",
    "brush",
    "deforming",
    "point_sheets",
    "larger_than_memory",
)


class Order:
    """Sorts the files of a folder, as the gallery asks for."""

    def __init__(self, folder):
        self.folder = folder

    def __call__(self, file):
        return EXAMPLES.index(Path(file).stem)
