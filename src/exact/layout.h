// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "meshhood/index.h"

#include "base/frame.h"

namespace meshhood {

/// A set of vertices of one leaf: bit `i` stands for the leaf's vertex number `i`, its *lane*.
using LaneMask = std::uint32_t;
using LeafId = std::uint32_t;

inline constexpr unsigned kLeafCapacity = 32;
inline constexpr unsigned kFanOut = 8;

/// The largest number of leaves: a slot, 32 times a leaf plus a lane, has 32 bits.
inline constexpr std::size_t kMaxLeaves = std::numeric_limits<std::uint32_t>::max() / kLeafCapacity + std::size_t{1};

/// A *slot* names a vertex of the index by its leaf and lane: 32 times the leaf, plus the lane.
[[nodiscard]] constexpr LeafId leaf_of(std::uint32_t slot) { return slot / kLeafCapacity; }
[[nodiscard]] constexpr unsigned lane_of(std::uint32_t slot) { return slot % kLeafCapacity; }

/// The first `n` lanes; `n` <= 32.
[[nodiscard]] constexpr LaneMask first_lanes(unsigned n) { return n == 0 ? 0 : ~LaneMask{0} >> (kLeafCapacity - n); }

/// Up to 32 vertices that lie close together: a contiguous range in index order.
struct Leaf {
  FrameSphere bounds;
  std::uint32_t first;       // in index order
  std::uint32_t first_link;  // its links end where those of the next leaf begin
  std::uint8_t size;
  bool connected;            // by edges between its own vertices
  std::uint16_t unused = 0;  // so that every byte of a leaf has a value
};

/// A leaf that is joined to this one by an edge of the mesh.
struct Link {
  LeafId leaf;
  LaneMask boundary;               // the vertices of this leaf that have a neighbour there
  std::uint32_t first_cross_edge;  // the cross_edges end where those of the next link begin
};

/// An edge between two leaves, by the lanes of its ends: `from` in this leaf, `to` in the linked one.
struct CrossEdge {
  std::uint8_t from;
  std::uint8_t to;
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
  // Columns (see region.h).
  Row slope_x;
  Row slope_y;
  Row slope_z;
  Row offset;
};

/// The nodes of one level, by groups. Node `i` lies in group `i / 8`, and covers the nodes of group `i` one level
/// lower.
struct TreeLevel {
  std::span<const Group> groups;
  std::size_t nodes = 0;
  double mean_radius = 0;  // of their bounding spheres
};

/// Leaves first; the last level is one group.
using Tree = std::vector<TreeLevel>;

/// In index order, #V by 3; `kLeafCapacity` vertices more at the end, so that a whole leaf may be read anywhere.
using PositionsInOrder = std::variant<std::span<const float>, std::span<const double>>;

/// What an index is, as those see it who search it. The arrays lie wherever `owner` keeps them: in memory of our own
/// (see arrays.h), or in the bytes of an index file.
struct IndexView {
  Frame frame;
  PositionsInOrder positions;
  std::span<const VertexId> permutation;   // in index order: the caller's vertex; padded; empty where they are the same
  std::span<const std::uint32_t> slot;     // by the caller's vertex: 32 times its leaf, plus its lane
  std::span<const VertexId> leaf_begin;    // by leaf, and one more: its first vertex in index order
  std::span<const Leaf> leaves;            // one more, for the end of the last links
  std::span<const Link> links;             // one more, likewise
  std::span<const CrossEdge> cross_edges;  // padded
  std::span<const LaneMask> adjacency;     // in index order: the neighbours within the leaf; padded
  std::span<const Group> groups;           // of the levels of the tree, leaves first
  std::span<const double> mean_radii;      // by level
  Tree tree;                               // these groups and radii, by level
  std::shared_ptr<const void> owner;

  [[nodiscard]] Point position(LeafId leaf, unsigned lane) const {
    const std::size_t vertex = std::size_t{leaf_begin[leaf]} + lane;
    return std::visit([&](auto xyz) { return point(xyz, vertex); }, positions);
  }

  /// The caller's id of a vertex in index order.
  [[nodiscard]] VertexId id(std::size_t vertex) const {
    return permutation.empty() ? static_cast<VertexId>(vertex) : permutation[vertex];
  }

  [[nodiscard]] std::size_t vertex_count() const { return slot.size(); }
  [[nodiscard]] std::size_t leaf_count() const { return leaf_begin.size() - 1; }
};

/// How many groups so many nodes make.
[[nodiscard]] constexpr std::size_t group_count(std::size_t nodes) { return (nodes + kFanOut - 1) / kFanOut; }

/// The number of nodes on each level above so many leaves, the leaves included.
[[nodiscard]] std::vector<std::size_t> tree_nodes(std::size_t leaves);

/// How many groups they make on all levels.
[[nodiscard]] std::size_t tree_groups(std::size_t leaves);

/// The levels of the tree above so many leaves. `groups` and `mean_radii` are as many as it has.
[[nodiscard]] Tree make_levels(std::size_t leaves, std::span<const Group> groups, std::span<const double> mean_radii);

}  // namespace meshhood
