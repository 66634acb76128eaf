// SPDX-License-Identifier: MIT
#include "patch/meshlets.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "meshhood/error.h"

#include "base/vector.h"
#include "exact/neighbors.h"
#include "shared/disjoint_sets.h"
#include "shared/parallel.h"

namespace meshhood::inline v0_1 {
namespace {

/// A triangle in the order of meshlets: its number in index order, and this bit in the last one of its meshlet.
using GivenTriangle = std::uint32_t;
constexpr GivenTriangle kLast = GivenTriangle{1} << 31U;

/// Divides a few triangles into the parts that corners join.
class LeafParts {
 public:
  explicit LeafParts(std::span<const Triangle> triangles) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> at_places;  // place and triangle
    at_places.reserve(3 * triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
      parts_.add();
      for (const std::uint32_t place : triangles[i].corners) at_places.emplace_back(place, i);
    }
    std::sort(at_places.begin(), at_places.end());
    for (std::size_t i = 1; i < at_places.size(); ++i) {
      if (at_places[i].first == at_places[i - 1].first) parts_.unite(at_places[i].second, at_places[i - 1].second);
    }
  }

  /// Appends the triangles from number `first`, sorted by parts, each named by its first triangle, then by numbers.
  void append(std::size_t first, std::vector<GivenTriangle>& out) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> by_parts;
    by_parts.reserve(parts_.size());
    for (std::uint32_t i = 0; i < parts_.size(); ++i) by_parts.emplace_back(parts_.first_of(i), i);
    std::sort(by_parts.begin(), by_parts.end());
    for (std::size_t i = 0; i < by_parts.size(); ++i) {
      const bool is_last = i + 1 == by_parts.size() || by_parts[i + 1].first != by_parts[i].first;
      out.push_back((static_cast<GivenTriangle>(first) + by_parts[i].second) | (is_last ? kLast : 0));
    }
  }

 private:
  DisjointSets parts_;
};

}  // namespace

std::size_t Triangles::bytes() const {
  const auto bytes_of = [](const auto&... arrays) { return (... + (arrays.size() * sizeof(arrays[0]))); };
  return bytes_of(corners, face, flags, first_of_meshlet, of_block, loose) + fans.bytes();
}

Triangles::Triangles(const IndexView& index, const StoredFaces& faces, TaskContext& task) {
  make_meshlets(triangles_of_leaves(index, faces, task), task);
  make_fans(index.vertex_count());
  find_borders(index, task);
}

Point Triangles::normal_of(const IndexView& index, std::span<const TriangleId> some) const {
  Point sum{0, 0, 0};
  for (const TriangleId t : some) {
    const auto [a, b, c] = corners_of(index, corners[t]);
    sum = sum + cross(index.frame.scale * (b - a), index.frame.scale * (c - a));
  }
  return sum;
}

void Triangles::make_meshlets(const Lists<Triangle, std::size_t>& all, TaskContext& task) {
  if (all.elements.size() > std::numeric_limits<std::uint32_t>::max() / 3) {
    raise(ErrorCode::TooLarge, std::to_string(all.elements.size()) + " triangles, expected at most 2^32 / 3");
  }
  const auto append = [&](std::size_t leaf, std::vector<GivenTriangle>& out) {
    LeafParts(all[leaf]).append(all.offsets[leaf], out);
  };
  const Lists<GivenTriangle> in_order = collect_rows<GivenTriangle>(all.size(), task, append);
  corners.reserve(in_order.elements.size());
  face.reserve(in_order.elements.size());
  flags.reserve(in_order.elements.size());
  first_of_meshlet.push_back(0);
  for (const GivenTriangle given : in_order.elements) {
    const Triangle& triangle = all.elements[given & ~kLast];
    corners.push_back(triangle.corners);
    face.push_back(triangle.face);
    flags.push_back(static_cast<std::uint8_t>(triangle.diagonals << 3U));
    if ((given & kLast) != 0) first_of_meshlet.push_back(static_cast<TriangleId>(size()));
  }
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

/// Finds the neighbors of a vertex that come after it in index order, ascending, without walls.
void later_neighbors(const IndexView& index, std::uint32_t place, std::vector<std::uint32_t>& neighbors) {
  neighbors.clear();
  if (index.is_wall_at(place)) return;
  for_each_neighbor(index, index.slot_at(place), [&](std::size_t other) {
    if (other > place && !index.is_wall_at(other)) neighbors.push_back(static_cast<std::uint32_t>(other));
  });
  std::sort(neighbors.begin(), neighbors.end());
}

}  // namespace

void Triangles::gather_sides(std::uint32_t first, std::vector<GivenSide>& sides) const {
  sides.clear();
  for (const TriangleId t : fans[first]) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      const Side side = side_of(t, i);
      if (side.first == first) sides.push_back({side, {corners[t][i] == first, corners[t][(i + 2) % 3]}, t, i});
    }
  }
  std::ranges::sort(sides, {}, [](const GivenSide& s) { return std::tuple(s.side.last, s.side.owner, s.way); });
}

bool Triangles::are_balanced(std::span<const GivenSide> same) {
  if (same.front().side.first == same.front().side.last) return true;  // a corner that is listed twice is no side
  std::int64_t balance = 0;
  for (const GivenSide& given : same) balance += given.way.first ? 1 : -1;
  return balance == 0 && std::ranges::adjacent_find(same, {}, &GivenSide::way) == same.end();
}

void Triangles::find_borders(const IndexView& index, TaskContext& task) {
  std::vector<std::uint8_t> borders(size());  // the bits of `flags`
  std::atomic<bool> all_of_index{true};
  const auto append = [&, sides = std::vector<GivenSide>(), ends = std::vector<std::uint32_t>(),
                       neighbors = std::vector<std::uint32_t>()](std::size_t place,
                                                                 std::vector<LooseEdge>& out) mutable {
    const auto first = static_cast<std::uint32_t>(place);
    gather_sides(first, sides);
    ends.clear();  // those of sides that are no diagonals
    const auto is_other = [](const GivenSide& a, const GivenSide& b) { return a.side != b.side; };
    for (auto begin = sides.begin(), end = begin; begin != sides.end(); begin = end) {
      end = std::adjacent_find(begin, sides.end(), is_other);
      if (end != sides.end()) ++end;
      const std::span<const GivenSide> same(begin, end);
      if (!are_balanced(same)) {
        for (const GivenSide& given : same) {
          // Another thread may mark another side of the triangle.
          std::atomic_ref(borders[given.triangle]).fetch_or(static_cast<std::uint8_t>(1U << given.number));
        }
      }
      if (begin->side.owner == Side::kShared && begin->side.last != first) ends.push_back(begin->side.last);
    }
    later_neighbors(index, first, neighbors);
    if (!std::ranges::includes(neighbors, ends)) all_of_index = false;
    for (const std::uint32_t last : neighbors) {
      if (!std::ranges::binary_search(ends, last)) out.push_back({first, last});
    }
  };
  loose = collect_rows<LooseEdge>(index.vertex_count(), task, append).elements;
  are_of_index = all_of_index;
  for (TriangleId t = 0; t < size(); ++t) flags[t] |= borders[t];
}

namespace {

/// Takes corners relative to the center of the sphere, so that the moment is as accurate far from the origin.
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
    sums.area += length_without_underflow(area);
    sums.vector_area = sums.vector_area + area;
    sums.moment += dot(area, corners[0]);
  }
  return sums;
}

BoundingBox box_in_frame(const IndexView& index, const Meshlet& meshlet) {
  return {index.frame.to_frame(meshlet.box.low), index.frame.to_frame(meshlet.box.high)};
}

/// Returns the same index, but its answers have the ignored vertices, too.
Index without_ignored(const Index& given) {
  if (IndexAccess::view(given).ignored.empty()) return IndexAccess::alias(given);
  auto view = std::make_shared<IndexView>(IndexAccess::view(given));
  view->ignored = {};
  return IndexAccess::make(std::move(view), IndexAccess::share_graph(given));
}

}  // namespace

Meshlets::Meshlets(const IndexView& index, const Triangles& triangles, TaskContext& task)
    : meshlets(triangles.first_of_meshlet.size() - 1) {
  const auto append = [&, places = std::vector<std::uint32_t>()](std::size_t i,
                                                                 std::vector<std::uint32_t>& out) mutable {
    const auto meshlet = static_cast<MeshletId>(i);
    meshlets[i] = make_meshlet(index, triangles, meshlet);
    places.clear();
    for (const TriangleId t : triangles.of_meshlet(meshlet)) {
      places.insert(places.end(), triangles.corners[t].begin(), triangles.corners[t].end());
    }
    std::sort(places.begin(), places.end());
    std::unique_copy(places.begin(), places.end(), std::back_inserter(out));
  };
  corners = collect_rows<std::uint32_t>(size(), task, append);
  of_leaf = gather_lists<MeshletId, std::uint32_t>(index.leaf_count(), [&](auto&& f) {
    for (auto meshlet = static_cast<MeshletId>(size()); meshlet-- > 0;) {
      std::optional<LeafId> last;
      for (const std::uint32_t place : corners[meshlet]) {  // the places of a leaf follow each other
        const LeafId leaf = leaf_of(index.slot_at(place));
        if (leaf != last) f(leaf, meshlet);
        last = leaf;
      }
    }
  });
  boxes.build(size(), [&](std::size_t i) { return box_in_frame(index, meshlets[i]); });
}

void Meshlets::renew(const IndexView& index, const Triangles& triangles, std::span<const VertexId> changed) {
  std::vector<std::size_t> moved;
  for (const VertexId v : changed) {
    for (const TriangleId t : triangles.fans[index.place(v)]) moved.push_back(triangles.meshlet_of(t));
  }
  sort_out(moved);
  for (const std::size_t i : moved) meshlets[i] = make_meshlet(index, triangles, static_cast<MeshletId>(i));
  boxes.renew(std::move(moved), [&](std::size_t i) { return box_in_frame(index, meshlets[i]); });
}

PatchState::PatchState(const Index& given, const StoredFaces& all, TaskContext& task)
    : searched(without_ignored(given)),
      index(&IndexAccess::view(searched)),
      faces(&all),
      kept_triangles(std::make_shared<const Triangles>(*index, all, task)),
      meshlets(*index, triangles, task) {}

PatchState::PatchState(const PatchState& other)
    : searched(IndexAccess::alias(other.searched)),
      index(&IndexAccess::view(searched)),
      faces(other.faces),
      kept_triangles(other.kept_triangles),
      meshlets(other.meshlets) {}

void PatchState::renew(const Index& refitted, std::span<const VertexId> changed) {
  searched = without_ignored(refitted);
  index = &IndexAccess::view(searched);
  meshlets.renew(*index, triangles, changed);
}

}  // namespace meshhood::inline v0_1
