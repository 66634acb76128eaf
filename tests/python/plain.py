# SPDX-License-Identifier: MIT
"""Questions about a mesh, answered one vertex at a time in the plainest way. Shares no code with the library."""

import functools
import heapq

import numpy as np


class PlainMesh:
    def __init__(self, V, triangles, walls=None, ignored=None):
        self.V = V.astype(np.float64)
        count = len(V)
        self.walls = np.zeros(count, bool) if walls is None else walls
        self.hidden = self.walls | (np.zeros(count, bool) if ignored is None else ignored)
        sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
        both = np.unique(np.concatenate([sides, sides[:, ::-1]]), axis=0)
        self.begin = np.searchsorted(both[:, 0], np.arange(count + 1))
        self.to = both[:, 1]
        self.triangles = triangles

    def neighbors(self, v):
        near = self.to[self.begin[v] : self.begin[v + 1]]
        return near[~self.walls[near]]

    def distances(self, center):
        dx, dy, dz = (self.V - center).T
        return np.sqrt((dx * dx + dy * dy) + dz * dz)

    def region(self, center, seeds, r):
        """Ascending ids, and their distances from the center."""
        distances = self.distances(center)
        found = np.zeros(len(self.V), bool)
        front = [v for v in seeds if distances[v] <= r and not self.walls[v]]
        found[front] = True
        while front:
            v = front.pop()
            for w in self.neighbors(v):
                if distances[w] <= r and not found[w]:
                    found[w] = True
                    front.append(w)
        ids = np.flatnonzero(found & ~self.hidden)
        return ids, distances[ids]

    def straight(self, v, r):
        return self.region(self.V[v], [v], r)

    def space(self, start, r):
        """Around a vertex or a point."""
        is_vertex = np.ndim(start) == 0
        distances = self.distances(self.V[start] if is_vertex else start)
        ids = np.flatnonzero((distances <= r) & ~self.hidden & (not (is_vertex and self.walls[start])))
        return ids, distances[ids]

    ball = space

    def path(self, start, r):
        """From a vertex, or from the ends of straight lines, given as their lengths by vertex."""
        return self._by_key(self._starts(start, r), r, lambda key, a, b: key + float(self.distances_of(a, b)))

    def surface(self, start, r):
        return self._by_key(self._starts(start, r), r, lambda key, a, b: key + self.lines[a][b], lambda a: self.lines[a])

    def _starts(self, start, r):
        return {v: length for v, length in start.items() if length <= r} if isinstance(start, dict) else {start: 0.0}

    @functools.cached_property
    def lines(self):
        """The edges and the lines over two triangles without walls, by their ends."""
        lines = [{int(b): float(self.distances_of(a, b)) for b in self.neighbors(a)} for a in range(len(self.V))]
        sides = {}
        for triangle in self.triangles[~self.walls[self.triangles].any(axis=1)].tolist():
            for a, b, c in (triangle, triangle[1:] + triangle[:1], triangle[2:] + triangle[:2]):
                sides.setdefault((min(a, b), max(a, b)), []).append(c)
        for (a, b), opposite in sides.items():
            if len(opposite) != 2 or opposite[0] == opposite[1]:
                continue
            side = self.V[b] - self.V[a]
            from_a = self.V[opposite] - self.V[a]
            along = from_a @ side / np.sqrt(side @ side)
            away = np.sqrt(np.maximum((from_a * from_a).sum(axis=1) - along**2, 0))
            crossing = along @ away[::-1] / away.sum()
            if 0 < crossing < np.sqrt(side @ side):
                c, d = opposite
                length = float(np.hypot(along[0] - along[1], away.sum()))
                lines[c][d] = lines[d][c] = min(length, lines[c].get(d, np.inf))
        return lines

    def rings(self, v, r):
        return self._by_key({v: 0.0}, r, lambda key, a, b: key + 1)

    def connecting(self, center, seeds, r):
        """By the largest distance from the center on the way."""
        distances = self.distances(center)
        starts = {int(v): float(distances[v]) for v in seeds if distances[v] <= r}
        return self._by_key(starts, r, lambda key, a, b: max(key, float(distances[b])))

    def distances_of(self, a, b):
        dx, dy, dz = (self.V[a] - self.V[b]).T
        return np.sqrt((dx * dx + dy * dy) + dz * dz)

    def _by_key(self, starts, r, key_of, neighbors=None):
        """Ascending ids, and the smallest key of each."""
        keys, queue = {}, [(key, v) for v, key in starts.items() if not self.walls[v]]
        heapq.heapify(queue)
        while queue:
            key, a = heapq.heappop(queue)
            if a in keys:
                continue
            keys[a] = key
            for b in map(int, (neighbors or self.neighbors)(a)):
                if b not in keys and (following := key_of(key, a, b)) <= r:
                    heapq.heappush(queue, (following, b))
        ids = np.array(sorted(a for a in keys if not self.hidden[a]), np.int64)
        return ids, np.array([keys[a] for a in ids.tolist()], np.float64)
