"""A ball with a second component, in section: how src/exact/search/other_components.cpp finds and removes it."""

import math

from svg import BLUE, GREEN, INK, ORANGE, RED, Picture

UNIT = 92
CENTRE = (290, 215)
RADIUS = 2.0
STEP = 0.1  # from vertex to vertex


def place(p):
    return CENTRE[0] + UNIT * p[0], CENTRE[1] - UNIT * p[1]


def resample(curve, step):
    """Vertices at equal distances along a curve of many points."""
    result, left = [curve[0]], step
    for a, b in zip(curve, curve[1:]):
        length = math.dist(a, b)
        while left <= length:
            t = left / length
            result.append((a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])))
            left += step
        left -= length
    return result


def home_sheet():
    """Through v, with a hump behind which it comes nearer to v again."""

    def y(x):
        hump = 1.3 * math.exp(-(((x - 0.8) / 0.27) ** 2))
        return hump + 0.1 * math.sin(2 * x) - (0.2 * (x - 1.1) if x > 1.1 else 0)

    return [(i / 200, y(i / 200)) for i in range(-560, 561)]


def other_sheet():
    return [(i / 200, -1.05 + 0.1 * math.cos(1.3 * i / 200 + 0.5) + 0.04 * (i / 200) ** 2) for i in range(-560, 561)]


def inside(p):
    return math.hypot(*p) <= RADIUS


def minima(sheet):
    """The vertices in the ball that have no nearer neighbor."""
    d = [math.hypot(*p) for p in sheet]
    return [i for i in range(1, len(d) - 1) if inside(sheet[i]) and d[i] <= min(d[i - 1], d[i + 1])]


def traverse(sheet, start):
    """Nearest vertex first, until one nearer than `start`: the first and last vertex, and whether one was met."""
    limit = math.hypot(*sheet[start])
    low = high = start
    while True:
        ends = [(math.hypot(*sheet[k]), k) for k in (low - 1, high + 1) if inside(sheet[k])]
        if not ends:
            return low, high, False
        distance, k = min(ends)
        low, high = min(low, k), max(high, k)
        if distance < limit:
            return low, high, True


def draw_sheet(picture, sheet, color):
    shown = [p for p in sheet if abs(p[0]) < 2.75]
    picture.polyline([place(p) for p in shown], stroke=INK, stroke_width=1)
    picture.dots([place(p) for p in shown if not inside(p)], 2.6, fill=INK)
    picture.dots([place(p) for p in shown if inside(p)], 3.6, fill=color)


def draw_traversal(picture, sheet, start, aside, color):
    """Arrows beside the sheet from `start` to both ends of the traversal."""
    low, high, _ = traverse(sheet, start)
    for end in low, high:
        step = 1 if end > start else -1
        path = [(sheet[k][0], sheet[k][1] + aside) for k in range(start + step, end + step, step)]
        if len(path) > 1:
            picture.polyline([place(p) for p in path], stroke=color, stroke_width=2, marker_end="url(#tip)")


def draw_legend(picture, left):
    entries = [
        (BLUE, "connected to v inside the ball"),
        (RED, "another component: in the ball, but", "not connected to v inside it"),
        (INK, "outside the ball"),
    ]
    y = 60
    for color, *rows in entries:
        picture.dots([(left + 6, y - 5)], 4, fill=color)
        picture.text(left + 22, y, *rows)
        y += 18 * len(rows) + 8
    picture.text(left, y + 20, "Circles: local minima of the distance,", "processed nearest first.")
    picture.text(left, y + 76, "1: the traversal exhausts a component.", "It is removed from the answer.", fill=RED)
    picture.text(
        left,
        y + 132,
        "2: the traversal meets a vertex nearer",
        "than its start. Other components with",
        "nearer vertices are already removed,",
        "so it is connected to v.",
        fill=GREEN,
    )


def draw():
    picture = Picture(860, 430, "A second sheet and a hump in the ball")
    home, other = resample(home_sheet(), STEP), resample(other_sheet(), STEP)
    v = min(range(len(home)), key=lambda i: math.hypot(*home[i]))
    home = [(x - home[v][0], y - home[v][1]) for x, y in home]
    picture.dots([CENTRE], UNIT * RADIUS, fill="#f4f8fc", stroke=ORANGE, stroke_width=2.5)
    draw_sheet(picture, home, BLUE)
    draw_sheet(picture, other, RED)
    starts = [
        (math.hypot(*sheet[i]), i, sheet) for sheet in (home, other) for i in minima(sheet) if sheet[i] != (0, 0)
    ]
    for rank, (_, start, sheet) in enumerate(sorted(starts), 1):
        aside = 0.14 if sheet is home else -0.14
        met = traverse(sheet, start)[2]
        draw_traversal(picture, sheet, start, aside, GREEN if met else RED)
        x, y = place(sheet[start])
        picture.dots([(x, y)], 8, fill="none", stroke=INK, stroke_width=2)
        picture.text(x - 22 if met else x - 4, y + 5 if met else y - 16, str(rank), font_size=17, font_weight="bold")
    picture.dots([place((0, 0))], 6, fill=INK)
    picture.text(CENTRE[0] - 4, CENTRE[1] - 14, "v", font_size=18, font_style="italic")
    draw_legend(picture, 575)
    return picture
