// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "meshhood/adjacency.h"
#include "meshhood/index.h"

#include "base/frame.h"
#include "base/prefetch.h"
#include "exact/stored_faces.h"
#include "shared/raw_vector.h"
#include "simd/leaf.h"
#include "simd/node_group.h"

namespace meshhood::inline v0_1 {

using LeafId = std::uint32_t;

struct GeometryData;

/// The largest number of leaves, because a slot has 32 bits.
inline constexpr std::size_t kMaxLeaves = std::numeric_limits<std::uint32_t>::max() / kLeafCapacity + std::size_t{1};

/// The largest number of levels of the tree: each has at most three quarters of the nodes below it (`LevelGrouping`),
/// and 2^27 (3/4)^66 < 1. Searches may descend recursively.
inline constexpr std::size_t kMaxLevels = 66;

/// A *slot* names a vertex by its leaf and lane: 32 times the leaf, plus the lane.
[[nodiscard]] constexpr LeafId leaf_of(std::uint32_t slot) { return slot / kLeafCapacity; }
[[nodiscard]] constexpr unsigned lane_of(std::uint32_t slot) { return slot % kLeafCapacity; }

/// Up to 32 vertices that lie close together: a contiguous range in index order.
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

/// A *node* is named by 8 times its group plus its place in the group. Groups are numbered through all levels, leaves
/// first, so a leaf and its node have the same number. A group of fewer than eight nodes has them at its first places.
using NodeId = std::uint32_t;

inline constexpr NodeId kNoNode = std::numeric_limits<NodeId>::max();

/// Some of the nodes of a group: bit `i` stands for the node at place `i`.
using NodeSet = std::uint8_t;

/// Returns the nodes of a group that has `nodes` of them.
[[nodiscard]] constexpr NodeSet first_nodes(unsigned nodes) { return static_cast<NodeSet>((1U << nodes) - 1); }

/// What a search reads of a group besides the bounds of its nodes.
struct alignas(64) GroupRecord {
  std::array<std::uint32_t, kFanOut + 1> begin{};  // by node: its first vertex in index order; and the end of the last
  std::uint32_t first_child = 0;                   // node `i` covers the group `first_child + i`; 0 for leaves
  std::uint32_t first_link = 0;                    // see IndexView::node_links_of
  std::uint32_t end_link = 0;
  std::array<NodeSet, kFanOut> linked{};  // by node: the nodes of the group that it is linked with
  std::uint32_t nodes = 0;
  NodeSet pierced = 0;                   // the nodes that have walls; 0 in files: see masked.cpp
  std::array<std::uint8_t, 3> unused{};  // so that every byte has a defined value
};

/// At least one edge of the mesh joins `node()` to each of the nodes `mine` of the group that the link belongs to,
/// which is another group of the same level. It has five bytes, without padding.
struct NodeLink {
  std::array<std::uint8_t, sizeof(NodeId)> node_bytes;
  NodeSet mine;

  NodeLink(NodeId other, NodeSet nodes) : node_bytes(std::bit_cast<decltype(node_bytes)>(other)), mine(nodes) {}
  [[nodiscard]] NodeId node() const { return std::bit_cast<NodeId>(node_bytes); }
};

/// The groups of one level.
struct TreeLevel {
  std::size_t first_group = 0;
  std::size_t groups = 0;
  std::size_t nodes = 0;
  std::size_t vertices = 0;  // of the nodes
  double mean_radius = 0;    // of the bounding spheres, in the frame
};

/// The groups of leaves below a node.
struct LeafGroupRange {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

/// The levels, leaves first.
using Tree = std::vector<TreeLevel>;

/// Bounding spheres over the root groups, for searches that follow no links. A mesh of many components has many root
/// groups. Those of one level are in a kd order, so neighbors in the list lie close together.
struct RootTree {
  std::vector<std::uint32_t> groups;  // without a parent; of the highest level first
  // First a sphere around each of `groups`, then on each level one around eight of those before; the last has one.
  std::vector<std::vector<FrameSphere>> levels;
};

/// A read-only view of an index, used by searches. `owner` and `geometry` keep the arrays alive.
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
  std::span<const std::uint32_t> levels;   // the first group of each level, and one more: the number of groups
  std::span<const Group> groups;           // of all levels of the tree, leaves first
  std::span<const GroupRecord> records;    // by group
  std::span<const NodeId> parents;         // by group: the node that covers it, or kNoNode
  std::span<const NodeLink> node_links;    // by group
  std::span<const double> mean_radii;      // by level
  std::span<const LaneMask> walls;         // by leaf; empty if there are none: see masked.cpp
  std::span<const LaneMask> ignored;       // likewise
  bool is_derived = false;                 // made by `masked` or `surface_paths`
  Tree tree;                               // the levels, made from `levels`, `records` and `mean_radii`
  RootTree roots;                          // over the groups that no node covers
  std::vector<LeafGroupRange> leaf_groups;  // by node above the leaves, the first of which follows on the last leaf
  std::optional<StoredFaces> faces;         // of the index file, if it has them; no search reads them
  std::shared_ptr<const void> owner;        // a `ConnectivityData`, or the bytes of an index file
  std::shared_ptr<GeometryData> geometry;   // of this view alone; none while all arrays are in a file
  std::uint64_t version = 0;                // the number of refits in place that are in these arrays

  /// The number of all refits in place. A derived index shares it, so that it knows when its index has moved on.
  std::shared_ptr<std::uint64_t> newest = std::make_shared<std::uint64_t>(0);

  [[nodiscard]] bool is_current() const { return version == *newest; }

  [[nodiscard]] std::size_t vertex_count() const { return slot.size(); }
  /// Returns the number of places for leaves. A leaf that does not exist has no vertices.
  [[nodiscard]] std::size_t leaf_count() const { return leaf_begin.size() - 1; }

  /// Returns whether the nodes of a group are leaves.
  [[nodiscard]] bool is_of_leaves(std::size_t group) const { return group * kFanOut < leaf_count(); }

  /// Returns the groups of leaves below a node that is not a leaf.
  [[nodiscard]] const LeafGroupRange& leaf_groups_of(NodeId node) const { return leaf_groups[node - leaf_count()]; }

  /// Returns the vertices of a leaf that a search may pass.
  [[nodiscard]] LaneMask open_lanes(LeafId leaf) const {
    return first_lanes(leaves[leaf].size) & ~(walls.empty() ? LaneMask{0} : walls[leaf]);
  }

  /// Returns the vertices of a leaf that are in no answer, although a search may pass them.
  [[nodiscard]] LaneMask ignored_lanes(LeafId leaf) const { return ignored.empty() ? LaneMask{0} : ignored[leaf]; }

  /// Return whether the vertex at a slot is masked.
  [[nodiscard]] bool is_wall(std::uint32_t at) const { return has(walls, at); }
  [[nodiscard]] bool is_ignored(std::uint32_t at) const { return has(ignored, at); }

  /// Return whether a vertex in index order is masked.
  [[nodiscard]] bool is_wall_at(std::size_t vertex) const { return !walls.empty() && is_wall(slot_at(vertex)); }
  [[nodiscard]] bool is_ignored_at(std::size_t vertex) const { return !ignored.empty() && is_ignored(slot_at(vertex)); }

  /// Returns the caller's id of a vertex in index order.
  [[nodiscard]] VertexId id(std::size_t vertex) const {
    return permutation.empty() ? static_cast<VertexId>(vertex) : permutation[vertex];
  }

  /// Return the place in index order of a slot, and of a vertex of the caller.
  [[nodiscard]] std::uint32_t place_at(std::uint32_t at) const { return leaf_begin[leaf_of(at)] + lane_of(at); }
  [[nodiscard]] std::uint32_t place(VertexId v) const { return place_at(slot[v]); }

  /// Returns the slot of a vertex in index order.
  [[nodiscard]] std::uint32_t slot_at(std::size_t vertex) const { return slot[id(vertex)]; }

  /// Returns the position of a vertex in index order, in the unit of the mesh.
  [[nodiscard]] Point position(std::size_t vertex) const {
    return std::visit([&](auto xyz) { return point(xyz, vertex); }, positions);
  }
  /// Returns the same position in the frame.
  [[nodiscard]] Point in_frame(std::size_t vertex) const { return frame.to_frame(position(vertex)); }

  /// Return the position at a slot, and that of a vertex of the caller.
  [[nodiscard]] Point position_at(std::uint32_t at) const { return position(place_at(at)); }
  [[nodiscard]] Point position_of(VertexId v) const { return position_at(slot[v]); }
  [[nodiscard]] Point position(LeafId leaf, unsigned lane) const {
    return position(std::size_t{leaf_begin[leaf]} + lane);
  }

  /// Returns the links of a leaf, ascending by the linked leaf.
  [[nodiscard]] std::span<const Link> links_of(std::size_t leaf) const {
    assert(leaf < leaf_count());
    return links.subspan(leaves[leaf].first_link, leaves[leaf + 1].first_link - leaves[leaf].first_link);
  }

  /// Returns the links of the nodes of a group with nodes of other groups, ascending by node.
  [[nodiscard]] std::span<const NodeLink> node_links_of(const GroupRecord& record) const {
    return node_links.subspan(record.first_link, record.end_link - record.first_link);
  }

  /// Returns the cross edges of a link, ascending by `from`, then `to`. `link` must be an element of `links`.
  [[nodiscard]] std::span<const CrossEdge> cross_edges_of(const Link& link) const {
    assert(&link >= links.data() && &link + 1 < links.data() + links.size());
    const Link& next = *(&link + 1);
    return cross_edges.subspan(link.first_cross_edge, next.first_cross_edge - link.first_cross_edge);
  }

 private:
  static bool has(std::span<const LaneMask> lanes, std::uint32_t at) {
    return !lanes.empty() && (lanes[leaf_of(at)] >> lane_of(at) & 1U) != 0;
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
  f(ArrayInfo{"levels", &IndexBytes::tree}, indexes.levels...);
  f(ArrayInfo{"groups", &IndexBytes::tree}, indexes.groups...);
  f(ArrayInfo{"group_records", &IndexBytes::tree}, indexes.records...);
  f(ArrayInfo{"parents", &IndexBytes::tree}, indexes.parents...);
  f(ArrayInfo{"node_links", &IndexBytes::tree}, indexes.node_links...);
  f(ArrayInfo{"mean_radii", &IndexBytes::tree}, indexes.mean_radii...);
}

/// Makes bounding spheres over the root groups. Takes O(#groups). The records need not be verified.
[[nodiscard]] RootTree make_root_tree(std::span<const Group> groups, std::span<const GroupRecord> records,
                                      std::span<const std::uint32_t> parents);

/// Sets `tree`, `roots` and `leaf_groups`, which follow from the arrays. These need not be verified.
void derive(IndexView& index);

/// The arrays of an `IndexView` that follow from the edges and from the division into leaves. Indexes that `refit` has
/// made share them.
struct ConnectivityData {
  RawVector<VertexId> permutation;
  RawVector<std::uint32_t> slot;
  std::vector<VertexId> leaf_begin;
  std::vector<Link> links;
  std::vector<CrossEdge> cross_edges;
  RawVector<LaneMask> adjacency;
  std::vector<std::uint32_t> levels;
  std::vector<GroupRecord> records;
  std::vector<NodeId> parents;
  std::vector<NodeLink> node_links;
};

/// Positions in index order, padded.
using OrderedPositions = std::variant<RawVector<float>, RawVector<double>>;

/// The arrays that change with the positions.
struct GeometryData {
  Frame frame;
  OrderedPositions positions;
  std::vector<Leaf> leaves;
  std::vector<Group> groups;
  std::vector<double> mean_radii;
};

/// All arrays of an `IndexView`; `build` fills them.
struct IndexData : ConnectivityData, GeometryData {};

[[nodiscard]] PositionsInOrder view_of(const OrderedPositions& positions);

/// Returns a view of `data`, which must outlive it. It has no `tree` if the groups are not filled yet.
[[nodiscard]] IndexView view_of(const IndexData& data);

/// Returns a view that owns `data`.
[[nodiscard]] std::shared_ptr<IndexView> make_view(IndexData data);

/// Makes `view` own `geometry`, and refer to it. If memory runs out, `view` is as it was.
void set_geometry(IndexView& view, std::shared_ptr<GeometryData> geometry);

}  // namespace meshhood::inline v0_1
