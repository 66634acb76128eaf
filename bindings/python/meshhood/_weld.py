# SPDX-License-Identifier: MIT
"""Welding: one vertex for all vertices at the same place."""

from __future__ import annotations

from typing import Any, NamedTuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _convert, _core
from ._mesh import whole_mesh_arrays
from ._repr import shown_in_a_line
from ._types import Ids, Number


@shown_in_a_line
class Welded(NamedTuple):
    """A welded mesh, and what has become of each vertex (see `weld`).

    >>> vertices, faces, ids = meshhood.weld(V, F)
    """

    vertices: Union[NDArray[np.float32], NDArray[np.float64]]
    faces: Union[Ids, tuple[NDArray[np.int64], Ids]]
    ids: Ids


def weld(V: Any, F: Any = None, eps: Number = 0) -> Welded:
    """Makes one vertex of all vertices at the same place, so that faces which meet there are connected.

    V, F : a mesh, as for `MeshIndex`.
    eps : vertices at most this far apart are welded; finite, >= 0, in the unit of the positions. With 0, positions must
        be equal, where -0 equals 0.

    Vertices are taken in ascending order. A vertex becomes the first kept vertex at most `eps` away; if there is none,
    it is kept. So kept vertices are more than `eps` apart, no chain of near vertices collapses, and welding again
    changes nothing. With eps > 0 the choice depends on the order of the vertices.

    Returns `Welded(vertices, faces, ids)`: the kept vertices in their order, (#kept, 3) of the type of V; the faces as
    triangles (#F, 3) int32, or polygons as a tuple (offsets int64, corners int32); and for each vertex of V its id in
    the new mesh, (#V,) int32. All faces stay, in their order and with the number of their corners; a face whose corners
    were welded with each other repeats a vertex. Values by vertex of the new mesh, `values`, are `values[ids]` for V;
    values by vertex of V are `of_V[np.unique(ids, return_index=True)[1]]` for the kept vertices.

    About O(#V + #F) if `eps` is no larger than the mean edge length; one thread. Raises ValueError or TypeError, naming
    the argument and the element.

    >>> welded = meshhood.weld(V[F].reshape(-1, 3), np.arange(F.size).reshape(-1, 3))
    >>> len(welded.vertices)
    642
    """
    if isinstance(F, (int, float)):
        raise TypeError(f"F: {F}, expected faces; the distance is eps={F}")
    positions, corners, offsets = whole_mesh_arrays(V, F)
    distance = _convert.finite(eps, "eps", or_zero=True)
    # A copy, because another thread may write to the array once it is checked.
    vertices, corners, offsets, ids = _core.weld((np.array(positions), corners, offsets), eps=distance)
    return Welded(vertices, (offsets, corners) if len(offsets) else corners.reshape(-1, 3), ids)
