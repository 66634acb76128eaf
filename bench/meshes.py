# SPDX-License-Identifier: MIT
"""The meshes, by name: files beside the repository, or a generated mesh of the same size where there is none."""
import os
import subprocess
from dataclasses import dataclass
from pathlib import Path

from . import places

SHARED = Path(os.environ.get("MESHHOOD_SHARED", places.ROOT.parent / "shared")) / "meshes"


@dataclass(frozen=True)
class Mesh:
    file: str
    stand_in: str  # by formula
    of_paper: str = ""  # which of the paper's meshes it is, or stands for
    remark: str = ""


MESHES = {
    "cat0": Mesh("paper/tosca_cat0.off", "sphere:27894", "Cat", "the paper's data set (the pose it used is not known)"),
    "victoria0": Mesh("paper/tosca_victoria0.off", "knot:45659", "Victoria",
                      "the paper's data set (the pose it used is not known)"),
    "dragon": Mesh("paper/stanford_dragon_437k.ply.zst", "noise:437645", "Happy",
                   "stand-in: the same scanner and reconstruction program"),
    "head_skin": Mesh("paper/head_skin_1m.ply.zst", "sphere:1000000", "Raptor",
                      "stand-in: one smooth sheet, nearest to the Raptor in kind"),
    "mri_head": Mesh("paper/mri_head_a_1m.ply.zst", "gyroid:1000000", "Raptor",
                     "stand-in: one very folded surface, far harder"),
    "cat2": Mesh("paper/tosca_cat2.off", "folds:27894", remark="the cat in a pose with limbs close together"),
    "cortex": Mesh("scan/cortex_left_41k.ply.zst", "folds:40962", remark="a folded sheet whose folds lie close together"),
    "tiny": Mesh("", "scroll:3000", remark="by formula, to try the harness"),
    "scroll": Mesh("", "scroll:100000", remark="by formula: a rolled sheet, its turns 2.5 edges apart"),
}
# Arguments of our programs. Sheets so close together that a ball contains several, by formula.
SHEETS = {kind: f"{kind}:1000000" for kind in ("scroll", "plates", "folds", "gyroid")}
# Families of the tests: coordinates of sixty magnitudes, a hub, and faces of random corners.
ODD = {family: f"{family}:20000" for family in ("mixed scales", "star", "random faces")}
OF_PAPER = [name for name, mesh in MESHES.items() if mesh.of_paper]


def argument(name):
    """The argument of our programs: an unpacked file, or a shape as kind:vertices."""
    mesh = MESHES[name]
    packed = SHARED / mesh.file
    if not mesh.file or not packed.exists():
        return mesh.stand_in
    return str(unpacked(packed) if packed.suffix == ".zst" else packed)


def described(name):
    mesh = MESHES[name]
    what = mesh.remark or ""
    if mesh.file and argument(name) != mesh.stand_in:
        return f"`{mesh.file}`; {what}"
    return f"`{mesh.stand_in}` by formula; {what if not mesh.file else 'the file is not here'}"


def as_file(name):
    """As `argument`, but always a file."""
    mesh = argument(name)
    if ":" not in mesh:
        return mesh
    kind, vertices = mesh.split(":")
    target = places.SCRATCH / f"{kind}-{vertices}.ply"
    if not target.exists():
        target.parent.mkdir(parents=True, exist_ok=True)
        subprocess.run([places.MESHHOOD, "generate", kind, "--vertices", vertices, "-o", target], check=True,
                       stdout=subprocess.DEVNULL)
    return str(target)


def unpacked(packed):
    target = places.SCRATCH / packed.stem
    if not target.exists():
        target.parent.mkdir(parents=True, exist_ok=True)
        partial = target.with_suffix(".partial")
        subprocess.run(["zstd", "-dqf", packed, "-o", partial], check=True)
        partial.rename(target)
    return target
