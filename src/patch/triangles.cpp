// SPDX-License-Identifier: MIT
#include "patch/triangles.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>
#include <tuple>
#include <variant>

#include "meshhood/error.h"

#include "base/triangulate.h"
#include "base/vector.h"

namespace meshhood {
namespace {

using TrianglePlaces = std::array<std::uint32_t, 3>;

/// Whether two of the `size` corners of a polygon follow each other in neither direction.
bool is_diagonal(std::uint32_t a, std::uint32_t b, std::size_t size) {
  return (a + 1) % size != b && (b + 1) % size != a;
}

/// Calls `f(face, corners, diagonals)` for the triangles of all faces, with places as corners, and a bit for each side.
template <class F>
void for_each_triangle(const IndexView& index, const FacesView& faces, F&& f) {
  std::vector<std::uint32_t> places;
  std::vector<Point> points;
  Triangulation triangles;
  faces.for_each([&](std::size_t face, std::span<const VertexId> corners) {
    places.clear();
    for (const VertexId v : corners) {
      places.push_back(index.place(v));
      if (index.is_wall_at(places.back())) return;
    }
    if (places.size() == 3) return f(face, TrianglePlaces{places[0], places[1], places[2]}, std::uint8_t{0});
    points.clear();
    for (const std::uint32_t place : places)
      points.push_back(index.frame.scale * std::visit([&](auto xyz) { return point(xyz, place); }, index.positions));
    triangulate(points, triangles);
    for (const auto& [a, b, c] : triangles) {
      const unsigned diagonals = static_cast<unsigned>(is_diagonal(a, b, places.size())) |
                                 static_cast<unsigned>(is_diagonal(b, c, places.size())) << 1U |
                                 static_cast<unsigned>(is_diagonal(c, a, places.size())) << 2U;
      f(face, TrianglePlaces{places[a], places[b], places[c]}, static_cast<std::uint8_t>(diagonals));
    }
  });
}

struct GivenTriangle {
  TrianglePlaces corners;
  std::uint32_t face;
  std::uint8_t diagonals;
  std::uint32_t part;
};

/// Finds the parts of a few triangles that are joined by corners.
class LeafParts {
 public:
  /// Sorts the triangles by their parts, each named by its first triangle, then by their faces.
  void sort(std::span<GivenTriangle> triangles) {
    parents_.resize(triangles.size());
    std::iota(parents_.begin(), parents_.end(), std::uint32_t{0});
    at_places_.clear();
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
      for (const std::uint32_t place : triangles[i].corners) at_places_.emplace_back(place, i);
    }
    std::sort(at_places_.begin(), at_places_.end());
    for (std::size_t i = 1; i < at_places_.size(); ++i) {
      if (at_places_[i].first == at_places_[i - 1].first) unite(at_places_[i].second, at_places_[i - 1].second);
    }
    for (std::uint32_t i = 0; i < triangles.size(); ++i) triangles[i].part = root(i);
    std::sort(triangles.begin(), triangles.end(), [](const GivenTriangle& a, const GivenTriangle& b) {
      return std::tie(a.part, a.face, a.corners) < std::tie(b.part, b.face, b.corners);
    });
  }

 private:
  [[nodiscard]] std::uint32_t root(std::uint32_t i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }

  void unite(std::uint32_t i, std::uint32_t j) {
    i = root(i);
    j = root(j);
    parents_[std::max(i, j)] = std::min(i, j);
  }

  std::vector<std::uint32_t> parents_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> at_places_;  // place and triangle
};

/// From counts at one place further on to where the items of each begin.
void add_up(std::vector<std::uint32_t>& counts) {
  for (std::size_t i = 1; i < counts.size(); ++i) counts[i] += counts[i - 1];
}

template <class... Arrays>
std::size_t bytes_of(const Arrays&... arrays) {
  return (... + (arrays.size() * sizeof(arrays[0])));
}

}  // namespace

std::size_t Triangles::bytes() const {
  return bytes_of(corners, face, flags, ring, first_fan, fans, first_of_cluster, first_of_face, by_face);
}

Triangles::Triangles(const IndexView& index, const FacesView& faces) {
  if (faces.corner_count() > std::numeric_limits<std::uint32_t>::max() / 3) {
    raise(ErrorCode::TooLarge, std::to_string(faces.corner_count()) + " corners, expected at most a third of 2^32 - 1");
  }
  sort_faces(index, faces);
  list_faces(faces.size());
  make_fans(index.vertex_count());
  join_sides(index.vertex_count());
}

/// Counting sort by the leaf of the corner that comes first in index order, then by the parts of each leaf that hold
/// together.
void Triangles::sort_faces(const IndexView& index, const FacesView& faces) {
  const auto leaf_at = [&](const TrianglePlaces& triangle) {
    return leaf_of(index.slot_at(std::ranges::min(triangle)));
  };
  std::vector<TriangleId> begin(index.leaf_count() + 1, 0);
  for_each_triangle(index, faces, [&](std::size_t, const TrianglePlaces& triangle, std::uint8_t) {
    ++begin[leaf_at(triangle) + std::size_t{1}];
  });
  add_up(begin);
  if (begin.back() == 0) raise(ErrorCode::InvalidMesh, "the mesh has no face of three corners, expected faces");
  std::vector<TriangleId> next(begin.begin(), begin.end() - 1);
  std::vector<GivenTriangle> given(begin.back());
  for_each_triangle(index, faces, [&](std::size_t f, const TrianglePlaces& triangle, std::uint8_t diagonals) {
    given[next[leaf_at(triangle)]++] = {triangle, static_cast<std::uint32_t>(f), diagonals, 0};
  });
  LeafParts parts;
  first_of_cluster.push_back(0);
  for (LeafId leaf = 0; leaf < index.leaf_count(); ++leaf) {
    parts.sort(std::span(given).subspan(begin[leaf], begin[leaf + std::size_t{1}] - begin[leaf]));
    for (TriangleId t = begin[leaf]; t < begin[leaf + std::size_t{1}]; ++t) {
      if (t > begin[leaf] && given[t].part != given[t - 1].part) first_of_cluster.push_back(t);
    }
    if (begin[leaf] != begin[leaf + std::size_t{1}]) first_of_cluster.push_back(begin[leaf + std::size_t{1}]);
  }
  for (const GivenTriangle& triangle : given) {
    corners.push_back(triangle.corners);
    face.push_back(triangle.face);
    flags.push_back(static_cast<std::uint8_t>(triangle.diagonals << 3U));
  }
}

void Triangles::list_faces(std::size_t faces) {
  first_of_face.assign(faces + 1, 0);
  for (const std::uint32_t f : face) ++first_of_face[f + std::size_t{1}];
  add_up(first_of_face);
  std::vector<std::uint32_t> next(first_of_face.begin(), first_of_face.end() - 1);
  by_face.resize(size());
  for (TriangleId t = 0; t < size(); ++t) by_face[next[face[t]]++] = t;
}

void Triangles::make_fans(std::size_t places) {
  const auto for_each_corner = [&](auto&& f) {
    for (TriangleId t = 0; t < size(); ++t) {
      const auto& [a, b, c] = corners[t];
      f(t, a);
      if (b != a) f(t, b);
      if (c != a && c != b) f(t, c);
    }
  };
  first_fan.assign(places + 1, 0);
  for_each_corner([&](TriangleId, std::uint32_t place) { ++first_fan[place + std::size_t{1}]; });
  add_up(first_fan);
  std::vector<std::uint32_t> next(first_fan.begin(), first_fan.end() - 1);
  fans.resize(first_fan.back());
  for_each_corner([&](TriangleId t, std::uint32_t place) { fans[next[place]++] = t; });
}

namespace {

/// A side of a triangle, seen from the end that comes first.
struct TriangleSide {
  std::uint32_t last;    // its other end
  std::uint32_t owner;   // the face of a diagonal
  std::uint32_t number;  // three times its triangle, plus its number there
  bool is_reversed;

  [[nodiscard]] bool is_of(const TriangleSide& other) const { return last == other.last && owner == other.owner; }
};

}  // namespace

/// The sides whose first end is a place, sorted so that those of a ring follow each other.
void Triangles::join_sides(std::size_t places) {
  constexpr std::uint32_t kSharedSide = std::numeric_limits<std::uint32_t>::max();
  ring.resize(3 * size());
  std::vector<TriangleSide> sides;
  for (std::uint32_t first = 0; first < places; ++first) {
    sides.clear();
    for (const TriangleId t : fan(first)) {
      for (std::uint32_t i = 0; i < 3; ++i) {
        const std::uint32_t a = corners[t][i];
        const std::uint32_t b = corners[t][(i + 1) % 3];
        if (std::min(a, b) != first) continue;
        sides.push_back({std::max(a, b), (flags[t] >> (3 + i) & 1U) != 0 ? face[t] : kSharedSide, 3 * t + i, a > b});
      }
    }
    std::sort(sides.begin(), sides.end(), [](const TriangleSide& a, const TriangleSide& b) {
      return std::tie(a.last, a.owner, a.number) < std::tie(b.last, b.owner, b.number);
    });
    for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
      std::int64_t balance = 0;
      for (end = begin; end < sides.size() && sides[end].is_of(sides[begin]); ++end) {
        balance += sides[end].is_reversed ? -1 : 1;
      }
      if (sides[begin].last == first) balance = 0;  // a corner that is listed twice is no side
      for (std::size_t i = begin; i < end; ++i) {
        const std::uint32_t side = sides[i].number;
        ring[side] = sides[i + 1 < end ? i + 1 : begin].number;
        if (balance != 0) flags[side / 3] |= static_cast<std::uint8_t>(1U << side % 3);
      }
    }
  }
}

}  // namespace meshhood
