import sys, meshhood, numpy as np, subprocess, tempfile, nibabel  # noqa: E401
V, F = meshhood.read_mesh(sys.argv[1])
values = np.random.default_rng(1).normal(size=len(V)).astype(np.float32)
folder = tempfile.mkdtemp()
def save(name, **arrays):
    made = [nibabel.gifti.GiftiDataArray(a, intent="NIFTI_INTENT_" + key) for key, a in arrays.items()]
    made and nibabel.save(nibabel.gifti.GiftiImage(darrays=made), f"{folder}/{name}.gii")
save("mesh.surf", POINTSET=V.astype(np.float32), TRIANGLE=F)
save("map.func", NONE=values)

command = "wb_command -metric-smoothing mesh.surf.gii map.func.gii 6 out.func.gii -fwhm"
subprocess.run(command.split(), check=True, cwd=folder, capture_output=True)
result = nibabel.load(f"{folder}/out.func.gii").agg_data()
