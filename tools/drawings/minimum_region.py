"""The minimum region of a leaf (src/exact/build/minimum_region.cpp): a vertex from above, a leaf from the side."""

import math

from svg import BLUE, GREEN, GREY, INK, ORANGE, PEACH, RED, Picture

NEIGHBORS = [(104, 8), (58, 92), (-46, 100), (-108, 18), (-70, -84), (48, -96)]


def clip(polygon, edge):
    """The part of `polygon` not nearer to the far end of `edge` than to the origin, where `edge` begins."""
    half = (edge[0] ** 2 + edge[1] ** 2) / 2

    def value(p):
        return p[0] * edge[0] + p[1] * edge[1] - half

    result = []
    for a, b in zip(polygon, polygon[1:] + polygon[:1]):
        if value(a) <= 0:
            result.append(a)
        if (value(a) <= 0) != (value(b) <= 0):
            t = value(a) / (value(a) - value(b))
            result.append((a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])))
    return result


def draw_cell(picture, x, y):
    def place(p):
        return x + p[0], y + p[1]

    cell = [(-400, -400), (400, -400), (400, 400), (-400, 400)]
    for edge in NEIGHBORS:
        cell = clip(cell, edge)
    picture.polygon([place(p) for p in cell], fill=PEACH)
    for edge in NEIGHBORS:
        length = math.hypot(*edge)
        across = (-edge[1] / length * 66, edge[0] / length * 66)
        ends = [place((edge[0] / 2 + s * across[0], edge[1] / 2 + s * across[1])) for s in (-1, 1)]
        picture.segments([ends], stroke=ORANGE, stroke_width=1.2, stroke_dasharray="5 3")
    rim = list(zip(NEIGHBORS, NEIGHBORS[1:] + NEIGHBORS[:1]))
    picture.segments([(place(a), place(b)) for a, b in rim], stroke=GREY, stroke_width=1)
    picture.segments([(place((0, 0)), place(p)) for p in NEIGHBORS], stroke=INK, stroke_width=1.5)
    picture.dots([place(p) for p in [(0, 0), *NEIGHBORS]], 4.5, fill=INK)
    picture.text(x - 18, y + 20, "u", font_size=18, font_style="italic")
    picture.text(x + NEIGHBORS[0][0] + 4, y - 6, "w", font_size=18, font_style="italic")
    v = (146, 54)
    picture.segments([(place(v), place((0, 0)))], stroke=RED, stroke_width=1.5, stroke_dasharray="2 3")
    picture.segments([(place(v), place(NEIGHBORS[0]))], stroke=GREEN, stroke_width=2)
    picture.dots([place(v)], 6, fill=GREEN)
    picture.text(x + v[0] + 6, y + v[1] + 18, "v", font_size=18, font_style="italic")


def height(i):
    return 3 * math.sin(1.1 * i) + 2.5 * math.sin(2.3 * i + 1)


class Profile:
    """A line of vertices seen from the side, and a leaf of it: the minimum region in two dimensions."""

    def __init__(self, step, before, size):
        self.first, self.size = before, size
        middle = before + (size - 1) / 2
        self.vertices = [(step * (i - middle), height(i)) for i in range(2 * before + size)]

    def cell(self, i):
        """For each neighbor of vertex `i`: where its bisector cuts the axis, and how that moves with the height."""
        x, y = self.vertices[i]
        for k in (i - 1, i + 1):
            d, h = self.vertices[k][0] - x, self.vertices[k][1] - y
            yield (d * d + h * h) / 2 / d, -h / d

    def strip(self, i, n):
        """The interval at height `n` that lies in the cell of vertex `i`."""
        x, y = self.vertices[i]
        ends = sorted(x + at + slope * (n - y) for at, slope in self.cell(i))
        return ends[0], ends[1]

    def region(self):
        own = range(self.first, self.first + self.size)
        slope = max(abs(s) for i in own for _, s in self.cell(i))
        offset = 0
        for i in own:
            x, y = self.vertices[i]
            bound = max(abs(at) for at, _ in self.cell(i)), max(abs(s) for _, s in self.cell(i))
            offset = max(offset, abs(x) + bound[0] + bound[1] * abs(y))
        return offset, math.sqrt(1 + slope * slope)


def draw_side(picture, x, y, half):
    profile = Profile(25, 5, 7)

    def place(p):
        return x + p[0], y - p[1]

    offset, stretch = profile.region()
    heights = range(-half, half + 1, 10)
    rim = [(math.sqrt((offset + stretch * abs(n)) ** 2 - n * n), n) for n in heights]
    right, left = [place(p) for p in rim], [place((-a, n)) for a, n in rim]
    picture.polygon(right + left[::-1], fill=PEACH)
    own = range(profile.first, profile.first + profile.size)
    for i in own:
        bottom, top = profile.strip(i, -half), profile.strip(i, half)
        corners = [(bottom[0], -half), (bottom[1], -half), (top[1], half), (top[0], half)]
        picture.polygon([place(p) for p in corners], fill=ORANGE, fill_opacity=0.13, stroke=ORANGE, stroke_width=0.8)
    for side in left, right:
        picture.polyline(side, stroke=ORANGE, stroke_width=2.4)
    picture.segments([(place((0, -half)), place((0, half)))], stroke=INK, stroke_width=1, stroke_dasharray="6 4")
    picture.polyline([place(p) for p in profile.vertices], stroke=INK, stroke_width=1.5)
    picture.dots([place(p) for p in profile.vertices], 3.5, fill=INK)
    picture.dots([place(profile.vertices[i]) for i in own], 4.5, fill=BLUE)
    picture.text(x + 6, y - half + 16, "axis")
    return profile, place


def draw():
    picture = Picture(900, 465, "The minimum region of a leaf")
    picture.text(20, 30, "From above: one vertex", font_weight="bold")
    draw_cell(picture, 165, 180)
    picture.text(
        20,
        330,
        "Shaded: the cell of u, bounded by the",
        "bisectors of its edges. v lies outside it,",
        "and the neighbor w is nearer to v than u.",
        "So u is not a local minimum.",
    )
    picture.text(400, 30, "From the side: a leaf and its minimum region", font_weight="bold")
    profile, place = draw_side(picture, 630, 210, 150)
    v, w = place(profile.vertices[-1]), place((30, 118))
    picture.dots([v], 6, fill=GREEN)
    picture.text(v[0] - 4, v[1] - 16, "v", font_size=18, font_style="italic")
    picture.dots([w], 6, fill=RED)
    picture.text(w[0] + 10, w[1] + 6, "x", font_size=18, font_style="italic")
    picture.text(
        400,
        392,
        "Thin strips: the cells of the leaf's vertices (blue). The region",
        "contains them: |x| \u2264 offset + |x \u00b7 slope_axis|, from the leaf's center.",
        "If the query vertex is at x, the leaf is a candidate. If it is at v,",
        "each vertex of the leaf has a neighbor nearer to v.",
    )
    return picture
