import sys, meshhood, trueform  # noqa: E401
V, F = meshhood.read_mesh(sys.argv[1])

links = trueform.vertex_link_faces(F, trueform.cell_membership(F, n_ids=len(V)))
result = trueform.k_rings(links, 3, inclusive=True)
