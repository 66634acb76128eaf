#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws a colored mesh, as `meshhood compare -o` writes it, into a PNG. Needs only the standard library.

The view is orthographic. By default the camera faces the surface at the red vertex. `--cut` removes the part of the
mesh on one side of that vertex, which opens a rolled or folded sheet.
"""
import argparse
import math
import struct
import sys
import zlib
from array import array

QUERY_COLOR = (225, 25, 25)
REST_COLOR = (222, 222, 222)
BACKGROUND = (255, 255, 255)
LIGHT = (-0.35, 0.45, 1.0)  # right, up and towards the eye
SCALARS = {
    "char": "b", "int8": "b", "uchar": "B", "uint8": "B", "short": "h", "int16": "h", "ushort": "H", "uint16": "H",
    "int": "i", "int32": "i", "uint": "I", "uint32": "I", "float": "f", "float32": "f", "double": "d", "float64": "d",
}


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def minus(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def unit(a):
    length = math.sqrt(dot(a, a))
    return (a[0] / length, a[1] / length, a[2] / length) if length > 0 else (0.0, 0.0, 1.0)


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


def read_triangles(data, count, properties):
    """Polygons as fans of triangles. `properties`: one list."""
    _, size_type, index_type, _ = properties[0]
    size_of, triangle = struct.Struct("<" + SCALARS[size_type]), struct.Struct("<3" + SCALARS[index_type])
    if len(data) == count * (size_of.size + triangle.size):
        row = struct.Struct("<" + SCALARS[size_type] + "3" + SCALARS[index_type])
        if all(fields[0] == 3 for fields in row.iter_unpack(data)):
            return [fields[1:] for fields in row.iter_unpack(data)]
    triangles, at = [], 0
    for _ in range(count):
        (size,) = size_of.unpack_from(data, at)
        corners = struct.unpack_from(f"<{size}{SCALARS[index_type]}", data, at + size_of.size)
        at += size_of.size + struct.calcsize(f"<{size}{SCALARS[index_type]}")
        triangles += [(corners[0], corners[i], corners[i + 1]) for i in range(1, size - 1)]
    return triangles


class Mesh:
    """Positions, colors and unit normals of the vertices, and triangles."""

    def __init__(self, path):
        with open(path, "rb") as file:
            (_, vertices, properties), (_, faces, lists) = read_header(file)
            row = struct.Struct("<" + "".join(SCALARS[kind] for kind, _ in properties))
            table = list(row.iter_unpack(file.read(vertices * row.size)))
            self.triangles = read_triangles(file.read(), faces, lists)
        names = [name for _, name in properties]
        x, y, z = (names.index(axis) for axis in "xyz")
        self.positions = [(fields[x], fields[y], fields[z]) for fields in table]
        self.colors = [REST_COLOR] * vertices
        if "red" in names:
            red, green, blue = (names.index(channel) for channel in ("red", "green", "blue"))
            self.colors = [(fields[red], fields[green], fields[blue]) for fields in table]
        self.normals = self.vertex_normals()

    def vertex_normals(self):
        sums = [(0.0, 0.0, 0.0)] * len(self.positions)
        for a, b, c in self.triangles:
            p = self.positions[a]
            normal = cross(minus(self.positions[b], p), minus(self.positions[c], p))
            for v in (a, b, c):
                s = sums[v]
                sums[v] = (s[0] + normal[0], s[1] + normal[1], s[2] + normal[2])
        return [unit(normal) for normal in sums]

    def query(self):
        """The red vertex, or None."""
        return self.colors.index(QUERY_COLOR) if self.colors.count(QUERY_COLOR) == 1 else None

    def subject(self):
        """The positions of the vertices that are not gray; of all if there are none."""
        return [p for p, color in zip(self.positions, self.colors) if color != REST_COLOR] or self.positions


class Camera:
    """Axes to the right, up and towards the eye; `center` is in the middle of the picture, which is `width` wide."""

    def __init__(self, towards, up, center, width):
        towards = unit(towards)
        right = cross(up, towards)
        if dot(right, right) < 1e-12:
            right = cross((0.3, 1.0, 0.2), towards)
        right = unit(right)
        self.axes = (right, cross(towards, right), towards)
        self.center, self.width = center, width

    def project(self, position, pixels):
        """Pixels from the upper left corner, and depth in pixels, which grows towards the eye."""
        p, scale = minus(position, self.center), pixels / self.width
        return (dot(p, self.axes[0]) * scale + pixels / 2, pixels / 2 - dot(p, self.axes[1]) * scale,
                dot(p, self.axes[2]) * scale)


class Canvas:
    """A square picture with the depth of each pixel."""

    def __init__(self, pixels):
        self.pixels = pixels
        self.depth = array("d", [-math.inf]) * (pixels * pixels)
        self.image = bytearray(bytes(BACKGROUND) * (pixels * pixels))

    def fill(self, corners, colors):
        """A triangle in projected coordinates, whose colors are interpolated."""
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = corners
        area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        if abs(area) < 1e-9:
            return
        columns = range(max(0, math.ceil(min(ax, bx, cx) - 0.5)), min(self.pixels, math.floor(max(ax, bx, cx) + 0.5)))
        for y in range(max(0, math.ceil(min(ay, by, cy) - 0.5)), min(self.pixels, math.floor(max(ay, by, cy) + 0.5))):
            for x in columns:
                u = ((cx - bx) * (y + 0.5 - by) - (cy - by) * (x + 0.5 - bx)) / area
                v = ((ax - cx) * (y + 0.5 - cy) - (ay - cy) * (x + 0.5 - cx)) / area
                w = 1 - u - v
                at = y * self.pixels + x
                if u >= 0 and v >= 0 and w >= 0 and u * az + v * bz + w * cz > self.depth[at]:
                    self.depth[at] = u * az + v * bz + w * cz
                    self.image[3 * at:3 * at + 3] = bytes(int(u * a + v * b + w * c) for a, b, c in zip(*colors))

    def disc(self, center, radius, color):
        for y in range(max(0, int(center[1] - radius)), min(self.pixels, int(center[1] + radius) + 2)):
            for x in range(max(0, int(center[0] - radius)), min(self.pixels, int(center[0] + radius) + 2)):
                if math.hypot(x + 0.5 - center[0], y + 0.5 - center[1]) < radius:
                    at = 3 * (y * self.pixels + x)
                    self.image[at:at + 3] = bytes(color)

    def halved(self):
        """The rows of the picture at half the size: the mean of each two by two pixels."""
        stride = 3 * self.pixels
        for y in range(0, self.pixels, 2):
            upper, lower = self.image[y * stride:(y + 1) * stride], self.image[(y + 1) * stride:(y + 2) * stride]
            sums = [a + b for a, b in zip(upper, lower)]
            row = bytearray(stride // 2)
            for channel in range(3):
                row[channel::3] = bytes((a + b + 2) // 4 for a, b in zip(sums[channel::6], sums[channel + 3::6]))
            yield row


def shaded_colors(mesh, camera):
    """The colors of the vertices in the light of a lamp above the left shoulder; both sides of the surface alike."""
    lamp = unit(tuple(sum(LIGHT[i] * camera.axes[i][axis] for i in range(3)) for axis in range(3)))
    colors = []
    for color, normal in zip(mesh.colors, mesh.normals):
        light = 0.45 + 0.55 * abs(dot(normal, lamp))
        colors.append((color[0] * light, color[1] * light, color[2] * light))
    return colors


def draw(mesh, camera, pixels, cut):
    canvas = Canvas(pixels)
    points = [camera.project(position, pixels) for position in mesh.positions]
    colors = shaded_colors(mesh, camera)
    query = mesh.query()
    kept = [True] * len(points)
    if cut and query is not None:
        kept = [dot(minus(p, mesh.positions[query]), cut) <= 1e-6 * camera.width for p in mesh.positions]
    inside = [0 <= p[0] < pixels and 0 <= p[1] < pixels for p in points]
    for corners in mesh.triangles:
        if all(kept[v] for v in corners) and any(inside[v] for v in corners):
            canvas.fill([points[v] for v in corners], [colors[v] for v in corners])
    if query is not None:
        canvas.disc(points[query], 1.35 * pixels / 90, BACKGROUND)
        canvas.disc(points[query], pixels / 90, QUERY_COLOR)
    return canvas


def write_png(path, rows):
    """`rows`: the red, green and blue bytes of each row."""
    above = bytes(len(rows[0]))
    data = bytearray()
    for row in rows:
        data.append(2)  # filter: the difference from the row above
        data += bytes((a - b) & 255 for a, b in zip(row, above))
        above = row

    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        file.write(chunk(b"IHDR", struct.pack(">IIBBBBB", len(rows[0]) // 3, len(rows), 8, 2, 0, 0, 0)))
        file.write(chunk(b"IDAT", zlib.compress(bytes(data), 9)))
        file.write(chunk(b"IEND", b""))


def choose_camera(mesh, options):
    query, subject = mesh.query(), mesh.subject()
    low, high = ([bound(p[axis] for p in subject) for axis in range(3)] for bound in (min, max))
    center = mesh.positions[query] if query is not None else [(a + b) / 2 for a, b in zip(low, high)]
    towards = options.towards or (mesh.normals[query] if query is not None else (1.0, 1.0, 1.0))
    return Camera(towards, options.up, center, options.zoom * (math.dist(low, high) or 1.0))


def vector(text):
    return tuple(float(part) for part in text.split(","))


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", metavar="IN.ply", help="colored mesh")
    parser.add_argument("picture", metavar="OUT.png")
    parser.add_argument("--towards", type=vector, metavar="X,Y,Z", help="direction from the mesh to the eye")
    parser.add_argument("--up", type=vector, metavar="X,Y,Z", default=(0.0, 0.0, 1.0), help="default 0,0,1")
    parser.add_argument("--zoom", type=float, default=1.6, help="width of the picture over that of the colored part")
    parser.add_argument("--pixels", type=int, default=800, help="height of the picture")
    parser.add_argument("--cut", type=vector, metavar="X,Y,Z", help="remove what lies on that side of the red vertex")
    return parser.parse_args()


def main():
    options = parse_arguments()
    mesh = Mesh(options.mesh)
    canvas = draw(mesh, choose_camera(mesh, options), 2 * options.pixels, options.cut)
    write_png(options.picture, list(canvas.halved()))


if __name__ == "__main__":
    main()
