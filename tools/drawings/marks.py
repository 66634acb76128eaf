"""A sheet with a slit and a ball, from above: what src/exact/search/home_marks.cpp and loose_pieces.cpp look at."""

import math

from svg import GREY, INK, ORANGE, PEACH, RED, SKY, Picture

UNIT = 28
LEFT, TOP = 30, 20
V = (7.7, 8.4)
RADIUS = 6.4
SLIT = 12  # x of the slit; it ends outside the ball
MARKED = "#5aa0dc"
LARGEST = 4  # nodes are squares with sides of 1 (leaves), 2 and 4
SIZE = 16


def place(x, y):
    return LEFT + UNIT * x, TOP + UNIT * y


def box(node):
    x, y, side = node
    return *place(x, y), *place(x + side, y + side)


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


def are_linked(a, b):
    """Whether two nodes have a common side, which is not a part of the slit."""
    (ax, ay, an), (bx, by, bn) = a, b
    beside = ax + an == bx or bx + bn == ax
    above = ay + an == by or by + bn == ay
    overlap_x = ax < bx + bn and bx < ax + an
    overlap_y = ay < by + bn and by < ay + an
    if beside and overlap_y:
        return max(ax, bx) != SLIT
    return above and overlap_x


def is_in_doubt(node):
    """Whether the node has vertices at the slit, which are not surrounded by neighbors."""
    return node[0] == SLIT or node[0] + node[2] == SLIT


def sees(node, whole):
    """The whole nodes that the links of a node lead to: of its own size, or larger."""
    return [other for other in whole if other[2] >= node[2] and are_linked(node, other)]


def explore(start, whole, marked, explored):
    """As HomeMarks::explore: the nodes visited, and whether a marked one was met."""
    visited = [start]
    for node in visited:
        for other in sees(node, whole):
            if other in marked:
                return visited, True
            if other not in visited and other not in explored:
                visited.append(other)
    return visited, False


def spread(whole, surface):
    """Marks what leads home from the nodes in question: marked nodes, nodes that do not lead home, and steps."""
    marked = {node for node in whole if node[0] <= V[0] < node[0] + node[2] and node[1] <= V[1] < node[1] + node[2]}
    explored, steps = set(), []
    asked = [node for leaf in surface if is_in_doubt(leaf) for node in whole if are_linked(leaf, node)]
    asked += sorted((node for node in whole if is_in_doubt(node)), key=lambda node: node[2])
    for start in asked:
        if start in marked or start in explored:
            continue
        visited, is_home = explore(start, whole, marked, explored)
        if not is_home:
            explored.update(visited)
            continue
        for node in visited:
            marked.add(node)
        for node in reversed(visited):
            steps += [(node, other) for other in sees(node, whole) if other in marked and (other, node) not in steps][:1]
    return marked, explored, steps


def center(node):
    return place(node[0] + node[2] / 2, node[1] + node[2] / 2)


def draw_legend(picture, left):
    y = 42
    rows = [
        (MARKED, "whole node, marked"),
        (SKY, "whole node that was not visited"),
        (PEACH, "whole node that does not lead home"),
        ("#ffffff", "surface leaf"),
    ]
    for color, label in rows:
        picture.boxes([(left, y - 14, left + 18, y + 4)], fill=color, stroke=INK)
        picture.text(left + 30, y, label)
        y += 28
    picture.boxes([(left, y - 14, left + 18, y + 4)], fill="none", stroke=ORANGE, stroke_width=3)
    picture.text(left + 30, y, "in doubt: at the slit, a vertex may have", "no nearer neighbor")
    y += 62
    picture.text(
        left,
        y,
        "Arrows: a node in doubt, or a whole node",
        "beside a leaf in doubt, leads home over",
        "links to a marked node.",
    )
    picture.text(
        left,
        y + 76,
        "Loose: right of the slit, no piece in doubt",
        "touches a marked node. The circle is the",
        "one vertex without a nearer neighbor.",
        "From there a traversal finds the other",
        "component, and removes it.",
        fill=RED,
    )


def draw():
    picture = Picture(850, 490, "Marks and loose pieces")
    whole, surface = [], []
    for x in range(0, SIZE, LARGEST):
        for y in range(0, SIZE, LARGEST):
            refine((x, y, LARGEST), whole, surface)
    marked, explored, steps = spread(whole, surface)
    picture.boxes([box(leaf) for leaf in surface], fill="#ffffff", stroke=GREY)
    for nodes, color in ((whole, SKY), (sorted(marked), MARKED), (sorted(explored), PEACH)):
        picture.boxes([box(node) for node in nodes], fill=color, stroke="#ffffff", stroke_width=1.5)
    picture.dots([place(*V)], UNIT * RADIUS, fill="none", stroke=ORANGE, stroke_width=2.5)
    inner = [(a + 3, b + 3, c - 3, d - 3) for a, b, c, d in (box(n) for n in whole + surface if is_in_doubt(n))]
    picture.boxes(inner, fill="none", stroke=ORANGE, stroke_width=2.5)
    for node, other in steps:
        picture.arrow(center(node), center(other), stroke_width=1.6)
    picture.segments([(place(SLIT, 1.2), place(SLIT, SIZE - 0.6))], stroke=INK, stroke_width=4)
    picture.text(place(SLIT, 0)[0] - 12, TOP + 22, "slit")
    picture.dots([place(SLIT + 0.12, V[1])], 7, fill="none", stroke=RED, stroke_width=2.5)
    picture.dots([place(*V)], 6, fill=INK)
    picture.text(place(*V)[0] - 18, place(*V)[1] - 8, "v", font_size=18, font_style="italic")
    draw_legend(picture, 500)
    return picture
