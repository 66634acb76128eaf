#!/usr/bin/env python3
"""Adds the first inputs of each fuzzer, small files that reach all parts of the readers, to its archive in fuzz/corpus."""
import json
import random
import struct

import corpus

ELEMENTS = (
    "element vertex 3\nproperty float x\nproperty double y\nproperty short z\nproperty list uchar float extra\n"
    "element face 2\nproperty list uchar int vertex_indices\n"
    "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
)


def ply_text(body, header=ELEMENTS, form="ascii"):
    return f"ply\nformat {form} 1.0\ncomment seed\n{header}{body}".encode()


def ply_binary(order):
    form = {"<": "binary_little_endian", ">": "binary_big_endian"}[order]
    body = b"".join(struct.pack(order + "fdhBf", x, 1, 2, 1, 0.5) for x in range(3))
    body += struct.pack(order + "BiiiB", 3, 0, 1, 2, 0) + struct.pack(order + "iiiii", 4, 0, 1, 2, -1)
    return ply_text("", form=form) + body


def grid_ply(side):
    vertices = [f"{x} {y} {x * y % 3}" for y in range(side) for x in range(side)]
    faces = [f"4 {i} {i + 1} {i + side + 1} {i + side}" for i in range(side * (side - 1)) if i % side < side - 1]
    header = (f"element vertex {len(vertices)}\nproperty float x\nproperty float y\nproperty float z\n"
              f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
    return ply_text("\n".join(vertices + faces) + "\n", header)


def stl_binary(name, facets):
    data = name.ljust(80, b"\0") + struct.pack("<I", len(facets))
    return data + b"".join(struct.pack("<12fH", 0, 0, 0, *facet, 0) for facet in facets)


def stl_text(facets):
    lines = ["solid a"]
    for facet in facets:
        lines += ["facet normal 0 0 1", "outer loop"]
        lines += ["vertex {} {} {}".format(*facet[i:i + 3]) for i in (0, 3, 6)]
        lines += ["endloop", "endfacet"]
    return "\n".join(lines + ["endsolid a", ""]).encode()


def vtk(encoding, points, cells, before=b"", version="4.2"):
    head = f"# vtk DataFile Version {version}\nt\n{encoding}\nDATASET POLYDATA\n".encode()
    return head + before + b"POINTS 3 float\n" + points + b"\n" + cells + b"\n"


XYZ_BYTES = struct.pack(">9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
FACETS = [(0, 0, 0, 1, 0, 0, 0, 1, 0), (1, 0, 0, 1, 1, 0, 0, 1, -0.0)]
XYZ = "property float x\nproperty float y\nproperty float z\n"

SEEDS = {
    "ply": {
        "text": ply_text("0 0 0 0\n1 1e-3 -7 1 0.5\n+2 .5 3 2 1 1\n3 0 1 2\n1 0\n4 0 1 2 -1\n"),
        "little": ply_binary("<"),
        "big": ply_binary(">"),
        "grid": grid_ply(8),
        "no_faces": ply_text("1 2 3\n", f"element vertex 1\n{XYZ}end_header\n"),
        "no_vertices": ply_text("", f"element vertex 0\n{XYZ}end_header\n"),
        "faces_first": ply_text("3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n", "element face 1\nproperty list char uint vertex_index\n"
                                f"element vertex 3\n{XYZ}end_header\n"),
        "crlf": ply_text("0 0 0\n", f"element vertex 1\n{XYZ}end_header\n").replace(b"\n", b"\r\n"),
        "unknown": ply_text("0 0 0\n", f"element nothing 1099511627776\nelement vertex 1\n{XYZ}end_header\n"),
        "huge": ply_text("0 0 0\n", f"element vertex 1099511627776\n{XYZ}end_header\n"),
    },
    "obj": {
        "all": b"# c\nv 0 0 0\nv 1 0 0 0.5\nv 1 1 0 1 1 1\nvt 0 0\nf 1/1 2//1 \\\n 3/1/1\nf -1 -2 -3\nl 1 2\ng a\n",
        "polygon": b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n",
        "relative": b"v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\nv 2 2 2\nf -1 -2 -3\n",
        "carriage_returns": b"v 0 0 0\rv 1 0 0\rv 1 1 0\rf 1 2 3\r",
        "mark": b"\xef\xbb\xbfv 1e-400 +1.5 -0\np 1\n",
        "zero": b"v 0 0 0\nf 0 1 1\n",
        "path": b"mtllib ../../etc/passwd\nv 0 0 0\ncall a\n",
    },
    "off": {
        "colors": b"COFF # c\n3 2 0\n0 0 0 1 1 1 1\n1 0 0 0 0 0 1\n0 1 0 0 0 0 1\n3 0 1 2 255 0 0\n2 1 0\n",
        "plain": b"OFF\n4 2 5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n4 0 1 2 3\n",
        "one_line": b"OFF 1 0 0\n1 2 3",
        "normals": b"NOFF\n1 0 0\n0 0 0 0 0 1\n",
        "texture": b"STOFF\n1 0 0\n0 0 0 0 1\n",
        "four": b"4OFF\n1 0 0\n0 0 0 1\n",
        "binary": b"OFF BINARY\n\0\0\0\1",
        "huge": b"OFF\n2000000000 1 0\n0 0 0\n",
    },
    "stl": {
        "text": stl_text(FACETS),
        "empty": stl_text([]),
        "binary": stl_binary(b"binary", FACETS),
        "solid": stl_binary(b"solid", FACETS),
        "none": stl_binary(b"", []),
        "nan": stl_binary(b"", [(float("nan"),) * 9]),
        "more": stl_binary(b"", FACETS) + b"more",
    },
    "vtk": {
        "text": vtk("ASCII", b"0 0 0 1 0 0\n0 1e2 -0\n", b"POLYGONS 2 7\n3 0 1 2\n2 0 1\n", b"FIELD a 1\nb 1 2 int\n1 2\n"),
        "binary": vtk("BINARY", XYZ_BYTES, b"POLYGONS 1 4\n" + struct.pack(">4i", 3, 0, 1, 2)),
        "offsets": vtk("ASCII", b"0 0 0 1 0 0 0 1 0", b"POLYGONS 2 3\nOFFSETS vtktypeint64\n0 3\nCONNECTIVITY vtktypeint64\n"
                       b"0 1 2\nMETADATA\nx\n\nCELL_DATA 1\n", version="5.1"),
        "binary_offsets": vtk("BINARY", XYZ_BYTES, b"POLYGONS 2 3\nOFFSETS vtktypeint64\n" + struct.pack(">2q", 0, 3)
                              + b"\nCONNECTIVITY vtktypeint32\n" + struct.pack(">3i", 0, 1, 2), version="5.1"),
        "grid": vtk("ASCII", b"0 0 0 1 0 0 0 1 0", b"CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n5\n").replace(b"POLYDATA", b"UNSTRUCTURED_GRID"),
    },
    "freesurfer": {
        "surface": b"\xff\xff\xfea\n\n" + struct.pack(">2i", 3, 1) + XYZ_BYTES + struct.pack(">3i", 0, 1, 2),
        "center": b"\xff\xff\xfea\n\n" + struct.pack(">2i", 3, 0) + XYZ_BYTES + b"\0\0\0\x14valid = 1\ncras = 1 2 3\n",
    },
    # vertices, surface (none, path, grid, star; rows), coordinates, exponent, seed; then coordinates and faces
    "mesh": {
        f"{surface}_{kind}_{seed}": struct.pack("<HBBhH", vertices, surface + 4 * 15, kind, exponent, seed) + bytes(body)
        for surface in range(4)
        for kind, exponent in ((0, 0), (129, 0), (130, 0), (132, -300), (133, 480), (134, 0))
        for seed, vertices, body in ((1, 30, range(64)), (2, 500, b""), (3, 300, [7, 1, 2, 200, 9, 40, 0, 3] * 40))
    },
}
# Calls, or numbers of any size after the kind of the kernel.
DRAW = random.Random(1)
SEEDS["calls"] = {f"random_{i}": DRAW.randbytes(40 + 4 * i) for i in range(40)}
SEEDS["kernels"] = {f"random_{i}": bytes([i % 4]) + DRAW.randbytes(900) for i in range(40)}
SEEDS["kernels"] |= {f"small_{i}": bytes([i % 4, 31, 255, 255, 255, 255, 3])
                     + struct.pack("<99f" if i % 4 != 1 else "<99d", *(DRAW.uniform(-1, 1) for _ in range(99)))
                     for i in range(20)}
SEEDS["any"] = {f"{kind}_{name}": data for kind in ("ply", "obj", "off", "stl", "vtk", "freesurfer")
                for name, data in SEEDS[kind].items()}



def npy(descr, shape, data, version=1, order=False):
    header = f"{{'descr': '{descr}', 'fortran_order': {order}, 'shape': {shape}, }}\n".encode()
    size = struct.pack("<H" if version == 1 else "<I", len(header))
    return b"\x93NUMPY" + bytes([version, 0]) + size + header + data


def arrays(positions, faces):
    """Two files after the head of the target, the size of the first."""
    return struct.pack("<H", len(positions)) + positions + faces


FLOATS = npy("<f4", "(4, 3)", struct.pack("<12f", *range(12)))
DOUBLES = npy(">f8", "(3, 3)", struct.pack(">9d", *range(9)), version=2)
INTEGERS = npy("<i8", "(2, 3)", struct.pack("<6q", 0, 1, 2, 2, 1, 3))
SEEDS["npy"] = {
    "triangles": arrays(FLOATS, INTEGERS),
    "big_endian": arrays(DOUBLES, npy(">i4", "(1, 4)", struct.pack(">4i", 0, 1, 2, 0), version=3)),
    "no_faces": arrays(FLOATS, npy("<i8", "(0, 3)", b"")),
    "no_columns": arrays(FLOATS, npy("<i8", "(1000000000000, 0)", b"")),
    "negative": arrays(FLOATS, npy("<i4", "(1, 3)", struct.pack("<3i", 0, -1, 2))),
    "fortran": arrays(FLOATS, npy("<i4", "(1, 3)", bytes(12), order=True)),
    "huge": arrays(npy("<f4", "(6148914691236517206, 3)", bytes(24)), INTEGERS),
    "truncated": arrays(FLOATS[:-1], INTEGERS),
    "unsigned": arrays(FLOATS, npy("<u8", "(2, 3)", struct.pack("<6Q", 0, 1, 2, 2, 1, 3))),
}
FILES = ("index.mhi", "vertices.npy", "owned.npy", "face_corners.npy", "face_offsets.npy")
PART = {"vertices": 20, "owned": 16, "faces": 24,
        "files": {name: {"bytes": 200, "checksum": "0123456789abcdef"} for name in FILES}}
PLAN = {"format": 1, "vertices": 32, "faces": 42, "precision": "float", "content_hash": "0123456789abcdef" * 2,
        "mean_edge_length": 1.2, "halo": 1.0, "parts": 2}


def document(kind, **values):
    """A JSON file of a folder after the byte that says which it is, without its first line."""
    return bytes([kind]) + json.dumps(values, indent=1)[1:].encode()


SEEDS["parts"] = {
    "manifest": document(0, plan=PLAN, parts=[PART, PART]),
    "manifest_of_one": document(0, plan=PLAN | {"parts": 1, "vertices": 16}, parts=[PART]),
    "manifest_of_nothing": document(0, plan=PLAN | {"parts": 0, "vertices": 0}, parts=[]),
    "negative": document(0, plan=PLAN | {"vertices": -1}, parts=[PART, PART]),
    "part": document(1, plan=PLAN, number=1, part=PART),
    "deep": bytes([0]) + b'"a": ' + b"[" * 1000,
    "unsealed": document(2, plan=PLAN, parts=[PART, PART]),
}
# Changes of files: which, how, where and with what.
SEEDS["parts"] |= {f"changes_{i}": bytes([3]) + DRAW.randbytes(5 * (1 + i % 6)) for i in range(24)}

# Positions that are sorted, or draws of nodes, links and parts.
SEEDS["rearrange"] = {f"random_{i}": bytes([i % 8]) + DRAW.randbytes(20 + 16 * i) for i in range(40)}

for target, seeds in SEEDS.items():
    corpus.write(target, corpus.read(target) | seeds)
    print(f"{target}: {len(seeds)} seeds")
