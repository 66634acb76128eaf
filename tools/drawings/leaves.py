"""A patch of a mesh with a slit in it, cut into leaves as src/exact/build/leaves.cpp cuts it."""

import random
from collections import Counter

from svg import BLUE, GREY, INK, ORANGE, Picture

COLUMNS, ROWS, STEP = 15, 12, 35
CELL, CAPACITY, SMALL = 30, 32, 17
SLIT_ROW, SLIT_END = 5, 9.5
SHOWN = 8 * COLUMNS + 9  # a vertex of the leaf whose links are drawn
FILLS = ["#cfe3f5", "#d8efd3", "#f6e3c5", "#e6dbf3", "#f5d5dc", "#d3eeee", "#ececc8", "#e0e0e8"]


def make_mesh():
    jitter = random.Random(3).uniform
    places = []
    for row in range(ROWS):
        for column in range(COLUMNS):
            gap = 0.16 if column < SLIT_END else 0
            x = column + row % 2 / 2 + jitter(-0.15, 0.15)
            y = 0.88 * row + jitter(-0.12, 0.12) + (gap if row > SLIT_ROW else -gap)
            places.append((30 + STEP * x, 40 + STEP * y))
    edges = set()
    for row in range(ROWS):
        for column in range(COLUMNS):
            left = column - 1 + row % 2
            for r, c in [(row, column + 1), (row + 1, left), (row + 1, left + 1)]:
                is_cut = r == SLIT_ROW + 1 and row == SLIT_ROW and column < SLIT_END
                if 0 <= c < COLUMNS and r < ROWS and not is_cut:
                    edges.add((row * COLUMNS + column, r * COLUMNS + c))
    return places, sorted(edges)


def make_cells(places, vertices):
    if len(vertices) <= CELL:
        return [vertices]
    spread = [max(places[v][a] for v in vertices) - min(places[v][a] for v in vertices) for a in (0, 1)]
    vertices = sorted(vertices, key=lambda v: (places[v][spread.index(max(spread))], v))
    middle = -(-len(vertices) // CELL) // 2 * CELL
    return make_cells(places, vertices[:middle]) + make_cells(places, vertices[middle:])


def component(start, among, neighbors):
    reached = {start}
    todo = [start]
    while todo:
        for w in neighbors[todo.pop()]:
            if w in among and w not in reached:
                reached.add(w)
                todo.append(w)
    return reached


def make_parts(cells, neighbors):
    parts = []
    for cell in cells:
        left = set(cell)
        while left:
            parts.append(component(min(left), left, neighbors))
            left -= parts[-1]
    return parts


def merge_small(parts, neighbors):
    for part in parts:
        if not 0 < len(part) < SMALL:
            continue
        shared = Counter()
        for i, other in enumerate(parts):
            if other is not part and len(part) + len(other) <= CAPACITY:
                shared[i] = sum(w in other for v in part for w in neighbors[v])
        if shared and max(shared.values()) > 0:
            parts[max(shared, key=lambda i: (shared[i], -i))] |= part
            part.clear()
    return [part for part in parts if part]


def hull(corners):
    """The convex hull, around counterclockwise."""

    def half(row):
        chain = []
        for p in row:
            while len(chain) > 1 and (chain[-1][0] - chain[-2][0]) * (p[1] - chain[-2][1]) <= (
                chain[-1][1] - chain[-2][1]
            ) * (p[0] - chain[-2][0]):
                chain.pop()
            chain.append(p)
        return chain[:-1]

    corners = sorted(corners)
    return half(corners) + half(corners[::-1])


def sort_edges(edges, leaf_of):
    """The edges within a leaf, and those between leaves."""
    return [e for e in edges if leaf_of[e[0]] == leaf_of[e[1]]], [e for e in edges if leaf_of[e[0]] != leaf_of[e[1]]]


def draw_patch(picture, places, leaves, within, between):
    for i, leaf in enumerate(leaves):
        outline = hull([places[v] for v in leaf])
        fill = FILLS[i % len(FILLS)]
        picture.polygon(outline, fill=fill, stroke=fill, stroke_width=16, stroke_linejoin="round")
    picture.segments([(places[a], places[b]) for a, b in between], stroke=GREY, stroke_width=0.8)
    picture.segments([(places[a], places[b]) for a, b in within], stroke=GREY, stroke_width=1.6)
    picture.dots(places, 2.6, fill=INK)


def draw_links(picture, places, leaf, edges, leaf_of):
    """The edges of one leaf: those within it, and by linked leaf the cross edges. Returns the latter."""
    cross_edges = {}
    for a, b in edges:
        if leaf in (leaf_of[a], leaf_of[b]) and leaf_of[a] != leaf_of[b]:
            start, other = (a, b) if leaf_of[a] == leaf else (b, a)
            cross_edges.setdefault(leaf_of[other], []).append((start, other))
    own = [(a, b) for a, b in edges if leaf_of[a] == leaf_of[b] == leaf]
    picture.segments([(places[a], places[b]) for a, b in own], stroke=BLUE, stroke_width=2.4)
    for pairs in cross_edges.values():
        picture.segments([(places[a], places[b]) for a, b in pairs], stroke=ORANGE, stroke_width=2.4)
    picture.dots([places[v] for v in leaf_of if leaf_of[v] == leaf], 3.6, fill=BLUE)
    boundary = sorted({start for pairs in cross_edges.values() for start, _ in pairs})
    picture.dots([places[v] for v in boundary], 4.6, fill="#ffffff", stroke=ORANGE, stroke_width=2)
    return cross_edges


def draw_names(picture, places, leaves):
    for i, leaf in enumerate(leaves):
        x, y = (sum(places[v][a] for v in leaf) / len(leaf) for a in (0, 1))
        picture.text(
            x,
            y + 6,
            chr(ord("A") + i),
            font_size=22,
            font_weight="bold",
            text_anchor="middle",
            stroke="#ffffff",
            stroke_width=5,
            paint_order="stroke",
        )


def draw_legend(picture, left, leaves, leaf, cross_edges):
    name = chr(ord("A") + leaf)
    picture.text(
        left,
        40,
        f"Leaf {name}: {len(leaves[leaf])} vertices,",
        f"lanes 0 to {len(leaves[leaf]) - 1}.",
        font_weight="bold",
    )
    picture.segments([((left, 90), (left + 30, 90))], stroke=BLUE, stroke_width=2.4)
    picture.text(left + 40, 95, "edges within the leaf:", "a lane mask per vertex")
    picture.segments([((left, 138), (left + 30, 138))], stroke=ORANGE, stroke_width=2.4)
    picture.text(left + 40, 143, "cross edges: edges to", "another leaf, stored", "as a pair of lanes")
    picture.dots([(left + 15, 205)], 4.6, fill="#ffffff", stroke=ORANGE, stroke_width=2)
    picture.text(left + 40, 210, "boundary: vertices of the", "leaf with a cross edge")
    picture.text(left, 262, f"Links of {name}:", font_weight="bold")
    for i, other in enumerate(sorted(cross_edges)):
        boundary = {start for start, _ in cross_edges[other]}
        count = len(cross_edges[other])
        picture.text(left, 284 + 20 * i, f"to {chr(ord('A') + other)}: boundary {len(boundary)}, cross edges {count}")
    picture.text(
        40,
        425,
        "The slit splits two cells of the kd-tree. Their small parts, above the slit, are merged into the leaf C.",
    )


def draw():
    places, edges = make_mesh()
    neighbors = [set() for _ in places]
    for a, b in edges:
        neighbors[a].add(b)
        neighbors[b].add(a)
    leaves = merge_small(make_parts(make_cells(places, list(range(len(places)))), neighbors), neighbors)
    leaf_of = {v: i for i, leaf in enumerate(leaves) for v in leaf}
    within, between = sort_edges(edges, leaf_of)
    shown = leaf_of[SHOWN]
    picture = Picture(840, 440, "A patch of a mesh cut into leaves")
    draw_patch(picture, places, leaves, within, between)
    cross_edges = draw_links(picture, places, shown, edges, leaf_of)
    draw_names(picture, places, leaves)
    draw_legend(picture, 590, leaves, shown, cross_edges)
    return picture
