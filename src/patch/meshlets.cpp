// SPDX-License-Identifier: MIT
#include "patch/meshlets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "meshhood/error.h"

#include "base/vector.h"
#include "exact/neighbors.h"

namespace meshhood::inline v0_1 {
namespace {

struct GivenTriangle {
  Triangle triangle;
  std::uint32_t number;
  std::uint32_t part;
};

/// Finds the parts of a few triangles that are joined by corners.
class LeafParts {
 public:
  /// Sorts the triangles by their parts, each named by its first triangle, then by their numbers.
  void sort(std::span<GivenTriangle> triangles) {
    parents_.resize(triangles.size());
    std::iota(parents_.begin(), parents_.end(), std::uint32_t{0});
    at_places_.clear();
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
      for (const std::uint32_t place : triangles[i].triangle.corners) at_places_.emplace_back(place, i);
    }
    std::sort(at_places_.begin(), at_places_.end());
    for (std::size_t i = 1; i < at_places_.size(); ++i) {
      if (at_places_[i].first == at_places_[i - 1].first) unite(at_places_[i].second, at_places_[i - 1].second);
    }
    for (std::uint32_t i = 0; i < triangles.size(); ++i) triangles[i].part = root(i);
    std::sort(triangles.begin(), triangles.end(), [](const GivenTriangle& a, const GivenTriangle& b) {
      return std::tie(a.part, a.number) < std::tie(b.part, b.number);
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

}  // namespace

std::size_t Triangles::bytes() const {
  const auto bytes_of = [](const auto&... arrays) { return (... + (arrays.size() * sizeof(arrays[0]))); };
  return bytes_of(corners, face, flags, first_of_meshlet, of_block, loose) + fans.bytes();
}

Triangles::Triangles(const IndexView& index, const StoredFaces& faces) {
  make_meshlets(index, triangles_in_index_order(index, faces));
  if (size() == 0) raise(ErrorCode::InvalidMesh, "every face of the mesh has a wall, expected one without");
  make_fans(index.vertex_count());
  find_borders(index);
}

Point Triangles::normal_of(const IndexView& index, std::span<const TriangleId> some) const {
  Point sum{0, 0, 0};
  for (const TriangleId t : some) {
    const auto [a, b, c] = corners_of(index, corners[t]);
    sum = sum + cross(index.frame.scale * (b - a), index.frame.scale * (c - a));
  }
  return sum;
}

/// Triangles in index order are in the order of the leaves already.
void Triangles::make_meshlets(const IndexView& index, const std::vector<Triangle>& all) {
  if (all.size() > std::numeric_limits<std::uint32_t>::max() / 3) {
    raise(ErrorCode::TooLarge, std::to_string(all.size()) + " triangles, expected at most 2^32 / 3");
  }
  corners.reserve(all.size());
  face.reserve(all.size());
  flags.reserve(all.size());
  LeafParts parts;
  std::vector<GivenTriangle> given;  // of one leaf
  LeafId leaf = 0;
  first_of_meshlet.push_back(0);
  const auto end_leaf = [&] {
    parts.sort(given);
    for (std::size_t i = 0; i < given.size(); ++i) {
      corners.push_back(given[i].triangle.corners);
      face.push_back(given[i].triangle.face);
      flags.push_back(static_cast<std::uint8_t>(given[i].triangle.diagonals << 3U));
      const bool is_last = i + 1 == given.size() || given[i + 1].part != given[i].part;
      if (is_last) first_of_meshlet.push_back(static_cast<TriangleId>(size()));
    }
    given.clear();
  };
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    std::uint32_t first = all[begin].corners[0];
    bool has_wall = false;
    for (end = begin; end < all.size() && all[end].face == all[begin].face; ++end) {
      for (const std::uint32_t place : all[end].corners) {
        first = std::min(first, place);
        has_wall = has_wall || index.is_wall_at(place);
      }
    }
    if (const LeafId next = leaf_of(index.slot_at(first)); next != leaf) {
      end_leaf();
      leaf = next;
    }
    for (std::size_t i = begin; !has_wall && i < end; ++i) given.push_back({all[i], static_cast<std::uint32_t>(i), 0});
  }
  end_leaf();
  MeshletId meshlet = 0;
  for (TriangleId t = 0; t < size(); t += kBlock) {
    while (first_of_meshlet[meshlet + std::size_t{1}] <= t) ++meshlet;
    of_block.push_back(meshlet);
  }
}

void Triangles::make_fans(std::size_t places) {
  fans = gather_lists<TriangleId, std::uint32_t>(places, [&](auto&& f) {
    for (auto t = static_cast<TriangleId>(size()); t-- > 0;) {
      const auto& [a, b, c] = corners[t];
      f(a, t);
      if (b != a) f(b, t);
      if (c != a && c != b) f(c, t);
    }
  });
}

namespace {

/// The neighbors of a vertex that come after it in index order, ascending; no walls.
void later_neighbors(const IndexView& index, std::uint32_t place, std::vector<std::uint32_t>& neighbors) {
  neighbors.clear();
  if (index.is_wall_at(place)) return;
  for_each_neighbor(index, index.slot_at(place), [&](std::size_t other) {
    if (other > place && !index.is_wall_at(other)) neighbors.push_back(static_cast<std::uint32_t>(other));
  });
  std::sort(neighbors.begin(), neighbors.end());
}

}  // namespace

/// The sides whose first end is a place, sorted so that the same ones follow each other.
void Triangles::find_borders(const IndexView& index) {
  struct Given {
    Side side;
    TriangleId triangle;
    std::uint32_t number;  // of the side there
  };
  std::vector<Given> sides;
  std::vector<std::uint32_t> ends;       // of sides that are no diagonals
  std::vector<std::uint32_t> neighbors;  // the ends of edges
  for (std::uint32_t first = 0; first < index.vertex_count(); ++first) {
    sides.clear();
    for (const TriangleId t : fans[first]) {
      for (std::uint32_t i = 0; i < 3; ++i) {
        if (const Side side = side_of(t, i); side.first == first) sides.push_back({side, t, i});
      }
    }
    std::sort(sides.begin(), sides.end(), [](const Given& a, const Given& b) {
      return std::tie(a.side.last, a.side.owner) < std::tie(b.side.last, b.side.owner);
    });
    for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
      std::int64_t balance = 0;
      for (end = begin; end < sides.size() && sides[end].side == sides[begin].side; ++end) {
        balance += corners[sides[end].triangle][sides[end].number] == first ? 1 : -1;
      }
      if (sides[begin].side.last == first) balance = 0;  // a corner that is listed twice is no side
      for (std::size_t i = begin; i < end && balance != 0; ++i) {
        flags[sides[i].triangle] |= static_cast<std::uint8_t>(1U << sides[i].number);
      }
    }
    ends.clear();
    for (const auto& [side, triangle, number] : sides) {
      if (side.owner == Side::kShared && side.last != first) ends.push_back(side.last);
    }
    later_neighbors(index, first, neighbors);
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    are_of_index = are_of_index && std::ranges::includes(neighbors, ends);
    for (const std::uint32_t last : neighbors) {
      if (!std::ranges::binary_search(ends, last)) loose.push_back({first, last});
    }
  }
}

namespace {

/// Corners are seen from the center of the sphere, so that the moment is as accurate far from the origin.
Meshlet make_meshlet(const IndexView& index, const Triangles& triangles, MeshletId meshlet) {
  BoundingBox box;
  for (const TriangleId t : triangles.of_meshlet(meshlet)) {
    for (const Point& corner : corners_of(index, triangles.corners[t])) box.add(corner);
  }
  Meshlet sums{box, 0, 0, {0, 0, 0}, 0, false};
  for (const TriangleId t : triangles.of_meshlet(meshlet)) {
    std::array<Point, 3> corners = corners_of(index, triangles.corners[t]);
    for (Point& corner : corners) {
      corner = index.frame.scale * (corner - sums.center());
      sums.radius = std::max(sums.radius, length(corner));
    }
    sums.has_border |= triangles.has_border(t);
    const Point area = 0.5 * doubled_vector_area(corners[0], corners[1], corners[2]);
    sums.area += length(area);
    sums.vector_area = sums.vector_area + area;
    sums.moment += dot(area, corners[0]);
  }
  return sums;
}

/// The same index, whose answers have the ignored vertices, too.
Index without_ignored(const Index& given) {
  if (IndexAccess::view(given).ignored.empty()) return IndexAccess::alias(given);
  auto view = std::make_shared<IndexView>(IndexAccess::view(given));
  view->ignored = {};
  return IndexAccess::make(std::move(view), IndexAccess::share_graph(given));
}

}  // namespace

Meshlets::Meshlets(const IndexView& index, const Triangles& triangles) {
  const std::size_t count = triangles.first_of_meshlet.size() - 1;
  meshlets.reserve(count);
  std::vector<std::uint32_t> places;
  for (MeshletId meshlet = 0; meshlet < count; ++meshlet) {
    meshlets.push_back(make_meshlet(index, triangles, meshlet));
    places.clear();
    for (const TriangleId t : triangles.of_meshlet(meshlet)) {
      places.insert(places.end(), triangles.corners[t].begin(), triangles.corners[t].end());
    }
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    corners.add(places);
  }
  corners.elements.shrink_to_fit();
  of_leaf = gather_lists<MeshletId, std::uint32_t>(index.leaf_count(), [&](auto&& f) {
    for (auto meshlet = static_cast<MeshletId>(count); meshlet-- > 0;) {
      std::optional<LeafId> last;
      for (const std::uint32_t place : corners[meshlet]) {  // those of a leaf follow each other
        const LeafId leaf = leaf_of(index.slot_at(place));
        if (leaf != last) f(leaf, meshlet);
        last = leaf;
      }
    }
  });
  boxes.build(count, [&](std::size_t i) {
    const BoundingBox& box = meshlets[i].box;
    return BoundingBox{index.frame.to_frame(box.low), index.frame.to_frame(box.high)};
  });
}

PatchState::PatchState(const Index& given, const StoredFaces& all)
    : searched(without_ignored(given)),
      index(&IndexAccess::view(searched)),
      faces(&all),
      triangles(*index, all),
      meshlets(*index, triangles) {}

}  // namespace meshhood::inline v0_1
