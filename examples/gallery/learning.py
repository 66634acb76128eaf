# SPDX-License-Identifier: MIT
"""Learning on a surface
======================

What networks take: ``edge_index`` from each neighbor to its vertex, the nearest 64 as patches of equal length with a
mask, ragged rows. What scikit-learn takes: features at 16 scales, a row for each vertex, by which vertices in grooves
(dark) are told from the others, on the half of the surface that was not learned from.
"""

import meshhood
import numpy as np
import pyvista
from made_meshes import cortex
from sklearn.linear_model import LogisticRegression

V, F = cortex(5)
index = meshhood.MeshIndex(V, F)
indptr, indices = index.neighborhoods(6.0, sort="distance")  # ragged: tf.RaggedTensor.from_row_splits(indices, indptr)
edge_index = np.stack([indices, np.repeat(np.arange(len(V)), np.diff(indptr))]).astype(np.int64)
without_self = edge_index[:, edge_index[0] != edge_index[1]]  # torch.from_numpy takes it without a copy
ids, mask = meshhood.padded(indptr, indices, width=64, truncate=True)
patches = np.where(mask[..., None], V[ids] - V[:, None], 0)  # (#V, 64, 3), around each vertex

features = index.features(scales=np.geomspace(3, 12, 16), kinds=("mean", "shape_index", "area"))
X = np.nan_to_num(features.transpose(1, 0, 2).reshape(len(V), -1))
groove, learned = np.linalg.norm(V / (1.2, 0.9, 0.9), axis=1) < 46, V[:, 0] < 0
found = LogisticRegression(max_iter=1000).fit(X[learned], groove[learned]).predict(X)
print(f"{(found == groove)[~learned].mean():.3f} of the other half are right; patches {patches.shape}")
mesh = pyvista.PolyData.from_regular_faces(V, F)
mesh.plot(scalars=found, cmap="bone_r", clim=(0, 1.6), show_scalar_bar=False, cpos="yz", zoom=1.7)
