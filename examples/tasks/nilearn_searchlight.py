# nilearn's searchlight on a surface: how well two conditions are told apart by the patterns around 40 vertices.
import sys, meshhood, numpy as np  # noqa: E401
from nilearn.decoding.searchlight import search_light
from sklearn.naive_bayes import GaussianNB
V, F = meshhood.read_mesh(sys.argv[1])
trials, rows = np.random.default_rng(1).normal(size=(20, len(V))), np.arange(0, len(V), len(V) // 40)

discs = meshhood.MeshIndex(V, F).radius_neighbors_graph(8.0, vertices=rows, metric="surface")
result = search_light(trials, np.arange(20) % 2, GaussianNB(), discs.tolil(), cv=4, n_jobs=1)
