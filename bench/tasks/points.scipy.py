import sys, meshhood  # noqa: E401
from scipy.spatial import cKDTree
V, F = meshhood.read_mesh(sys.argv[1])
edge = meshhood.MeshIndex(V, F).mean_edge_length

result = cKDTree(V).query_ball_point(V, 4 * edge, return_length=True, workers=-1)
