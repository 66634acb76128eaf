# SPDX-License-Identifier: MIT
"""The calls in the tables of docs/coming_from run on a small mesh: those of the other library, where it is installed,
and ours. The pages of C++ libraries are left out, and the calls of pycortex where it is not installed."""

import re
import warnings
from importlib.util import find_spec
from pathlib import Path

import meshhood
import numpy as np
import pytest

FOLDER = Path(__file__).resolve().parents[2] / "docs/coming_from"
CODE = re.compile(r"`([^`]+)`")
# The modules that a page needs.
MODULES = {
    "scipy": ["scipy"],
    "scikit_learn": ["sklearn"],
    "trimesh": ["trimesh", "rtree"],
    "pyvista": ["pyvista"],
    "libigl": ["igl"],
    "open3d": ["open3d"],
    "nilearn": ["sklearn", "nilearn", "nibabel"],
}
OF_PYCORTEX = re.compile(r"\b(surface|cortex)\.")
OF_CPP = {"cgal", "geometry_central", "index"}


def common():
    """The names that all tables use."""
    trimesh = pytest.importorskip("trimesh")
    sphere = trimesh.creation.icosphere(subdivisions=3)
    V, F = np.array(sphere.vertices), np.array(sphere.faces, np.int64)
    index = meshhood.MeshIndex(V, F)
    ids = index.neighborhood(42, 0.4)
    return {
        **{"meshhood": meshhood, "MeshIndex": meshhood.MeshIndex, "np": np, "sphere": sphere},
        **{"V": V, "F": F, "P": V, "index": index, "ids": ids, "near": ids},
        **{"v": 42, "r": 0.4, "k": 5, "eps": 1e-6, "fwhm": 0.3, "link": 0.2},
        **{"p": np.array([0.1, 0.2, 1.1]), "points": V[:9] * 1.1, "center": V[42]},
        **{"values": V[:, 2].copy(), "wall": V[:, 2] < -0.9, "faces": np.arange(9)},
    }


def of_scipy(names):
    from scipy.sparse.csgraph import breadth_first_order, dijkstra
    from scipy.spatial import KDTree

    A = names["index"].radius_neighbors_graph(0.2, mode="distance")
    ball = np.array(KDTree(names["V"]).query_ball_point(names["V"][42], 0.4))
    return {"breadth_first_order": breadth_first_order, "dijkstra": dijkstra, "KDTree": KDTree, "A": A, "ball": ball}


def of_scikit_learn(names):
    from sklearn.cluster import SpectralClustering
    from sklearn.neighbors import NearestNeighbors, radius_neighbors_graph

    return {
        "graph": names["index"].radius_neighbors_graph(0.4),
        "SpectralClustering": SpectralClustering,
        "NearestNeighbors": NearestNeighbors,
        "radius_neighbors_graph": radius_neighbors_graph,
    }


def of_trimesh(names):
    import trimesh
    import trimesh.curvature
    import trimesh.proximity
    import trimesh.smoothing

    return {"trimesh": trimesh, "mesh": names["sphere"], "points": names["V"][:9]}


def of_pyvista(names):
    import pyvista

    mesh = pyvista.wrap(names["sphere"])
    return {"pyvista": pyvista, "mesh": mesh, "a": 1, "b": 77, "inside": names["ids"]}


def of_libigl(names):
    import igl

    sources, others, none = np.array([42]), np.arange(len(names["V"])), np.array([], np.int64)
    return {"igl": igl, "radius": 5, "VS": sources, "FS": none, "VT": others, "FT": none}


def of_open3d(names):
    import open3d

    V, F = open3d.utility.Vector3dVector(names["V"]), open3d.utility.Vector3iVector(names["F"])
    mesh = open3d.geometry.TriangleMesh(V, F)
    scene = open3d.t.geometry.RaycastingScene()
    scene.add_triangles(open3d.t.geometry.TriangleMesh.from_legacy(mesh))
    return {
        "RaycastingScene": open3d.t.geometry.RaycastingScene,
        "KDTreeFlann": open3d.geometry.KDTreeFlann,
        "KDTreeSearchParamRadius": open3d.geometry.KDTreeSearchParamRadius,
        **{"mesh": mesh, "scene": scene, "pcd": open3d.geometry.PointCloud(V)},
        "p": open3d.core.Tensor([[0.1, 0.2, 1.1]], open3d.core.float32),
    }


def of_nilearn(names):
    import nibabel
    import nilearn.decoding
    import nilearn.image
    from sklearn.neighbors import NearestNeighbors

    image = nibabel.Nifti1Image(np.random.default_rng(1).normal(size=(5, 5, 5)).astype(np.float32), np.eye(4))
    found = {"nilearn": nilearn, "NearestNeighbors": NearestNeighbors, "image": image}
    if find_spec("cortex"):
        import cortex.polyutils

        found |= {"cortex": cortex, "surface": cortex.polyutils.Surface(names["V"], names["F"]), "factor": 0.1}
        found |= {"mask": np.isin(np.arange(len(names["V"])), names["ids"])}
    return found


def calls(name):
    """The calls in the first two columns of the tables of a page: of the other library, and ours."""
    for line in (FOLDER / f"{name}.md").read_text(encoding="utf-8").splitlines():
        if line.startswith("| ") and not line.startswith("| ---"):
            _, other, ours, _ = line.split("|", 3)
            yield from (("other", call) for call in CODE.findall(other))
            yield from (("ours", call) for call in CODE.findall(ours))


@pytest.mark.parametrize("name", sorted(page.stem for page in FOLDER.glob("*.md") if page.stem not in OF_CPP))
def test_calls_exist(name):
    for module in MODULES[name]:
        pytest.importorskip(module)
    shared = common()
    others = {**shared, **globals()[f"of_{name}"](shared)}
    names = {"other": others, "ours": {**others, "p": shared["p"], "points": shared["points"]}}
    count, failed = 0, []
    for side, call in calls(name):
        if OF_PYCORTEX.search(call) and "cortex" not in others:
            continue
        count += 1
        try:
            with warnings.catch_warnings(), np.errstate(all="ignore"):
                warnings.simplefilter("ignore")
                eval(call, dict(names[side]))
        except Exception as error:
            failed.append(f"{call}: {type(error).__name__}: {error}")
    print(f"{name}: {count} calls")
    assert failed == []
    assert count > 5


def test_thickness_is_that_of_trimesh_with_normals_weighted_by_area():
    trimesh = pytest.importorskip("trimesh")
    pytest.importorskip("rtree")
    names = common()
    V = names["V"] * [1, 0.6, 0.3] * np.random.default_rng(1).normal(1, 0.03, (len(names["V"]), 1))
    mesh = trimesh.Trimesh(V, names["F"], process=False)
    areas = mesh.face_normals * mesh.area_faces[:, None]
    normals = trimesh.geometry.mean_vertex_normals(len(V), mesh.faces, areas)
    ours = meshhood.MeshIndex(mesh).thickness(method="ray")
    theirs = [trimesh.proximity.thickness(mesh, V, method="ray", normals=given) for given in (normals, None)]
    np.testing.assert_allclose(ours, theirs[0], rtol=1e-12)
    differ = np.mean(np.abs(theirs[1] / ours - 1) > 0.1)
    print(f"{100 * differ:.0f} % of the vertices differ by more than a tenth along the normal of one face")
    assert differ > 0.3
    hits = meshhood.MeshIndex(mesh).closest_point(mesh.triangles_center)
    of_faces = meshhood.MeshIndex(mesh).thickness(points=hits.point, face=hits.face)
    theirs = trimesh.proximity.thickness(mesh, hits.point, method="ray", normals=mesh.face_normals[hits.face])
    np.testing.assert_allclose(of_faces, theirs, rtol=1e-9)
