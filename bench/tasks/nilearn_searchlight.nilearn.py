import sys, meshhood, numpy as np  # noqa: E401
from nilearn.decoding.searchlight import search_light
from sklearn.naive_bayes import GaussianNB
from sklearn.neighbors import NearestNeighbors
V, F = meshhood.read_mesh(sys.argv[1])
trials, rows = np.random.default_rng(1).normal(size=(20, len(V))), np.arange(0, len(V), len(V) // 40)

balls = NearestNeighbors(radius=8.0).fit(V).radius_neighbors_graph(V[rows])
result = search_light(trials, np.arange(20) % 2, GaussianNB(), balls.tolil(), cv=4, n_jobs=1)
