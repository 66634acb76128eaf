# SPDX-License-Identifier: MIT
"""A mesh as arrays, and answers to questions about it in the plainest way: by definition, one vertex at a time."""
import functools
import heapq
import math
import re
from collections import deque

import numpy as np

TYPES = {"float": "f4", "double": "f8", "char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4",
         "uint": "u4"}
TYPES.update({"float32": "f4", "float64": "f8", "uint8": "u1", "int32": "i4", "uint32": "u4"})


def read_ply(file):
    """The vertices as a structured array, and the faces as offsets and corners, of a binary PLY file."""
    data = file.read_bytes()
    header, end = [], 0
    while not header or header[-1] != "end_header":
        line_end = data.index(b"\n", end)
        header.append(data[end:line_end].decode().strip())
        end = line_end + 1
    order = ">" if "big_endian" in header[1] else "<"
    count = {words[1]: int(words[2]) for words in (line.split() for line in header) if words[0] == "element"}
    fields = [line.split()[1:] for line in header if re.match(r"property (?!list)", line)]
    row = np.dtype([(name, order + TYPES[kind]) for kind, name in fields])
    vertices = np.frombuffer(data, row, count["vertex"], end)
    rest = np.frombuffer(data, "u1", offset=end + vertices.nbytes)
    offsets, starts, at = [0], [], 0
    for _ in range(count.get("face", 0)):
        size = int(rest[at])
        starts.append(at + 1)
        offsets.append(offsets[-1] + size)
        at += 1 + 4 * size
    words = [rest[s : s + 4 * (b - a)].tobytes() for s, a, b in zip(starts, offsets, offsets[1:])]
    return vertices, np.array(offsets), np.frombuffer(b"".join(words), order + "i4").astype(np.int64)


def write_ply(file, V, offsets, corners):
    header = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(V)}\n"
    header += "property float x\nproperty float y\nproperty float z\n"
    header += f"element face {len(offsets) - 1}\nproperty list uchar int vertex_indices\nend_header\n"
    faces = (bytes([b - a]) + corners[a:b].astype("<i4").tobytes() for a, b in zip(offsets, offsets[1:]))
    file.write_bytes(header.encode() + V.astype("<f4").tobytes() + b"".join(faces))


def with_seam(V, offsets, corners):
    """The mesh with mean edges of about 1 and no equal distances, cut along a plane, where vertices repeat."""
    mesh = Plain(V, offsets, corners)
    V = V / mesh.mean_edge + np.random.default_rng(1).uniform(-0.02, 0.02, V.shape)
    face = np.repeat(np.arange(len(offsets) - 1), np.diff(offsets))
    side = V[corners[offsets[:-1]], 0] > np.median(V[:, 0])
    shared = np.intersect1d(corners[side[face]], corners[~side[face]])
    twin = np.arange(len(V))
    twin[shared] = len(V) + np.arange(len(shared))
    return np.vstack([V, V[shared]]).astype(np.float32), offsets, np.where(side[face], twin[corners], corners)


class Plain:
    """`kept`: for each vertex the one that it becomes by welding, itself without. `masks`: sets of vertices by name."""

    def __init__(self, V, offsets, corners, masks=None, weld=False, cut=()):
        self.V, self.offsets, self.masks = V.astype(np.float64), offsets, masks or {}
        self.kept = np.arange(len(V))
        if weld:
            _, first, of = np.unique(self.V, axis=0, return_index=True, return_inverse=True)
            self.kept = first[of.ravel()]
        self.masks = {name: np.isin(self.kept, self.kept[list(mask)]) & (self.kept == np.arange(len(V)))
                      for name, mask in self.masks.items()}
        self.corners = self.kept[corners]
        following = np.arange(1, len(corners) + 1)
        following[offsets[1:] - 1] = offsets[:-1]
        pairs = np.sort(np.stack([self.corners, self.corners[following]]), axis=0)
        pairs, faces_of_side = np.unique(pairs[:, pairs[0] != pairs[1]], axis=1, return_counts=True)
        self.sides = pairs, faces_of_side
        removed = {tuple(sorted(self.kept[list(edge)])) for edge in cut}
        self.edges = np.array([edge for edge in pairs.T if tuple(edge) not in removed]) if cut else pairs.T
        self.mean_edge = np.linalg.norm(self.V[self.edges[:, 0]] - self.V[self.edges[:, 1]], axis=1).mean()
        both = np.vstack([self.edges, self.edges[:, ::-1]])
        both = both[np.argsort(both[:, 0], kind="stable")]
        self.near, self.begin = both[:, 1], np.searchsorted(both[:, 0], np.arange(len(V) + 1))

    def mask(self, name):
        return self.masks[name] if name else np.zeros(len(self.V), bool)

    def neighbors(self, v):
        return self.near[self.begin[v] : self.begin[v + 1]].tolist()

    def squared(self, center):
        d = self.V - center
        return d[:, 0] * d[:, 0] + d[:, 1] * d[:, 1] + d[:, 2] * d[:, 2]

    @functools.lru_cache(maxsize=100000)
    def neighborhood(self, v, r, metric="straight", walls="", ignored="", point=None, seeds=None):
        """The vertices and their distances, by id. `point` and `seeds`: the start, instead of `v`."""
        walls, ignored = self.mask(walls), self.mask(ignored)
        starts = [int(self.kept[s]) for s in (seeds if seeds is not None else [v])]
        if metric in ("straight", "space"):
            squared = self.squared(self.V[starts[0]] if point is None else np.array(point))
            inside = (squared <= r * r) & ~walls
            found = self._component(starts, inside) if metric == "straight" else self._in_space(starts, inside, point)
            found = {w: math.sqrt(squared[w]) for w in found}
        else:
            squared = None if point is None else self.squared(np.array(point))
            lengths = {s: 0.0 if point is None else math.sqrt(squared[s]) for s in starts}
            found = self._along(lengths, r, walls, metric)
        return {w: d for w, d in sorted(found.items()) if not ignored[w]}

    def _in_space(self, starts, inside, point):
        is_wall = point is None and not inside[starts[0]]
        return [] if is_wall else np.flatnonzero(inside & (self.kept == np.arange(len(self.V)))).tolist()

    def _component(self, starts, inside):
        found = {s for s in starts if inside[s]}
        queue = deque(found)
        while queue:
            for w in self.neighbors(queue.popleft()):
                if inside[w] and w not in found:
                    found.add(w)
                    queue.append(w)
        return found

    @functools.cached_property
    def lines(self):
        """By vertex: the straight lines over pairs of triangles, as (other end, length, the ends of the side)."""
        T = self.corners.reshape(-1, 3)
        sides = np.concatenate([T[:, [k, (k + 1) % 3, (k + 2) % 3]] for k in range(3)])
        sides[:, :2].sort(axis=1)
        sides = sides[np.lexsort(sides.T[::-1])]
        _, first, count = np.unique(sides[:, :2], axis=0, return_index=True, return_counts=True)
        first = first[count == 2]
        a, b, c, d = sides[first, 0], sides[first, 1], sides[first, 2], sides[first + 1, 2]
        along = self.V[b] - self.V[a]
        length = np.linalg.norm(along, axis=1)
        along /= length[:, None]
        (x, height), (other_x, other_height) = (
            (np.einsum("ij,ij->i", along, self.V[p] - self.V[a]),
             np.linalg.norm(np.cross(along, self.V[p] - self.V[a]), axis=1)) for p in (c, d))
        crossing = x + (other_x - x) * height / (height + other_height)
        lines = {}
        for i in np.flatnonzero((crossing > 0) & (crossing < length) & (c != d)):
            step = math.hypot(other_x[i] - x[i], height[i] + other_height[i])
            for v, w in ((c[i], d[i]), (d[i], c[i])):
                lines.setdefault(int(v), []).append((int(w), step, (int(a[i]), int(b[i]))))
        return lines

    def _steps(self, v, metric, walls):
        """The vertices one step away, and the length of the step."""
        for w in self.neighbors(v):
            yield w, 1.0 if metric == "rings" else math.sqrt(sum((self.V[v] - self.V[w]) ** 2))
        if metric == "surface":
            for w, step, side in self.lines.get(v, ()):
                if not walls[list(side)].any():
                    yield w, step

    def _along(self, starts, r, walls, metric):
        """`starts`: the lengths with which the paths begin, by vertex."""
        found, queue = {}, [(d, v) for v, d in starts.items() if d <= r and not walls[v]]
        heapq.heapify(queue)
        while queue:
            d, v = heapq.heappop(queue)
            if v in found:
                continue
            found[v] = d
            for w, step in self._steps(v, metric, walls):
                if not walls[w] and w not in found and d + step <= r:
                    heapq.heappush(queue, (d + step, w))
        return found

    def connecting_radii(self, v, most, walls="", ignored="", point=None, seeds=None, r=math.inf):
        """The first `most` vertices and the radii that connect them, up to r, by radius, distance and id; all for None."""
        walls, ignored = self.mask(walls), self.mask(ignored)
        starts = [int(self.kept[s]) for s in (seeds if seeds is not None else [v])]
        squared = self.squared(self.V[starts[0]] if point is None else np.array(point))
        queue = [(squared[s], s) for s in starts if not walls[s] and math.sqrt(squared[s]) <= r]
        heapq.heapify(queue)
        found, done = {}, set()
        while queue:
            d, v = heapq.heappop(queue)
            if v in done:
                continue
            if most is not None and len(found) >= most and d > last:
                break
            done.add(v)
            last = d
            if not ignored[v]:
                found[v] = math.sqrt(d)
            for w in self.neighbors(v):
                if not walls[w] and w not in done and math.sqrt(squared[w]) <= r:
                    heapq.heappush(queue, (max(d, squared[w]), w))
        first = sorted(found, key=lambda v: (found[v], squared[v], v))[:most]
        return {v: found[v] for v in first}

    def nearest_unconnected(self, v, r, walls="", ignored="", metric="straight"):
        """The nearest vertex in the ball, or by rings of all, that is not in the neighborhood, and its distance: (-1,
        inf) without one."""
        v = int(self.kept[v])
        if self.mask(walls)[v]:
            return -1, math.inf
        squared = self.squared(self.V[v])
        inside = ((squared <= r * r) | (metric == "rings")) & ~self.mask(walls)
        other = inside & ~self.mask(ignored) & (self.kept == np.arange(len(self.V)))
        other[list(self.neighborhood(v, r, metric, walls))] = False
        ids = np.flatnonzero(other)
        if len(ids) == 0:
            return -1, math.inf
        nearest = ids[np.argmin(squared[ids])]
        return int(nearest), math.sqrt(squared[nearest])

    @functools.cached_property
    def triangles(self):
        """Of each face a fan."""
        fans = [(a, i) for a, b in zip(self.offsets, self.offsets[1:]) for i in range(a + 1, b - 1)]
        a, i = np.array(fans).T
        return self.V[np.stack([self.corners[a], self.corners[i], self.corners[i + 1]], axis=1)]

    def vertex_areas(self):
        """A third of the area of each triangle at a vertex. The faces must be triangles."""
        T = self.triangles
        areas = np.linalg.norm(np.cross(T[:, 1] - T[:, 0], T[:, 2] - T[:, 0]), axis=1) / 2
        return np.bincount(self.corners, np.repeat(areas / 3, 3), len(self.V))

    def distance_to_surface(self, p):
        """To the plane of a triangle whose interior is nearest, else to one of its sides."""
        a, b, c = self.triangles.transpose(1, 0, 2)
        normal = np.cross(b - a, c - a)
        length = np.linalg.norm(normal, axis=1)
        with np.errstate(all="ignore"):
            height = np.einsum("ij,ij->i", p - a, normal) / length
            inside = np.ones(len(a), bool)
            for start, end in ((a, b), (b, c), (c, a)):
                inside &= np.einsum("ij,ij->i", np.cross(end - start, p - start), normal) >= 0
        best = np.abs(height[inside & (length > 0)]).min(initial=math.inf)
        for start, end in ((a, b), (b, c), (c, a)):
            side = end - start
            t = np.einsum("ij,ij->i", p - start, side) / np.maximum(np.einsum("ij,ij->i", side, side), 1e-300)
            nearest = start + np.clip(t, 0, 1)[:, None] * side
            best = min(best, np.linalg.norm(nearest - p, axis=1).min())
        return best


def fall(kernel, distances, radius):
    """How much each vertex counts by its distance."""
    share = 1 - (np.asarray(distances, float) / radius) ** 2
    return {"box": np.ones(len(share)), "epanechnikov": share, "biweight": share**2, "gaussian": 1000 ** (share - 1)}[kernel]


def aggregate(
    ids, distances, values, reduce, kernel="box", weights=None, missing="propagate", quantile=0.5, radius=1.0, ddof=0
):
    """Of one channel over one neighborhood, as include/meshhood/aggregate.h says."""
    x, w = values[ids], np.ones(len(ids)) if weights is None else weights[ids]
    falls = fall(kernel, distances, radius)
    kept = (w != 0) if weights is not None and reduce not in ("min", "max", "count", "median", "quantile") else np.ones(len(ids), bool)
    if missing == "omit":
        kept &= ~np.isnan(x)
    x, w, falls = x[kept], w[kept], falls[kept]
    if reduce == "count":
        return float(len(x))
    if reduce in ("sum", "mean"):
        w = w * falls
    with np.errstate(all="ignore"):
        if reduce == "sum":
            return float(np.sum(w * x))
        if len(x) == 0 or np.isnan(x).any():
            return math.nan
        if reduce in ("min", "max", "median", "quantile"):
            return float(np.quantile(x, {"min": 0, "max": 1, "median": 0.5, "quantile": quantile}[reduce]))
        mean = np.sum(w * x) / np.sum(w)
        variance = np.sum(w * (x - mean) ** 2) / (np.sum(w) - ddof or math.nan)
        return float({"mean": mean, "var": variance, "std": math.sqrt(variance)}[reduce])
