#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws a coloured mesh, as `meshhood compare -o` writes it, into a PNG. Needs numpy and nothing else.

The view is orthographic. By default it looks at the red vertex from where the surface there faces; `--cut` takes away
what lies on one side of that vertex, so that one sees into a rolled or folded sheet. Several meshes are drawn side by
side from the same place.
"""
import argparse
import struct
import sys
import zlib

import numpy as np

QUERY_COLOR = (225, 25, 25)
REST_COLOR = (222, 222, 222)
BACKGROUND = (255, 255, 255)
SCALARS = {
    "char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1", "short": "i2", "int16": "i2", "ushort": "u2",
    "uint16": "u2", "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4", "float": "f4", "float32": "f4",
    "double": "f8", "float64": "f8",
}


def read_header(file):
    """The elements of a binary little-endian PLY: name, count, properties as lists of words."""
    elements = []
    for line in iter(file.readline, b""):
        words = line.decode("ascii").split()
        if words[0] == "end_header":
            return elements
        if words[0] == "format" and words[1] != "binary_little_endian":
            sys.exit(f"{file.name}: expected a binary little-endian PLY, as meshhood writes it")
        if words[0] == "element":
            elements.append((words[1], int(words[2]), []))
        if words[0] == "property":
            elements[-1][2].append(words[1:])
    sys.exit(f"{file.name}: the header does not end")


def read_faces(data, count, properties):
    """Polygons as fans of triangles. `properties`: one list."""
    _, size_type, index_type, _ = properties[0]
    size_bytes, index_bytes = (np.dtype(SCALARS[t]).itemsize for t in (size_type, index_type))
    row = np.dtype([("size", "<" + SCALARS[size_type]), ("corners", "<" + SCALARS[index_type], 3)])
    if len(data) == count * row.itemsize:
        rows = np.frombuffer(data, row, count)
        if np.all(rows["size"] == 3):
            return rows["corners"].astype(np.int64)
    triangles, at = [], 0
    for _ in range(count):
        size = int.from_bytes(data[at:at + size_bytes], "little")
        at += size_bytes
        corners = np.frombuffer(data, "<" + SCALARS[index_type], size, at).astype(np.int64)
        at += size * index_bytes
        triangles += [(corners[0], corners[i], corners[i + 1]) for i in range(1, size - 1)]
    return np.array(triangles, np.int64).reshape(-1, 3)


class Mesh:
    """Positions (#V by 3), colours (#V by 3, 0 to 255), triangles (#F by 3) and unit normals of the vertices."""

    def __init__(self, path):
        with open(path, "rb") as file:
            (_, vertices, properties), (_, faces, lists) = read_header(file)
            columns = np.dtype([(name, "<" + SCALARS[kind]) for kind, name in properties])
            table = np.frombuffer(file.read(vertices * columns.itemsize), columns)
            self.triangles = read_faces(file.read(), faces, lists)
        self.positions = np.stack([table[axis] for axis in "xyz"], 1).astype(float)
        if "red" in columns.names:
            self.colors = np.stack([table[channel] for channel in ("red", "green", "blue")], 1)
        else:
            self.colors = np.tile(np.array(REST_COLOR), (vertices, 1))
        self.normals = self.vertex_normals()

    def vertex_normals(self):
        a, b, c = (self.positions[self.triangles[:, i]] for i in range(3))
        normals = np.zeros_like(self.positions)
        for i in range(3):
            np.add.at(normals, self.triangles[:, i], np.cross(b - a, c - a))
        return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)

    def query(self):
        """The red vertex, or nothing."""
        found = np.flatnonzero(np.all(self.colors == QUERY_COLOR, axis=1))
        return found[0] if len(found) == 1 else None

    def region(self):
        """The vertices that are not grey."""
        return np.flatnonzero(np.any(self.colors != REST_COLOR, axis=1))


class Camera:
    """Right, up and towards the eye; what is at `center` comes to the middle, `width` fills the picture."""

    def __init__(self, towards, up, center, width):
        towards = towards / np.linalg.norm(towards)
        right = np.cross(up, towards)
        if np.linalg.norm(right) < 1e-6:
            right = np.cross([0.3, 1.0, 0.2], towards)
        right /= np.linalg.norm(right)
        self.axes = np.stack([right, np.cross(towards, right), towards])
        self.center = center
        self.width = width

    def project(self, positions, pixels):
        """Pixels from the upper left corner, and depth in pixels, growing towards the eye."""
        p = (positions - self.center) @ self.axes.T * (pixels / self.width)
        return np.stack([p[:, 0] + pixels / 2, pixels / 2 - p[:, 1], p[:, 2]], 1)


def fragments(corners, pixels):
    """All pixels that the triangles (`#F by 3 by 3`) cover, a batch at a time: triangle, pixel, weights of corners."""
    low = np.floor(corners[:, :, :2].min(1)).astype(int)
    extent = (np.ceil(corners[:, :, :2].max(1)).astype(int) - low).max(1)
    a, b, c = (corners[:, i, :2] for i in range(3))
    area = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    visible = (np.abs(area) > 1e-9) & (low + extent[:, None] >= 0).all(1) & (low < pixels).all(1)
    reach = 1
    while np.any(visible & (extent > reach // 2)):
        batch = np.flatnonzero(visible & (extent <= reach) & (extent > reach // 2))
        for dy in range(reach + 1) if len(batch) else ():
            for dx in range(reach + 1):
                pixel = low[batch] + (dx, dy)
                at = pixel + 0.5
                weights = [
                    ((q[batch, 0] - p[batch, 0]) * (at[:, 1] - p[batch, 1])
                     - (q[batch, 1] - p[batch, 1]) * (at[:, 0] - p[batch, 0])) / area[batch]
                    for p, q in ((b, c), (c, a), (a, b))
                ]
                weights = np.stack(weights, 1)
                inside = (weights >= 0).all(1) & (pixel >= 0).all(1) & (pixel < pixels).all(1)
                yield batch[inside], pixel[inside, 1] * pixels + pixel[inside, 0], weights[inside]
        reach *= 2


def shade(mesh, camera):
    """The colours of the vertices in the light of a lamp above the left shoulder; both sides of the surface alike."""
    lamp = camera.axes.T @ (np.array([-0.35, 0.45, 1.0]) / np.linalg.norm([-0.35, 0.45, 1.0]))
    facing = np.abs(mesh.normals @ lamp)
    return mesh.colors * (0.45 + 0.55 * facing[:, None])


def draw(mesh, camera, pixels, cut):
    """The picture as `pixels by pixels by 3`, 0 to 255."""
    points = camera.project(mesh.positions, pixels)
    triangles = mesh.triangles
    query = mesh.query()
    if cut and query is not None:
        beyond = (mesh.positions - mesh.positions[query]) @ np.array(cut)
        triangles = triangles[(beyond[triangles] <= 1e-6 * camera.width).all(1)]
    corners = points[triangles]
    depth = np.full(pixels * pixels, -np.inf)
    pieces = list(fragments(corners, pixels))
    for triangle, pixel, weights in pieces:
        np.maximum.at(depth, pixel, (weights * corners[triangle, :, 2]).sum(1))
    image = np.tile(np.array(BACKGROUND, float), (pixels * pixels, 1))
    colors = shade(mesh, camera)
    for triangle, pixel, weights in pieces:
        front = (weights * corners[triangle, :, 2]).sum(1) >= depth[pixel] - 1e-9
        shown = triangles[triangle[front]]
        image[pixel[front]] = (weights[front][:, :, None] * colors[shown]).sum(1)
    image = image.reshape(pixels, pixels, 3)
    if query is not None:
        dot(image, points[query, :2], pixels / 90)
    return image


def dot(image, center, radius):
    y, x = np.mgrid[0:image.shape[0], 0:image.shape[1]]
    distance = np.hypot(x + 0.5 - center[0], y + 0.5 - center[1])
    image[distance < 1.35 * radius] = BACKGROUND
    image[distance < radius] = QUERY_COLOR


def smoothed(image, factor):
    """The mean of `factor by factor` pixels each."""
    pixels = image.shape[0] // factor
    return image.reshape(pixels, factor, pixels, factor, 3).mean((1, 3))


def write_png(path, image):
    """`image`: height by width by 3, 0 to 255."""
    height, width, _ = image.shape
    rows = np.zeros((height, 1 + 3 * width), np.uint8)
    rows[:, 1:] = np.clip(np.rint(image), 0, 255).astype(np.uint8).reshape(height, -1)
    # Each row as its difference from the one above, which packs far better.
    rows[1:, 1:] -= rows[:-1, 1:].copy()
    rows[1:, 0] = 2

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        file.write(chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)))
        file.write(chunk(b"IDAT", zlib.compress(rows.tobytes(), 9)))
        file.write(chunk(b"IEND", b""))


def choose_camera(mesh, options):
    query, region = mesh.query(), mesh.region()
    subject = mesh.positions[region] if len(region) else mesh.positions
    low, high = subject.min(0), subject.max(0)
    center = mesh.positions[query] if query is not None else (low + high) / 2
    towards = mesh.normals[query] if query is not None else np.array([1.0, 1.0, 1.0])
    if options.towards:
        towards = np.array(options.towards)
    return Camera(towards, np.array(options.up), center, options.zoom * np.linalg.norm(high - low))


def vector(text):
    return [float(part) for part in text.split(",")]


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="+", metavar="IN.ply", help="coloured meshes")
    parser.add_argument("picture", metavar="OUT.png")
    parser.add_argument("--towards", type=vector, metavar="X,Y,Z", help="the direction from the mesh to the eye")
    parser.add_argument("--up", type=vector, metavar="X,Y,Z", default=[0.0, 0.0, 1.0], help="default 0,0,1")
    parser.add_argument("--zoom", type=float, default=1.6, help="width of the picture over that of what is coloured")
    parser.add_argument("--pixels", type=int, default=800, help="height of the picture")
    parser.add_argument("--cut", type=vector, metavar="X,Y,Z", help="take away what lies on that side of the red vertex")
    return parser.parse_args()


def main():
    options = parse_arguments()
    meshes = [Mesh(path) for path in options.meshes]
    widest = max(meshes, key=lambda mesh: len(mesh.region()))
    camera = choose_camera(widest, options)
    panels = [smoothed(draw(mesh, camera, 2 * options.pixels, options.cut), 2) for mesh in meshes]
    write_png(options.picture, np.concatenate(panels, axis=1))


if __name__ == "__main__":
    main()
