#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How Connectome Workbench smooths a map, beside `MeshIndex.smooth`: the weight of a vertex by its distance, the
results on noise, and the times.

    PYTHONPATH=PACKAGE bench/workbench.py SURFACE [FWHM]

Needs nibabel, and wb_command of the Debian package connectome-workbench. Times are wall clock, the least of seven; of
Workbench, of three.
"""

import subprocess
import sys
import tempfile
import time

import meshhood
import nibabel
import numpy as np

MAPS = 10
METRICS = ("straight", "surface", "path")


def save(path, **arrays):
    intents = {"points": "NIFTI_INTENT_POINTSET", "triangles": "NIFTI_INTENT_TRIANGLE"}
    image = nibabel.gifti.GiftiImage()
    for name, array in arrays.items():
        intent = intents.get(name, "NIFTI_INTENT_NONE")
        image.add_gifti_data_array(nibabel.gifti.GiftiDataArray(array, intent=intent))
    nibabel.save(image, path)


def workbench(folder, maps, fwhm):
    """The smoothed maps (#V, n), and the seconds of the command."""
    save(f"{folder}/in.func.gii", **{f"map{i}": column.astype(np.float32) for i, column in enumerate(maps.T)})
    command = ["wb_command", "-metric-smoothing", "mesh.surf.gii", "in.func.gii", str(fwhm), "out.func.gii", "-fwhm"]
    begin = time.perf_counter()
    subprocess.run(command, check=True, cwd=folder, capture_output=True)
    seconds = time.perf_counter() - begin
    found = nibabel.load(f"{folder}/out.func.gii").agg_data()
    return np.stack(found if isinstance(found, tuple) else [found], axis=1).astype(float), seconds


def weights_by_distance(V, index, folder, fwhm):
    """The response to 1 at a vertex, by the distance along the surface."""
    v = len(V) * 3 // 10
    impulse = np.zeros((len(V), 1))
    impulse[v] = 1
    theirs = workbench(folder, impulse, fwhm)[0][:, 0]
    columns = [index.smoothing_matrix(fwhm, weights="area", metric=metric) for metric in METRICS]
    ours = [matrix.tocsc()[:, [v]].toarray()[:, 0] for matrix in columns]
    ids, lengths = index.neighborhood(v, 3 * fwhm, metric="surface", return_distance=True)
    distance = np.full(len(V), np.inf)
    distance[ids] = lengths
    deviation = fwhm / np.sqrt(8 * np.log(2))
    print(f"Workbench reaches {distance[theirs != 0].max() / deviation:.2f} standard deviations")
    print("distance / fwhm | Gaussian | Workbench | meshhood", " | ".join(METRICS))
    for low in np.arange(0, 1.6, 0.2):
        near = (distance >= low * fwhm) & (distance < (low + 0.2) * fwhm)
        columns = [np.exp(-((distance[near] / deviation) ** 2) / 2).mean()]
        columns += [column[near].mean() / column[v] for column in (theirs, *ours)]
        print(f"{low:.1f} to {low + 0.2:.1f} | " + " | ".join(f"{value:.3f}" for value in columns))


def least(call):
    times = []
    for _ in range(7):
        begin = time.perf_counter()
        call()
        times.append(time.perf_counter() - begin)
    return min(times)


def main():
    V, F = meshhood.read_mesh(sys.argv[1])
    fwhm = float(sys.argv[2]) if len(sys.argv) > 2 else 6.0
    index = meshhood.MeshIndex(V, F)
    maps = np.random.default_rng(1).normal(size=(len(V), MAPS)).astype(np.float32)
    with tempfile.TemporaryDirectory() as folder:
        save(f"{folder}/mesh.surf.gii", points=V.astype(np.float32), triangles=F)
        weights_by_distance(V, index, folder, fwhm)
        theirs = workbench(folder, maps, fwhm)[0]
        seconds = min(workbench(folder, maps[:, :1], fwhm)[1] for _ in range(3))
        for metric in METRICS:
            words = {"weights": "area", "metric": metric}
            built = least(lambda: meshhood.MeshIndex(V, F).smooth(maps[:, 0], fwhm, **words))  # noqa: B023
            kept = least(lambda: index.smooth(maps[:, 0], fwhm, **words))  # noqa: B023
            ours = index.smooth(maps, fwhm, weights="area", metric=metric)
            correlation = np.corrcoef(ours.ravel(), theirs.ravel())[0, 1]
            deviations = f"{ours.std():.3f} and {theirs.std():.3f}"
            print(f"{metric}: correlation {correlation:.4f}, standard deviation {deviations}")
            for what, took in (("with the build of the index", built), ("with an index", kept)):
                print(f"  one map {what} {1e3 * took:.1f} ms, {seconds / took:.0f} times as fast")
        print(f"Workbench: {1e3 * seconds:.0f} ms")


if __name__ == "__main__":
    main()
