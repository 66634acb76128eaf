"""A folded strip and a ball, in cross section: which nodes of one level src/exact/search/reach.cpp reaches."""

import math

from svg import BLUE, GREEN, GREY, INK, ORANGE, Picture

UNIT = 92
CENTER = (330, 225)
RADIUS = 2.0
NODE = 60  # points of the curve in a node
STEP = 0.01
COLOURS = ["#123a5e", BLUE, "#5aa0dc", "#8fc1ea"]


def place(p):
    return CENTER[0] + UNIT * p[0], CENTER[1] - UNIT * p[1]


def strip():
    """From the left through v, around a bend to the right of the ball, and back above."""
    lower = [(-3.3 + STEP * i, 0.12 * math.sin(2 * (-3.3 + STEP * i))) for i in range(580)]
    turn = (lower[-1][0], lower[-1][1] + 0.55)
    bend = [
        (turn[0] + 0.55 * math.sin(a / 55), turn[1] - 0.55 * math.cos(a / 55)) for a in range(1, round(55 * math.pi))
    ]
    y = bend[-1][1]
    upper = [(turn[0] - STEP * i, y + 0.08 * math.sin(3 * STEP * i)) for i in range(1, 570)]
    return lower + bend + upper


def bounds(points):
    """The center and the radius of a circle around the points."""
    x = (min(p[0] for p in points) + max(p[0] for p in points)) / 2
    y = (min(p[1] for p in points) + max(p[1] for p in points)) / 2
    return (x, y), max(math.dist((x, y), p) for p in points)


def is_outside(points):
    center, radius = bounds(points)
    return math.hypot(*center) > RADIUS + radius


def waves(nodes, home):
    """The wave in which each node is reached. Each node is linked with those before and after it."""
    reached = {home: 0}
    queue = [home]
    for node in queue:
        for other in node - 1, node + 1:
            if 0 <= other < len(nodes) and other not in reached and not is_outside(nodes[other]):
                reached[other] = reached[node] + 1
                queue.append(other)
    return reached


def draw_node(picture, points, colour, is_reached):
    center, radius = bounds(points)
    picture.polyline([place(p) for p in points[::3] + points[-1:]], stroke=colour, stroke_width=5)
    style = {"stroke": colour, "stroke_width": 1} if is_reached else {"stroke": GREY, "stroke_dasharray": "4 4"}
    picture.dots([place(center)], UNIT * radius, fill="none", **style)


def draw_legend(picture, left):
    y = 60
    rows = [
        (COLOURS[0], "home, the node over v"),
        (COLOURS[1], "first wave"),
        (COLOURS[2], "second wave"),
        (COLOURS[3], "third wave"),
        (GREY, "not reached"),
    ]
    for colour, label in rows:
        picture.segments([((left, y - 5), (left + 24, y - 5))], stroke=colour, stroke_width=5)
        picture.text(left + 34, y, label)
        y += 25
    picture.text(left, y + 20, "The nodes around the bend are outside", "the ball, so the search ends before them.")
    picture.text(
        left,
        y + 74,
        "The fold above lies in the ball, but is",
        "not connected with v inside it. No link",
        "from a reached node leads there.",
        fill=GREEN,
    )


def draw():
    picture = Picture(950, 450, "The outward search over the nodes of one level")
    points = strip()
    nodes = [points[i : i + NODE + 1] for i in range(0, len(points) - 1, NODE)]
    v = min(range(len(points)), key=lambda i: math.hypot(*points[i]))
    reached = waves(nodes, v // NODE)
    picture.dots([CENTER], UNIT * RADIUS, fill="#f4f8fc", stroke=ORANGE, stroke_width=2.5)
    for i, node in enumerate(nodes):
        is_reached = i in reached
        draw_node(picture, node, COLOURS[min(reached[i], 3)] if is_reached else GREY, is_reached)
    picture.dots([place(points[v])], 6, fill=INK)
    picture.text(CENTER[0] - 5, CENTER[1] + 30, "v", font_size=18, font_style="italic")
    draw_legend(picture, 650)
    return picture
