#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws a colored mesh, as `meshhood compare -o` writes it, into a PNG. Needs Pillow.

The view is orthographic. If the mesh has a query, the camera faces the surface at its vertex, and the picture is as wide
as the ball and a margin. `--cut` removes the part of the mesh on one side of that vertex, which opens a rolled or folded
sheet. `--legend` writes above the picture what the colors mean, with the number of vertices.
"""
import argparse
import functools
import math
import struct
import sys
from array import array

from PIL import Image, ImageDraw, ImageFont

# As in cli/mesh_file.h, and on the page.
EXACT_COLOR = (0, 158, 115)
PAPER_COLOR = (240, 228, 66)
BALL_COLOR = (0, 114, 178)
QUERY_COLOR = (213, 94, 0)
REST_COLOR = (217, 219, 224)
BACKGROUND = (255, 255, 255)
INK = (23, 32, 51)
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

    @functools.cache
    def query(self):
        """The vertex of the query, or None."""
        return self.colors.index(QUERY_COLOR) if self.colors.count(QUERY_COLOR) == 1 else None

    def subject(self):
        """The positions of the vertices that are not gray; of all if there are none."""
        return [p for p, color in zip(self.positions, self.colors) if color != REST_COLOR] or self.positions

    @functools.cache
    def radius(self):
        """About that of the ball of the query: a vertex of an answer is near its surface."""
        center = self.positions[self.query()]
        return max(math.dist(center, p) for p in self.subject())


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

    def fill(self, corners, color_at):
        """A triangle in projected coordinates. `color_at` gives the color of a place by the weights of the corners."""
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
                    self.image[3 * at:3 * at + 3] = bytes(map(int, color_at(u, v, w)))

    def picture(self):
        """At half the size: the mean of each two by two pixels."""
        image = Image.frombytes("RGB", (self.pixels, self.pixels), bytes(self.image))
        return image.resize((self.pixels // 2, self.pixels // 2), Image.Resampling.BOX)


def lights(mesh, camera):
    """Of each vertex, in the light of a lamp above the left shoulder; both sides of the surface alike."""
    lamp = unit(tuple(sum(LIGHT[i] * camera.axes[i][axis] for i in range(3)) for axis in range(3)))
    return [0.6 + 0.4 * abs(dot(normal, lamp)) for normal in mesh.normals]


def mixed(colors, light):
    """Colors that are interpolated."""
    a, b, c = (tuple(light[i] * part for part in colors[i]) for i in range(3))
    return lambda u, v, w: [u * x + v * y + w * z for x, y, z in zip(a, b, c)]


def cut_by_ball(mesh, corners, colors, light):
    """The colors of a triangle on the border of an answer: that of its nearest corner in the answer, within the ball."""
    places = [mesh.positions[v] for v in corners]
    inner = [i for i in range(3) if colors[i] != REST_COLOR]
    center, radius = mesh.positions[mesh.query()], mesh.radius()

    def color_at(*weights):
        place = [sum(weight * p[axis] for weight, p in zip(weights, places)) for axis in range(3)]
        color = colors[max(inner, key=weights.__getitem__)] if math.dist(place, center) <= radius else REST_COLOR
        shade = sum(weight * x for weight, x in zip(weights, light))
        return [shade * part for part in color]

    return color_at


def draw(mesh, camera, pixels, cut):
    canvas = Canvas(pixels)
    points = [camera.project(position, pixels) for position in mesh.positions]
    light = lights(mesh, camera)
    query = mesh.query()
    colors = mesh.colors
    if query is not None:
        colors = [EXACT_COLOR if color == QUERY_COLOR else color for color in colors]  # a marker shows the vertex
    kept = [True] * len(points)
    if cut and query is not None:
        kept = [dot(minus(p, mesh.positions[query]), cut) <= 1e-6 * camera.width for p in mesh.positions]
    inside = [0 <= p[0] < pixels and 0 <= p[1] < pixels for p in points]
    for corners in mesh.triangles:
        if not all(kept[v] for v in corners) or not any(inside[v] for v in corners):
            continue
        own, own_light = [colors[v] for v in corners], [light[v] for v in corners]
        is_border = query is not None and len(set(own)) > 1
        color_at = cut_by_ball(mesh, corners, own, own_light) if is_border else mixed(own, own_light)
        canvas.fill([points[v] for v in corners], color_at)
    picture = canvas.picture()
    if query is not None:
        middle, size = picture.width / 2, picture.width / 90
        draw_circle(picture, middle, mesh.radius() / camera.width * picture.width, INK, 1.5)
        draw_circle(picture, middle, 1.35 * size, BACKGROUND)
        draw_circle(picture, middle, size, QUERY_COLOR)
    return picture


def draw_circle(picture, middle, radius, color, width=None):
    """A disc around the middle of the picture, or its rim if it has a width."""
    scale = 4  # drawn larger, for a smooth rim
    stencil = Image.new("L", (scale * picture.width, scale * picture.height))
    low, high = scale * (middle - radius), scale * (middle + radius)
    look = {"fill": 255} if width is None else {"outline": 255, "width": round(scale * width)}
    ImageDraw.Draw(stencil).ellipse((low, low, high, high), **look)
    picture.paste(color, (0, 0), stencil.resize(picture.size, Image.Resampling.BOX))


def legend_rows(mesh):
    """Colors, what they mean, in the words of the page, and how many vertices that are, where it can be several."""
    exact, paper, ball = (mesh.colors.count(color) for color in (EXACT_COLOR, PAPER_COLOR, BALL_COLOR))
    return [(EXACT_COLOR, "connected within the ball: the answer", exact + mesh.colors.count(QUERY_COLOR)),
            (BALL_COLOR, "near, but not connected", ball + paper),
            (PAPER_COLOR, "of these, extra of the approximate method", paper),
            (QUERY_COLOR, "the vertex, in the middle of the ball", None)]


def load_font(size):
    try:
        return ImageFont.truetype("DejaVuSans.ttf", size)
    except OSError:  # Pillow has a font of its own
        return ImageFont.load_default(size)


def with_legend(picture, rows):
    """The picture with the rows above it."""
    size = max(picture.width // 40, 10)
    line, margin = round(1.6 * size), size
    top = 2 * margin + line * len(rows)
    whole = Image.new("RGB", (picture.width, top + picture.height), BACKGROUND)
    whole.paste(picture, (0, top))
    font, pen = load_font(size), ImageDraw.Draw(whole)
    numbers = ["" if count is None else f"{count:,}" for _, _, count in rows]
    right = 2 * margin + size + max(pen.textlength(words, font) for _, words, _ in rows)
    right += margin + max(pen.textlength(number, font) for number in numbers)
    for i, ((color, words, _), number) in enumerate(zip(rows, numbers)):
        y = margin + line * i
        pen.rounded_rectangle((margin, y + size // 8, margin + size, y + size // 8 + size), size // 4, fill=color)
        pen.text((2 * margin + size, y), words, INK, font)
        pen.text((right - pen.textlength(number, font), y), number, INK, font)
    return whole


def choose_camera(mesh, options):
    query, subject = mesh.query(), mesh.subject()
    if query is None:
        low, high = ([bound(p[axis] for p in subject) for axis in range(3)] for bound in (min, max))
        center, width = [(a + b) / 2 for a, b in zip(low, high)], math.dist(low, high)
        normal = (1.0, 1.0, 1.0)
    else:
        center, normal = mesh.positions[query], mesh.normals[query]
        width = 2 * mesh.radius()
    return Camera(options.towards or normal, options.up, center, options.zoom * (width or 1.0))


def vector(text):
    return tuple(float(part) for part in text.split(","))


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", metavar="IN.ply", help="colored mesh")
    parser.add_argument("picture", metavar="OUT.png")
    parser.add_argument("--towards", type=vector, metavar="X,Y,Z", help="direction from the mesh to the eye")
    parser.add_argument("--up", type=vector, metavar="X,Y,Z", default=(0.0, 0.0, 1.0), help="default 0,0,1")
    parser.add_argument("--zoom", type=float, default=1.2,
                        help="width of the picture over that of the ball, or of the colored part without a query")
    parser.add_argument("--pixels", type=int, default=800, help="width of the picture")
    parser.add_argument("--cut", type=vector, metavar="X,Y,Z", help="remove what lies on that side of the vertex")
    parser.add_argument("--legend", action="store_true", help="say above the picture what the colors mean")
    return parser.parse_args()


def main():
    options = parse_arguments()
    mesh = Mesh(options.mesh)
    picture = draw(mesh, choose_camera(mesh, options), 2 * options.pixels, options.cut)
    if options.legend:
        picture = with_legend(picture, legend_rows(mesh))
    picture.save(options.picture, optimize=True)


if __name__ == "__main__":
    main()
