# SPDX-License-Identifier: MIT
"""Mesh files that other libraries read and write, if they are installed. The C++ library reads and writes the rest."""

from __future__ import annotations

import base64
import gzip
import itertools
import json
import math
import os
import re
import tempfile
import zlib
from collections.abc import Iterable
from typing import Any, Callable, NamedTuple, Optional
from xml.parsers import expat

import numpy as np

from . import _core
from ._mesh import face_arrays, mesh_arrays, poly_data, text_of_walls
from ._optional import optional

# Positions, faces, and what the reader has to say. Of a library, any form that `mesh_arrays` takes.
_Read = tuple[Any, Any, list[str]]


_GZIP = b"\x1f\x8b"
_UNPACKED = 1 << 28  # bytes that any compressed file may unpack to; a large one to 64 times its size
_HEAD = 1 << 16  # as in `io/detect_format.cpp`


class _Format(NamedTuple):
    name: str
    module: str
    read: Callable[[Any, str], _Read]


def read_other(path: str) -> Optional[_Read]:
    """Positions and faces as `read_mesh` returns them, and warnings; None for a file that is for the C++ library."""
    form = _format_of(_head(path), path)
    if form is None:
        return None
    module = optional(form.module, f"{path}: {form.name}")
    try:
        V, F, notes = form.read(module, path)
        mesh = positions, corners, offsets = mesh_arrays(V, F)
    except ModuleNotFoundError as error:
        needs = f"{path}: {form.name} needs {error.name}: pip install {error.name}"
        raise ModuleNotFoundError(needs, name=error.name) from None
    except MemoryError:
        raise
    except Exception as error:  # each library has its own
        if isinstance(error, OSError) and error.errno:  # of the operating system
            raise
        library = form.module.partition(".")[0]
        raise ValueError(f"{path}: {form.name} that {library} cannot read: {str(error) or type(error).__name__}") from error
    try:
        found = _core.place(mesh)
        _core.check_mesh(mesh if found is None else (found[0], corners, offsets))  # as these libraries read anything
    except ValueError as error:
        raise ValueError(f"{path}: {re.sub('^[VF]: ', '', str(error))}") from None
    if found is not None:
        notes.append(text_of_walls(found[1]))
    corners = corners.astype(np.int32, copy=False)
    if offsets is None or np.all(np.diff(offsets) == 3):
        return positions, corners.reshape(-1, 3), notes
    return positions, (offsets.astype(np.int64, copy=False), corners), notes


def as_ply(path: str) -> Optional[tuple[bytes, list[str]]]:
    """The mesh of such a file as a PLY file, and the warnings."""
    read = read_other(path)
    if read is None:
        return None
    V, F, notes = read
    return binary_ply(V, *face_arrays(F)), notes


def binary_ply(positions: Any, corners: Any, offsets: Any) -> bytes:
    """A PLY file of a valid mesh, also of vertices without a position."""
    real = "double" if positions.dtype == np.float64 else "float"
    sides = np.full(len(corners) // 3, 3) if offsets is None else np.diff(offsets)
    starts = np.cumsum(sides) - sides
    wide = corners.astype(np.int64, copy=False)
    header = (
        "ply\nformat binary_little_endian 1.0\n"
        f"element vertex {len(positions)}\nproperty {real} x\nproperty {real} y\nproperty {real} z\n"
        f"element face {len(sides)}\nproperty list int int vertex_indices\nend_header\n"
    )
    coordinates = positions.astype(positions.dtype.newbyteorder("<"), copy=False)
    return header.encode("ascii") + coordinates.tobytes() + np.insert(wide, starts, sides).astype("<i4").tobytes()


def _head(path: str) -> bytes:
    """The first bytes of a regular file: others can be read only once."""
    if not os.path.isfile(path):
        return b""
    with open(path, "rb") as file:
        head = file.read(_HEAD)
    if not head.startswith(_GZIP):
        return head
    try:
        with gzip.open(path) as unpacked:
            return b"<GIFTI" if b"<GIFTI" in unpacked.read(_HEAD) else head
    except (OSError, EOFError):
        return head


def _format_of(head: bytes, path: str) -> Optional[_Format]:
    """By content, as `io/detect_format.cpp` knows these files; by extension where the mark comes later."""
    for mark, form in _FIRST.items():
        if head.startswith(mark):
            return form
    if not head.lstrip(b"\xef\xbb\xbf\t\n\r ").startswith((b"<", b"{")):  # also behind a byte-order mark
        return None
    late = _LATE.get(os.path.splitext(path)[1].lower())
    return next((form for mark, form in _WITHIN.items() if mark in head or mark == late), None)


def _read_gifti(nibabel: Any, path: str) -> _Read:
    data = _unpacked(path)
    _check_arrays(nibabel, data, _limit(path))
    image = nibabel.GiftiImage.from_bytes(data)
    codes = nibabel.nifti1.xform_codes.label
    notes = []
    for array in image.get_arrays_from_intent("NIFTI_INTENT_POINTSET"):
        system = array.coordsys
        if system is not None and system.xform is not None and not np.array_equal(system.xform, np.eye(4)):
            space, other = codes[system.dataspace], codes[system.xformspace]
            notes.append(f"the coordinates are in the space {space!r}; the transform to {other!r} is not applied")
    return image, None, notes


def _check_arrays(nibabel: Any, data: bytes, limit: int) -> None:
    """Refuses GIFTI with an array that unpacks to more than it declares, or with packed arrays beyond the limit."""
    codes, types = nibabel.gifti.util.gifti_encoding_codes.label, nibabel.nifti1.data_type_codes.dtype
    array, text, is_data, left = dict[str, str](), list[str](), False, limit

    def at_tag(name: str, attributes: Any = None) -> None:
        nonlocal array, is_data, left
        if is_data and text and codes[array.get("Encoding", "B64GZ")] == "B64GZ":
            shape = [int(array[f"Dim{axis}"]) for axis in range(int(array["Dimensionality"]))]
            size = types[array["DataType"]].itemsize * math.prod(shape)
            if not 0 <= size <= left:
                raise ValueError(f"has an array of shape {tuple(shape)}, beyond the limit of {limit} bytes")
            if len(zlib.decompressobj().decompress(base64.b64decode("".join(text)), size + 1)) > size:
                raise ValueError(f"has an array of shape {tuple(shape)} that unpacks to more than {size} bytes")
            left -= size
        text.clear()
        if name == "DataArray" and attributes is not None:
            array = attributes
        is_data = attributes is not None if name == "Data" else is_data

    parser = expat.ParserCreate()
    parser.StartElementHandler = parser.EndElementHandler = at_tag
    parser.CharacterDataHandler = text.append
    parser.buffer_text = True
    parser.Parse(data, True)


def _limit(path: str) -> int:
    return max(_UNPACKED, 64 * os.path.getsize(path))


def _unpacked(path: str) -> bytes:
    """The content of a file that may be compressed. A forged one of 10 MB would unpack to 10 GB."""
    with open(path, "rb") as file:
        data = file.read()
    if not data.startswith(_GZIP):
        return data
    limit = _limit(path)
    with gzip.open(path) as unpacked:
        pieces = iter(lambda: unpacked.read(_HEAD), b"")
        data = b"".join(itertools.islice(pieces, limit // _HEAD))
        if unpacked.read(1):
            raise ValueError(f"unpacks to more than {limit} bytes; gunzip unpacks it")
    return data


def _read_quads(freesurfer: Any, path: str) -> _Read:
    return (*freesurfer.read_geometry(path), [])


def _read_vtk(pyvista: Any, path: str) -> _Read:
    found = re.search(rb"<VTKFile[^>]*?\stype\s*=\s*[\"'](\w+)", _head(path))
    kind = found[1].decode() if found else "unknown"
    if kind not in _VTK_KINDS:
        raise ValueError(f"type {kind}, expected {' or '.join(_VTK_KINDS)}")
    caught = pyvista.VtkErrorCatcher(send_to_logging=False)
    try:
        with caught:
            reader = pyvista.get_reader(path, force_ext=_VTK_KINDS[kind])
            mesh = reader.read()
        if reader.reader.GetErrorCode():  # the mesh is empty
            raise RuntimeError("is damaged")
    except RuntimeError as error:
        first = next((event.alert for event in caught.events if event.kind.upper() == "ERROR"), str(error))
        raise ValueError(" ".join(first.split())) from error
    if kind == "PolyData":
        return mesh, None, []
    faces = np.isin(mesh.celltypes, (5, 7, 9))  # triangle, polygon, quad
    if not faces.all():
        raise ValueError("has cells that are no faces; pyvista.read(path).extract_surface() has those of its boundary")
    cells = mesh.GetCells()
    return mesh.points, (np.asarray(cells.GetOffsetsArray()), np.asarray(cells.GetConnectivityArray())), []


def _read_gmsh(gmsh: Any, path: str) -> _Read:
    mesh = gmsh.read(path)
    faces = [block for block in mesh.cells if block.type not in ("vertex", "line")]
    notes = []
    if faces and len(faces) < len(mesh.cells):
        notes.append("points and lines, as of the boundary, are left out")
        mesh.cells = faces
    return mesh, None, notes


def _reads_scene(kind: str) -> Callable[[Any, str], _Read]:
    def read(trimesh: Any, path: str) -> _Read:
        notes = [] if kind == "3mf" else _gltf_notes(path, kind)
        scene = trimesh.load_scene(path, file_type=kind, process=False)
        return scene.to_mesh(), None, notes  # with the transforms of all nodes

    return read


def _gltf_notes(path: str, kind: str) -> list[str]:
    """Refuses what trimesh reads as another mesh, and notes what it leaves out."""
    with open(path, "rb") as file:
        start = file.read(20) if kind == "glb" else b""  # of the file, and of its first part
        tree = json.loads(file.read(min(int.from_bytes(start[12:16], "little"), os.path.getsize(path)) if start else -1))
    if not isinstance(meshes := tree.get("meshes", []), list):  # of glTF 1, which trimesh refuses
        return []
    for name in tree.get("extensionsRequired", ()):
        if not _GLTF_READ.fullmatch(name):
            raise ValueError(f"requires {name}, which trimesh does not decode")
    if meshes and not tree.get("scenes"):
        raise ValueError("has meshes, but no scene, which says where they are")
    modes = set()
    for at, mesh in enumerate(meshes):
        for primitive in mesh["primitives"]:
            modes.add(mode := primitive.get("mode", 4))
            if "KHR_draco_mesh_compression" in primitive.get("extensions", ()):
                optional("DracoPy", "Draco")
            used = (primitive["attributes"].get("POSITION"), primitive.get("indices"))
            accessors = [tree["accessors"][number] for number in used if number is not None]
            for is_wrong, what in (
                (mode == 6, "a triangle fan"),
                (any("sparse" in accessor for accessor in accessors), "a sparse accessor"),
                (any(accessor.get("normalized") for accessor in accessors), "normalized positions"),
            ):
                if is_wrong:
                    raise ValueError(f"mesh {at} has {what}, which trimesh does not decode")
    return ["points and lines are left out"] if modes & {0, 1, 2, 3} else []


_QUADS = _Format("FreeSurfer's quads", "nibabel.freesurfer", _read_quads)
_FIRST = {
    b"\xff\xff\xff": _QUADS,
    b"\xff\xff\xfd": _QUADS,
    b"$MeshFormat": _Format("an MSH file", "meshio.gmsh", _read_gmsh),
    b"glTF": _Format("a GLB file", "trimesh", _reads_scene("glb")),
    b"PK\x03\x04": _Format("a 3MF file", "trimesh", _reads_scene("3mf")),
}
_WITHIN = {
    b"<VTKFile": _Format("a file of VTK's XML", "pyvista", _read_vtk),
    b"<GIFTI": _Format("a GIFTI surface", "nibabel", _read_gifti),
    b'"asset"': _Format("a glTF file", "trimesh", _reads_scene("gltf")),
}
_LATE = {".gii": b"<GIFTI", ".gltf": b'"asset"'}
_VTK_KINDS = {"PolyData": ".vtp", "UnstructuredGrid": ".vtu"}
# Extensions that say how a mesh looks, or that trimesh decodes.
_GLTF_READ = re.compile(r"[A-Z]+_(materials|texture|lights)_\w+|KHR_mesh_quantization|KHR_draco_mesh_compression")


class Writing(NamedTuple):
    """What is written: positions, triangles or polygons as for `MeshIndex`, values by name, colors or None."""

    positions: Any
    corners: Any
    offsets: Any
    values: list[tuple[str, Any]]
    colors: Any

    def triangles(self, extension: str) -> Any:
        if self.offsets is not None and not np.all(np.diff(self.offsets) == 3):
            raise ValueError(f"F: polygons, expected triangles for {extension}; .ply, .vtk and .vtp take polygons")
        return np.asarray(self.corners).reshape(-1, 3)


def bytes_of(extension: str, writing: Writing, path: str) -> bytes:
    """The file. `extension`: one of `WRITERS`."""
    module, write = WRITERS[extension]
    return write(optional(module, f"{path}: writing {extension}"), writing, path)


def _gifti(nibabel: Any, arrays: Iterable[tuple[Any, str, str]]) -> bytes:
    made = []
    for data, intent, name in arrays:
        array = nibabel.gifti.GiftiDataArray(np.ascontiguousarray(data), intent=f"NIFTI_INTENT_{intent}")
        if name:
            array.meta["Name"] = name
        made.append(array)
    return nibabel.GiftiImage(darrays=made).to_bytes()


def _write_gifti(nibabel: Any, writing: Writing, path: str) -> bytes:
    """A surface, or of .shape.gii and .func.gii the values alone, as programs expect them."""
    kind = os.path.splitext(os.path.splitext(path)[0])[1].lower()
    if kind == ".label":
        raise ValueError("path: .label.gii, expected .surf.gii, .shape.gii or .func.gii")
    if kind not in (".shape", ".func"):
        if writing.values:
            raise ValueError("values: expected None for a surface; .shape.gii and .func.gii have values without it")
        triangles = writing.triangles(".gii").astype(np.int32)
        return _gifti(nibabel, [(writing.positions, "POINTSET", ""), (triangles, "TRIANGLE", "")])
    if not writing.values:
        raise ValueError(f"values: expected some for {kind}.gii, which has only values")
    vectors = [name for name, numbers in writing.values if numbers.ndim > 1]
    if vectors:
        raise ValueError(f"values[{vectors[0]!r}]: vectors, expected numbers (#V,) for {kind}.gii")
    intent = "SHAPE" if kind == ".shape" else "NONE"
    return _gifti(nibabel, [(numbers, intent, name) for name, numbers in writing.values])


def _write_vtp(pyvista: Any, writing: Writing, path: str) -> bytes:
    mesh = poly_data(pyvista, writing.positions, writing.corners, writing.offsets)
    for name, numbers in writing.values:
        if any(letter in name for letter in "\"&<>"):
            raise ValueError(f"values[{name!r}]: expected a name without \" & < > for .vtp, where VTK does not escape them")
        mesh.point_data[name] = numbers
    if writing.colors is not None:
        mesh.point_data["RGB"] = writing.colors
    with tempfile.TemporaryDirectory() as folder:  # VTK writes only to a path
        file = os.path.join(folder, "mesh.vtp")
        mesh.save(file)
        with open(file, "rb") as written:
            return written.read()


def _write_glb(trimesh: Any, writing: Writing, path: str) -> bytes:
    if len(writing.positions) and not len(writing.corners):
        raise ValueError("F: no faces, which .glb cannot do without; .ply, .vtk and .vtp take vertices alone")
    mesh = trimesh.Trimesh(
        writing.positions, writing.triangles(".glb"), vertex_colors=writing.colors, process=False, validate=False
    )
    mesh.vertex_attributes.update(writing.values)
    return mesh.export(file_type="glb")


WRITERS: dict[str, tuple[str, Callable[[Any, Writing, str], bytes]]] = {
    ".gii": ("nibabel", _write_gifti),
    ".vtp": ("pyvista", _write_vtp),
    ".glb": ("trimesh", _write_glb),
}
