# Smooths the thickness of both hemispheres of fsaverage; nothing comes from the medial wall, thinner than 1 mm.
import meshhood
from nilearn.datasets import load_fsaverage_data
from nilearn.surface import SurfaceImage
thickness, smooth = load_fsaverage_data("fsaverage5", data_type="thickness"), {}

for side, mesh in thickness.mesh.parts.items():
    values = thickness.data.parts[side]
    smooth[side] = meshhood.MeshIndex(mesh).smooth(values, 6.0, metric="surface", weights="area", walls=values < 1)
result = SurfaceImage(thickness.mesh, smooth)
