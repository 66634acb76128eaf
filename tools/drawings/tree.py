"""The tree over 512 leaves of a flat patch, and a ball: what src/exact/search/reach.cpp finds."""

import math
import random

from svg import GREY, INK, ORANGE, PEACH, SKY, Picture

SIDE = 470
LEFT, TOP = 20, 40
FAN_OUT = 8
CENTRE, RADIUS = (0.47, 0.53), 0.31
INSIDE, INTERSECTING, OUTSIDE = "inside", "intersecting", "outside"
FILL = {INSIDE: SKY, INTERSECTING: PEACH, OUTSIDE: "#ffffff"}


def cut(box, leaves, ratio):
    """Boxes of `leaves` leaves, a power of two, in the order of a kd-tree."""
    if leaves == 1:
        return [box]
    left, top, right, bottom = box
    share = ratio()
    if right - left > bottom - top:
        middle = left + share * (right - left)
        halves = (left, top, middle, bottom), (middle, top, right, bottom)
    else:
        middle = top + share * (bottom - top)
        halves = (left, top, right, middle), (left, middle, right, bottom)
    return cut(halves[0], leaves // 2, ratio) + cut(halves[1], leaves // 2, ratio)


def parents(boxes):
    groups = [boxes[i : i + FAN_OUT] for i in range(0, len(boxes), FAN_OUT)]
    return [(min(b[0] for b in g), min(b[1] for b in g), max(b[2] for b in g), max(b[3] for b in g)) for g in groups]


def side_of(box):
    """How the bounding circle of a box lies relative to the ball."""
    radius = math.dist(box[:2], box[2:]) / 2
    distance = math.dist(((box[0] + box[2]) / 2, (box[1] + box[3]) / 2), CENTRE)
    return INSIDE if distance + radius <= RADIUS else OUTSIDE if distance - radius > RADIUS else INTERSECTING


def descend(levels):
    """By level, from the highest to the leaves: the side of each visited node."""
    found = []
    visited = range(len(levels[-1]))
    for level in reversed(levels):
        sides = {node: side_of(level[node]) for node in visited}
        found.append(sides)
        visited = [FAN_OUT * n + k for n, side in sides.items() if side == INTERSECTING for k in range(FAN_OUT)]
    return found[::-1]


def on_page(box):
    return (LEFT + SIDE * box[0], TOP + SIDE * box[1], LEFT + SIDE * box[2], TOP + SIDE * box[3])


def draw_map(picture, levels, found):
    for level in range(len(levels)):
        for side in (INSIDE, INTERSECTING) if level == 0 else (INSIDE,):
            boxes = [on_page(levels[level][node]) for node, at in found[level].items() if at == side]
            picture.boxes(boxes, fill=FILL[side], stroke="#ffffff", stroke_width=0.8)
    for level, width in (0, 0.5), (1, 1.3), (2, 2.6):
        boxes = [on_page(box) for box in levels[level]]
        picture.boxes(boxes, fill="none", stroke=GREY if level < 2 else INK, stroke_width=width)
    x, y, r = LEFT + SIDE * CENTRE[0], TOP + SIDE * CENTRE[1], SIDE * RADIUS
    picture.dots([(x, y)], r, fill="none", stroke=ORANGE, stroke_width=3)
    picture.dots([(x, y)], 4, fill=INK)
    picture.text(x + 8, y + 5, "v", font_size=18, font_style="italic")
    picture.text(LEFT, 26, "512 leaves, 64 nodes of eight, 8 nodes of sixty-four", font_weight="bold")


def draw_row(picture, left, top, sides, label, chosen=0):
    """Eight nodes and their label, placed beside the arrow from their parent."""
    for i, side in enumerate(sides):
        box = (left + 38 * i, top, left + 38 * i + 32, top + 26)
        picture.boxes([box], fill=FILL[side], stroke=INK, stroke_width=1)
    picture.text(
        left if chosen >= FAN_OUT // 2 else left + 298,
        top - 8,
        label,
        text_anchor="start" if chosen >= FAN_OUT // 2 else "end",
    )


def draw_tree(picture, left, found):
    """From the highest level down, along intersecting nodes whose children lie in as many ways as possible."""

    def children(level, node):
        return [found[level][FAN_OUT * node + k] for k in range(FAN_OUT)]

    top = 64
    draw_row(picture, left, top, [found[2][k] for k in range(FAN_OUT)], "the highest level: one group")
    pairs = [
        (node, child)
        for node, side in found[2].items()
        if side == INTERSECTING
        for child in range(FAN_OUT * node, FAN_OUT * node + FAN_OUT)
        if found[1][child] == INTERSECTING
    ]
    middle, last = max(pairs, key=lambda p: (len(set(children(1, p[0]))) + len(set(children(0, p[1]))), p[0] > 0, p[1]))
    draw_row(picture, left, top + 80, children(1, middle), "its children, level 1", middle)
    draw_row(picture, left, top + 160, children(0, last), "its children, leaves", last % FAN_OUT)
    for row, node in (0, middle), (1, last % FAN_OUT):
        picture.arrow((left + 38 * node + 16, top + 80 * row + 27), (left + 38 * node + 16, top + 80 * row + 78))


def draw_legend(picture, left, top):
    rows = [
        (INSIDE, "inside: all its vertices are in the", "answer, one run of the index order"),
        (INTERSECTING, "intersecting: its eight children are", "compared; in a leaf, its vertices"),
        (OUTSIDE, "outside: skipped, with all below it", ""),
    ]
    for i, (side, first, second) in enumerate(rows):
        y = top + 46 * i
        picture.boxes([(left, y, left + 26, y + 20)], fill=FILL[side], stroke=INK, stroke_width=1)
        picture.text(left + 36, y + 15, *filter(None, (first, second)))


def draw_order(picture, top, levels, found):
    """The index order as a strip: runs inside, and intersecting leaves."""
    width = 800 / len(levels[0])
    for side in INSIDE, INTERSECTING:
        strips = []
        for level, sides in enumerate(found):
            leaves = FAN_OUT**level
            if side == INTERSECTING and level > 0:
                continue
            strips += [
                (LEFT + width * n * leaves, top, LEFT + width * (n + 1) * leaves, top + 26)
                for n, at in sides.items()
                if at == side
            ]
        picture.boxes(sorted(strips), fill=FILL[side])
    picture.boxes([(LEFT, top, LEFT + 800, top + 26)], fill="none", stroke=INK, stroke_width=1)
    picture.text(LEFT, top - 8, "The vertices in index order, leaf by leaf")


def draw():
    ratio = random.Random(5).uniform
    levels = [cut((0, 0, 1, 1), FAN_OUT**3, lambda: ratio(0.46, 0.54))]
    levels += [parents(levels[0])]
    levels += [parents(levels[1])]
    found = descend(levels)
    picture = Picture(840, 600, "The tree over the leaves, and a ball")
    draw_map(picture, levels, found)
    draw_tree(picture, 520, found)
    draw_legend(picture, 520, 300)
    draw_order(picture, 556, levels, found)
    return picture
