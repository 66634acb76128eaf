import sys, meshhood, numpy as np, pyvista  # noqa: E401
V, F = meshhood.read_mesh(sys.argv[1])
r, rows = 10 * meshhood.MeshIndex(V, F).mean_edge_length, np.linspace(0, len(V) - 1, 200).astype(int)

mesh = pyvista.PolyData.from_regular_faces(V, F)
result = []
for v in rows:
    mesh["distance"] = np.linalg.norm(V - V[v], axis=1)
    ball = mesh.clip_scalar(scalars="distance", value=r)
    result.append(ball.connectivity("closest", closest_point=V[v]).area)
