// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "meshhood/index.h"

#include "index/frame.h"

namespace meshhood {

/// A set of vertices of one leaf: bit `i` stands for the leaf's vertex number `i`, its *lane*.
using Lanes = std::uint32_t;
using LeafId = std::uint32_t;

inline constexpr unsigned kLeafCapacity = 32;
inline constexpr unsigned kFanOut = 8;

/// The first `n` lanes; `n` <= 32.
[[nodiscard]] constexpr Lanes first_lanes(unsigned n) { return n == 0 ? 0 : ~Lanes{0} >> (kLeafCapacity - n); }

/// Up to 32 vertices that lie close together: a contiguous range in index order.
struct Leaf {
  FrameSphere bounds;
  VertexId first;            // in index order
  std::uint32_t first_link;  // its links end where those of the next leaf begin
  std::uint8_t size;
  bool connected;  // by edges between its own vertices
};

/// A leaf that is joined to this one by an edge of the mesh.
struct Link {
  LeafId leaf;
  Lanes border;                  // the vertices of this leaf that have a neighbour there
  std::uint32_t first_crossing;  // the crossings end where those of the next link begin
};

/// An edge between a vertex of this leaf and one of the linked leaf, by their lanes.
struct Crossing {
  std::uint8_t mine;
  std::uint8_t other;
};

/// Eight nodes of the tree side by side, so that all are compared with a ball at once. Those that do not exist lie far
/// away.
struct alignas(64) Group {
  using Row = std::array<float, kFanOut>;
  // Bounding spheres.
  Row x;
  Row y;
  Row z;
  Row radius;
  // Columns (see column.h).
  Row axis_x;
  Row axis_y;
  Row axis_z;
  Row reach;
};

/// The nodes of one level, by groups. Node `i` lies in group `i / 8`, and covers the nodes of group `i` one level
/// lower.
struct TreeLevel {
  std::vector<Group> groups;
  std::size_t nodes = 0;
  double mean_radius = 0;  // of their bounding spheres
};

/// Leaves first; the last level is one group.
using Tree = std::vector<TreeLevel>;

/// In index order, #V by 3; `kLeafCapacity` vertices more at the end, so that a whole leaf may be read anywhere.
using PositionsInOrder = std::variant<std::vector<float>, std::vector<double>>;

struct IndexStorage {
  Frame frame;
  PositionsInOrder positions;
  std::vector<VertexId> permutation;  // in index order: the caller's vertex; padded; empty where they are the same
  std::vector<std::uint32_t> place;   // by the caller's vertex: 32 times its leaf, plus its lane
  std::vector<VertexId> leaf_begin;   // by leaf, and one more: its first vertex in index order
  std::vector<Leaf> leaves;           // one more, for the end of the last links
  std::vector<Link> links;            // one more, likewise
  std::vector<Crossing> crossings;    // padded
  std::vector<Lanes> adjacency;       // in index order: the neighbours within the leaf; padded
  Tree tree;

  [[nodiscard]] Point position(LeafId leaf, unsigned lane) const {
    const std::size_t vertex = std::size_t{leaf_begin[leaf]} + lane;
    return std::visit([&](const auto& all) { return point(std::span(all), vertex); }, positions);
  }

  /// The caller's id of a vertex in index order.
  [[nodiscard]] VertexId id(std::size_t vertex) const {
    return permutation.empty() ? static_cast<VertexId>(vertex) : permutation[vertex];
  }

  [[nodiscard]] std::size_t vertex_count() const { return place.size(); }
  [[nodiscard]] std::size_t leaf_count() const { return leaf_begin.size() - 1; }
};

}  // namespace meshhood
