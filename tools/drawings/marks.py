"""A sheet with slits and a ball, from above: what src/exact/search marks, unites and leaves out."""

import math

from svg import GREEN, GREY, INK, ORANGE, PEACH, RED, SKY, Picture

UNIT = 28
LEFT, TOP = 30, 20
V = (7.7, 8.4)
RADIUS = 6.4
WALL = [(12, 0), (12, 16)]  # the long slit, which passes through the ball
POCKET = [(8, 4), (8, 8), (12, 8)]  # a bent slit, which leaves one way into the square above it
MARKED = "#5aa0dc"
JOINED = "#8fd0a8"
LARGEST = 4  # nodes are squares with sides of 1 (leaves), 2 and 4
SIZE = 16
PASSES = 3  # as in HomeMarks::spread


def place(x, y):
    return LEFT + UNIT * x, TOP + UNIT * y


def box(node):
    x, y, side = node
    return *place(x, y), *place(x + side, y + side)


def steps(line):
    """The sides of unit squares along a slit, each by its ends."""
    for (ax, ay), (bx, by) in zip(line, line[1:]):
        count = abs(bx - ax) + abs(by - ay)
        ends = [(ax + (bx - ax) * i // count, ay + (by - ay) * i // count) for i in range(count + 1)]
        yield from (tuple(sorted(pair)) for pair in zip(ends, ends[1:]))


SLITS = {*steps(WALL), *steps(POCKET)}


def distances(node):
    """From v to the nearest and the farthest point of a node."""
    x, y, side = node
    near = math.hypot(max(x - V[0], 0, V[0] - x - side), max(y - V[1], 0, V[1] - y - side))
    far = max(math.dist(V, (a, b)) for a in (x, x + side) for b in (y, y + side))
    return near, far


def refine(node, whole, surface):
    """Sorts the nodes below `node` into whole ones and surface leaves."""
    near, far = distances(node)
    x, y, side = node
    if near > RADIUS:
        return
    if far <= RADIUS:
        whole.append(node)
    elif side == 1:
        surface.append(node)
    else:
        half = side // 2
        for child in [(x, y), (x + half, y), (x, y + half), (x + half, y + half)]:
            refine((*child, half), whole, surface)


def common_sides(a, b):
    """The sides of unit squares that two nodes share."""
    (ax, ay, an), (bx, by, bn) = a, b
    if ax + an == bx or bx + bn == ax:
        x = max(ax, bx)
        return [((x, y), (x, y + 1)) for y in range(max(ay, by), min(ay + an, by + bn))]
    if ay + an == by or by + bn == ay:
        y = max(ay, by)
        return [((x, y), (x + 1, y)) for x in range(max(ax, bx), min(ax + an, bx + bn))]
    return []


def are_linked(a, b):
    """Whether two nodes share a side inside the ball that is not cut."""
    for side in common_sides(a, b):
        (ax, ay), (bx, by) = side
        nearest = math.hypot(max(ax - V[0], 0, V[0] - bx), max(ay - V[1], 0, V[1] - by))
        if side not in SLITS and nearest <= RADIUS:
            return True
    return False


def spread_marks(whole, surface):
    """As HomeMarks: a mark passes to whole nodes from others of their size or larger; then to surface leaves."""
    marked = {node for node in whole if node[0] <= V[0] < node[0] + node[2] and node[1] <= V[1] < node[1] + node[2]}
    for _ in range(PASSES):
        for node in sorted(whole, key=lambda n: -n[2]):
            if any(other[2] >= node[2] and are_linked(node, other) for other in marked):
                marked.add(node)
    return marked | {leaf for leaf in surface if any(are_linked(leaf, node) for node in marked)}


def unite(elements, marked):
    """As OpenElements: the open elements that links of any kind join with marked ones, and these links."""
    joined, links = set(), []
    queue = sorted(marked)
    for node in queue:
        for other in elements:
            if other not in marked and other not in joined and are_linked(node, other):
                joined.add(other)
                links.append((node, other))
                queue.append(other)
    return joined, links


def center(node):
    return place(node[0] + node[2] / 2, node[1] + node[2] / 2)


def draw_legend(picture, left):
    y = 42
    rows = [
        (MARKED, "whole node, marked"),
        (SKY, "surface leaf, marked"),
        (JOINED, "open, and united with marked elements"),
        (PEACH, "open, and not united: not in the answer"),
    ]
    for color, label in rows:
        picture.boxes([(left, y - 14, left + 18, y + 4)], fill=color, stroke=INK)
        picture.text(left + 30, y, label)
        y += 28
    picture.text(
        left,
        y + 20,
        "Marks pass over links from v to nodes of",
        "the same size or smaller. The large node",
        "in the pocket has links to small nodes",
        "only, so it is open.",
    )
    picture.text(
        left,
        y + 114,
        "Union-find looks at every link of an open",
        "element (arrows), and completes the marks.",
        fill=GREEN,
    )
    picture.text(
        left,
        y + 172,
        "No link joins what lies behind the long",
        "slit with a marked element: it is another",
        "component of the ball.",
        fill=RED,
    )


def draw():
    picture = Picture(850, 490, "Home marks and open elements")
    whole, surface = [], []
    for x in range(0, SIZE, LARGEST):
        for y in range(0, SIZE, LARGEST):
            refine((x, y, LARGEST), whole, surface)
    marked = spread_marks(whole, surface)
    elements = whole + surface
    joined, links = unite(elements, marked)
    others = [node for node in elements if node not in marked and node not in joined]
    colors = [
        ([node for node in whole if node in marked], MARKED),
        ([leaf for leaf in surface if leaf in marked], SKY),
        (sorted(joined), JOINED),
        (others, PEACH),
    ]
    for nodes, color in colors:
        picture.boxes([box(node) for node in nodes], fill=color, stroke="#ffffff", stroke_width=1.5)
    picture.dots([place(*V)], UNIT * RADIUS, fill="none", stroke=ORANGE, stroke_width=2.5)
    for node, other in links:
        picture.arrow(center(node), center(other), stroke_width=1.6)
    for line in (WALL, POCKET):
        picture.polyline([place(*p) for p in line], stroke=INK, stroke_width=4)
    picture.text(*place(12.3, 0.8), "slit", fill=GREY)
    picture.dots([place(*V)], 6, fill=INK)
    picture.text(place(*V)[0] - 18, place(*V)[1] - 8, "v", font_size=18, font_style="italic")
    draw_legend(picture, 500)
    return picture
