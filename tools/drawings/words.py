"""The joint search: a leaf of queries, how the leaves around it lie to the balls, and the words of one of them."""

import math
import random

from leaves import hull, make_cells, make_parts, merge_small
from svg import BLUE, GREY, ORANGE, PEACH, SKY, Picture

SIDE, STEP, RADIUS = 34, 14.3, 11
OUTSIDE, QUERIES = "#eceff2", "#9cc7ec"
SQUARE, LEFT, TOP = 9, 590, 94  # of the matrix of words


def make_mesh():
    jitter = random.Random(5).uniform
    places = []
    for row in range(SIDE):
        for column in range(SIDE):
            x = column + row % 2 / 2 + jitter(-0.18, 0.18)
            places.append((26 + STEP * x, 30 + STEP * (0.88 * row + jitter(-0.15, 0.15))))
    edges = []
    for row in range(SIDE):
        for column in range(SIDE):
            left = column - 1 + row % 2
            for r, c in [(row, column + 1), (row + 1, left), (row + 1, left + 1)]:
                if 0 <= c < SIDE and r < SIDE:
                    edges.append((row * SIDE + column, r * SIDE + c))
    return places, edges


def make_leaves(places, edges):
    neighbors = [set() for _ in places]
    for a, b in edges:
        neighbors[a].add(b)
        neighbors[b].add(a)
    return merge_small(make_parts(make_cells(places, list(range(len(places)))), neighbors), neighbors)


def word(places, queries, vertex):
    """The queries whose ball holds the vertex."""
    return {i for i, q in enumerate(queries) if math.dist(places[q], places[vertex]) <= RADIUS * STEP}


def kind(places, queries, leaf):
    words = [word(places, queries, v) for v in leaf]
    if all(len(w) == len(queries) for w in words):
        return "whole"
    return "partial" if any(words) else "outside"


def draw_patch(picture, places, edges, leaves, kinds, query_leaf, shown):
    fills = {"outside": OUTSIDE, "partial": PEACH, "whole": SKY}
    for i, leaf in enumerate(leaves):
        fill = QUERIES if i == query_leaf else fills[kinds[i]]
        outline = hull([places[v] for v in leaf])
        picture.polygon(outline, fill=fill, stroke=fill, stroke_width=9, stroke_linejoin="round")
    picture.polygon(
        hull([places[v] for v in leaves[shown]]),
        fill="none",
        stroke=ORANGE,
        stroke_width=2.5,
        stroke_linejoin="round",
    )
    picture.segments([(places[a], places[b]) for a, b in edges], stroke=GREY, stroke_width=0.6)
    picture.dots([places[v] for v in leaves[query_leaf]], 2.8, fill=BLUE)


def draw_balls(picture, places, queries):
    """The balls of the two outermost queries, one in x and one in y."""
    for q in (min(queries, key=lambda v: places[v][0]), max(queries, key=lambda v: places[v][0])):
        x, y = places[q]
        ring = [
            (x + RADIUS * STEP * math.cos(a * math.pi / 60), y + RADIUS * STEP * math.sin(a * math.pi / 60))
            for a in range(121)
        ]
        picture.polyline(ring, stroke=BLUE, stroke_width=1.4, stroke_dasharray="5 4")
        picture.dots([(x, y)], 4.2, fill="#ffffff", stroke=BLUE, stroke_width=2)


def draw_words(picture, places, queries, leaf):
    """A row for each vertex of the leaf, a column for each query."""
    picture.text(LEFT, 40, "The words of the outlined leaf", font_weight="bold")
    picture.text(LEFT, 62, "a row for each vertex,", f"a column for each query, 0 to {len(queries) - 1}")
    words = [word(places, queries, v) for v in leaf]
    boxes = {True: [], False: []}
    for row, held in enumerate(words):
        for i in range(len(queries)):
            left, top = LEFT + (SQUARE + 1) * i, TOP + (SQUARE + 1) * row
            boxes[i in held].append((left, top, left + SQUARE, top + SQUARE))
    picture.boxes(boxes[False], fill=OUTSIDE)
    picture.boxes(boxes[True], fill=ORANGE)
    bottom = TOP + (SQUARE + 1) * len(words)
    picture.text(LEFT, bottom + 20, "a row: the queries whose ball holds the vertex;", "a column: the part of a ball in this leaf")


def draw_legend(picture, top):
    rows = [
        (QUERIES, "the leaf of the queries: up to 32, one for each vertex"),
        (SKY, "whole: inside every ball; one word for the leaf"),
        (PEACH, "partial: a word for each vertex"),
        (OUTSIDE, "outside every ball"),
    ]
    for i, (fill, text) in enumerate(rows):
        left, y = 26 + 440 * (i % 2), top + 26 * (i // 2)
        picture.boxes([(left, y, left + 22, y + 16)], fill=fill)
        picture.text(left + 32, y + 13, text)


def draw():
    places, edges = make_mesh()
    leaves = [sorted(leaf) for leaf in make_leaves(places, edges)]
    middle = (26 + STEP * SIDE / 2, 30 + STEP * 0.88 * SIDE / 2)

    def distance(leaf):
        x, y = (sum(places[v][a] for v in leaf) / len(leaf) for a in (0, 1))
        return math.dist((x, y), middle)

    query_leaf = min(range(len(leaves)), key=lambda i: distance(leaves[i]))
    queries = leaves[query_leaf]
    kinds = [kind(places, queries, leaf) for leaf in leaves]
    # A leaf that about half of the pairs of vertex and query hold.
    share = {
        i: sum(len(word(places, queries, v)) for v in leaf) / len(leaf) / len(queries)
        for i, leaf in enumerate(leaves)
        if kinds[i] == "partial"
    }
    shown = min(share, key=lambda i: (abs(share[i] - 0.5), i))
    picture = Picture(940, 520, "A leaf of queries, the leaves around it, and the words of one of them")
    draw_patch(picture, places, edges, leaves, kinds, query_leaf, shown)
    draw_balls(picture, places, queries)
    draw_words(picture, places, queries, leaves[shown])
    draw_legend(picture, 466)
    return picture
