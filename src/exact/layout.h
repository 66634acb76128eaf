// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "meshhood/index.h"

#include "base/frame.h"
#include "base/prefetch.h"
#include "exact/shared_graph.h"
#include "simd/leaf.h"
#include "simd/node_group.h"

namespace meshhood {

using LeafId = std::uint32_t;

struct GeometryData;

/// The largest number of leaves, because a slot has 32 bits.
inline constexpr std::size_t kMaxLeaves = std::numeric_limits<std::uint32_t>::max() / kLeafCapacity + std::size_t{1};

/// A *slot* names a vertex by its leaf and lane: 32 times the leaf, plus the lane.
[[nodiscard]] constexpr LeafId leaf_of(std::uint32_t slot) { return slot / kLeafCapacity; }
[[nodiscard]] constexpr unsigned lane_of(std::uint32_t slot) { return slot % kLeafCapacity; }

/// Up to 32 vertices that lie close together; a contiguous range in index order.
struct Leaf {
  FrameSphere bounds;
  std::uint32_t first;       // in index order
  std::uint32_t first_link;  // see IndexView::links_of
  std::uint8_t size;
  bool connected;            // by the edges between its own vertices
  std::uint16_t unused = 0;  // so that every byte has a defined value
};

/// The edges of the mesh from one leaf to one other leaf.
struct Link {
  LeafId leaf;                     // the other leaf
  LaneMask boundary;               // the vertices of this leaf that have a neighbor there
  std::uint32_t first_cross_edge;  // see IndexView::cross_edges_of
};

/// The nodes of one level. Node `i` is in group `i / 8`; its children are the nodes of group `i` one level lower.
struct TreeLevel {
  std::span<const Group> groups;
  std::size_t nodes = 0;
  double mean_radius = 0;  // of the bounding spheres, in the frame
};

/// Leaves first; the last level is one group.
using Tree = std::vector<TreeLevel>;

/// Read-only view of an index, used by searches. `owner` and `geometry` keep the arrays alive.
struct IndexView {
  Frame frame;
  PositionsInOrder positions;
  std::span<const VertexId> permutation;   // in index order: the caller's vertex; padded; empty if the orders are equal
  std::span<const std::uint32_t> slot;     // by the caller's vertex
  std::span<const Leaf> leaves;            // and one more, for the end of the last links
  std::span<const VertexId> leaf_begin;    // by leaf, and one more: its first vertex in index order
  std::span<const Link> links;             // and one more, for the end of the last cross edges
  std::span<const CrossEdge> cross_edges;  // padded
  std::span<const LaneMask> adjacency;     // in index order: the neighbors within the leaf; padded
  std::span<const Group> groups;           // of all levels of the tree, leaves first
  std::span<const double> mean_radii;      // by level
  Tree tree;                               // `groups` and `mean_radii` by level
  std::shared_ptr<const void> owner;       // a `ConnectivityData`, or the bytes of an index file
  std::shared_ptr<GeometryData> geometry;  // of this view alone; none while all arrays are in a file
  std::shared_ptr<SharedGraph> graph = std::make_shared<SharedGraph>();  // for searches over vertices

  [[nodiscard]] std::size_t vertex_count() const { return slot.size(); }
  [[nodiscard]] std::size_t leaf_count() const { return leaf_begin.size() - 1; }

  /// The caller's id of a vertex in index order.
  [[nodiscard]] VertexId id(std::size_t vertex) const {
    return permutation.empty() ? static_cast<VertexId>(vertex) : permutation[vertex];
  }

  [[nodiscard]] Point position(LeafId leaf, unsigned lane) const {
    const std::size_t vertex = std::size_t{leaf_begin[leaf]} + lane;
    return std::visit([&](auto xyz) { return point(xyz, vertex); }, positions);
  }

  /// The position of a vertex in index order, in the frame.
  [[nodiscard]] Point in_frame(std::size_t vertex) const {
    return frame.to_frame(std::visit([&](auto xyz) { return point(xyz, vertex); }, positions));
  }

  /// The links of a leaf, ascending by the linked leaf.
  [[nodiscard]] std::span<const Link> links_of(std::size_t leaf) const {
    return links.subspan(leaves[leaf].first_link, leaves[leaf + 1].first_link - leaves[leaf].first_link);
  }

  /// The cross edges of a link, ascending by `from`, then `to`. `link` must be an element of `links`.
  [[nodiscard]] std::span<const CrossEdge> cross_edges_of(const Link& link) const {
    const Link& next = *(&link + 1);
    return cross_edges.subspan(link.first_cross_edge, next.first_cross_edge - link.first_cross_edge);
  }
};

/// Prefetches the positions of `size` vertices from `first` on, in index order.
inline void prefetch_positions(const IndexView& index, std::size_t first, std::size_t size) {
  std::visit([&](auto xyz) { fetch_lines(&xyz[3 * first], 3 * size * sizeof(xyz[0]) / kCacheLine + 1); },
             index.positions);
}

/// The properties of an array of an index besides its type.
struct ArrayInfo {
  const char* section;              // its name in an index file
  std::size_t IndexBytes::* bytes;  // the part of the index that its memory counts towards
};

/// Calls `f(info, array of each of indexes...)` for every array, in the order of an index file. `indexes` are
/// `IndexView`s and `IndexData`s; their arrays have the same names, which may differ from those in a file.
template <class F, class... Indexes>
void for_each_array(F&& f, Indexes&... indexes) {
  f(ArrayInfo{"positions", &IndexBytes::positions}, indexes.positions...);
  f(ArrayInfo{"permutation", &IndexBytes::permutation}, indexes.permutation...);
  f(ArrayInfo{"place", &IndexBytes::permutation}, indexes.slot...);
  f(ArrayInfo{"leaves", &IndexBytes::tree}, indexes.leaves...);
  f(ArrayInfo{"leaf_begin", &IndexBytes::tree}, indexes.leaf_begin...);
  f(ArrayInfo{"links", &IndexBytes::graph}, indexes.links...);
  f(ArrayInfo{"crossings", &IndexBytes::graph}, indexes.cross_edges...);
  f(ArrayInfo{"adjacency", &IndexBytes::graph}, indexes.adjacency...);
  f(ArrayInfo{"groups", &IndexBytes::tree}, indexes.groups...);
  f(ArrayInfo{"mean_radii", &IndexBytes::tree}, indexes.mean_radii...);
}

/// The number of groups that hold `nodes` nodes.
[[nodiscard]] constexpr std::size_t group_count(std::size_t nodes) { return (nodes + kFanOut - 1) / kFanOut; }

/// The number of nodes on each level of a tree with `leaves` leaves, leaves first.
[[nodiscard]] std::vector<std::size_t> tree_nodes(std::size_t leaves);

/// The number of groups on all its levels.
[[nodiscard]] std::size_t tree_groups(std::size_t leaves);

/// The levels of that tree. `groups` and `mean_radii` have as many elements as it needs.
[[nodiscard]] Tree make_levels(std::size_t leaves, std::span<const Group> groups, std::span<const double> mean_radii);

}  // namespace meshhood
