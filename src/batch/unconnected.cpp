// SPDX-License-Identifier: MIT
// The nearest vertices that do not belong to the neighborhoods of a packet: a search through the tree, which leaves out
// the nodes that all queries have reached.
#include "meshhood/unconnected.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "base/vector.h"
#include "batch/packets.h"
#include "exact/index_access.h"
#include "exact/query/any_center.h"
#include "exact/query/nearest_first.h"
#include "shared/distance.h"

namespace meshhood {
namespace {

constexpr double kNoGap = std::numeric_limits<double>::infinity();

/// Whether many vertices lie in leaves so large in space that every ball meets them; then a search through the tree
/// takes longer than a scan. From a sample.
bool are_leaves_large(const IndexView& index) {
  constexpr float kLarge = 0.5F;         // the frame reaches from -1 to 1
  constexpr std::size_t kTimesScan = 8;  // what a vertex costs that is found through the tree
  constexpr std::size_t kSample = 256;
  const std::size_t stride = 1 + index.vertex_count() / kSample;
  std::size_t large = 0;
  for (std::size_t v = 0; v < index.vertex_count(); v += stride) {
    large += static_cast<std::size_t>(index.leaves[leaf_of(index.slot[v])].bounds.radius > kLarge);
  }
  return kTimesScan * large * stride > index.vertex_count();
}

/// Searches around one packet at a time.
class UnconnectedSearch {
 public:
  /// Borrows the index.
  UnconnectedSearch(const IndexView& index, Metric metric)
      : index_(&index), metric_(metric), is_scanned_(are_leaves_large(index)) {}

  void run(const PacketAnswer& packet) {
    pieces_ = packet.pieces;
    queries_.clear();
    const LeafId home = leaf_of(index_->slot[packet.vertices.front()]);
    const Center center(index_->frame, center_of_leaf(home));
    all_ = packet.queries;
    for (std::size_t i = 0; i < packet.vertices.size(); ++i) {
      const std::uint32_t slot = index_->slot[packet.vertices[i]];
      const Point p = index_->position(leaf_of(slot), lane_of(slot));
      const double from_center = std::sqrt(squared_distance(center.exact, p));
      const double radius = metric_ == Metric::Rings ? kNoGap : packet.radii[i];
      queries_.push_back({Center(index_->frame, p), from_center, radius, squared_radius(radius)});
      if (index_->is_wall(leaf_of(slot), lane_of(slot))) queries_.back().close();
    }
    if (is_scanned_) return scan();
    update_reach();
    NearestFirst(*index_, center, *this).run();
  }

  struct Found {
    VertexId vertex;
    double gap;
  };
  [[nodiscard]] Found found(std::size_t query) const { return {queries_[query].vertex, queries_[query].gap}; }

  [[nodiscard]] double reach() const { return reach_; }

  /// Whether a query has not reached a vertex of the node.
  [[nodiscard]] bool wants(NodeId node) const {
    const GroupRecord& record = index_->records[node / kFanOut];
    const Piece* const piece = find_piece(record.begin[node % kFanOut]);
    const bool is_reached = piece != nullptr && piece->is_run() && piece->queries == all_ &&
                            record.begin[node % kFanOut + 1] <= index_->leaf_begin[piece->leaves.end];
    return !is_reached;
  }

  void visit_leaf(LeafId leaf) {
    const QueryWord near = queries_near(leaf);
    if (near == 0) return;
    const std::size_t begin = index_->leaf_begin[leaf];
    const Piece* const piece = find_piece(begin);
    bool has_shrunk = false;
    std::visit(
        [&](auto xyz) {
          for (std::size_t v = begin; v < index_->leaf_begin[leaf + 1]; ++v) {
            for_each_query(near & ~reached(piece, v), [&](std::size_t i) { has_shrunk |= offer(i, v, point(xyz, v)); });
          }
        },
        index_->positions);
    if (has_shrunk) update_reach();
  }

 private:
  struct Query {
    Center center;
    double from_center;    // of the search
    double limit;          // the distance of the nearest vertex so far, or the radius
    double squared_limit;  // of the predicate
    VertexId vertex = kNoVertex;
    double gap = kNoGap;

    [[nodiscard]] bool has(const Point& p) const { return squared_distance(center.exact, p) <= squared_limit; }

    /// The query of a wall finds nothing.
    void close() {
      limit = 0;
      squared_limit = -1;
    }
  };

  /// Compares all vertices with all queries.
  void scan() {
    std::size_t next = 0;
    for (const Piece& piece : pieces_) {
      scan(next, index_->leaf_begin[piece.leaves.begin], nullptr);
      next = index_->leaf_begin[piece.leaves.end];
      scan(index_->leaf_begin[piece.leaves.begin], next, &piece);
    }
    scan(next, index_->vertex_count(), nullptr);
  }

  /// Compares vertices that are not in a piece, or all in the same.
  void scan(std::size_t begin, std::size_t end, const Piece* piece) {
    const auto offer_all = [&](std::size_t i, auto xyz) {
      for (std::size_t v = begin; v < end; ++v) {
        const Point p = point(xyz, v);
        if (queries_[i].has(p) && (reached(piece, v) >> i & 1U) == 0) offer(i, v, p);
      }
    };
    const QueryWord queries = piece != nullptr && piece->is_run() ? all_ & ~piece->queries : all_;
    for_each_query(queries,
                   [&](std::size_t i) { std::visit([&](auto xyz) { offer_all(i, xyz); }, index_->positions); });
  }

  /// The queries that have reached a vertex of a piece; of none if it is null.
  [[nodiscard]] QueryWord reached(const Piece* piece, std::size_t vertex) const {
    if (piece == nullptr) return 0;
    return piece->is_run() ? piece->queries : piece->reached[vertex - index_->leaf_begin[piece->leaves.begin]];
  }

  /// The piece that holds a vertex, by its place in index order; null if no query has reached it.
  [[nodiscard]] const Piece* find_piece(std::size_t vertex) const {
    const auto after = std::ranges::partition_point(
        pieces_, [&](const Piece& piece) { return index_->leaf_begin[piece.leaves.end] <= vertex; });
    const bool is_found = after != pieces_.end() && index_->leaf_begin[after->leaves.begin] <= vertex;
    return is_found ? &*after : nullptr;
  }

  [[nodiscard]] Point center_of_leaf(LeafId leaf) const {
    const Frame& frame = index_->frame;
    return frame.origin + (1 / frame.scale) * center_of(index_->leaves[leaf].bounds);
  }

  /// The queries for which the leaf may hold a vertex that is near enough.
  [[nodiscard]] QueryWord queries_near(LeafId leaf) const {
    QueryWord near = 0;
    for (std::size_t i = 0; i < queries_.size(); ++i) {
      const double low = squared_distances(index_->leaves[leaf].bounds, queries_[i].center).low;
      near |= QueryWord{low <= queries_[i].squared_limit} << i;
    }
    return near;
  }

  /// Compares a vertex, in index order, with a query that has not reached it. Returns whether its limit has shrunk.
  bool offer(std::size_t i, std::size_t vertex, const Point& p) {
    Query& query = queries_[i];
    if (!query.has(p) || index_->is_wall_at(vertex) || index_->is_ignored_at(vertex)) return false;
    const double distance = std::sqrt(squared_distance(query.center.exact, p));
    const VertexId id = index_->id(vertex);
    if (distance == query.gap && query.vertex < id) return false;
    const bool has_shrunk = distance < query.limit;
    query.vertex = id;
    query.gap = query.limit = distance;
    query.squared_limit = squared_radius(distance);
    return has_shrunk;
  }

  /// What is farther from the center is farther from each query than its limit.
  void update_reach() {
    double reach = 0;
    for (const Query& query : queries_) reach = std::max(reach, query.limit + query.from_center);
    reach_ = reach_of(reach);
  }

  const IndexView* index_;
  Metric metric_;
  std::span<const Piece> pieces_;
  std::vector<Query> queries_;
  bool is_scanned_;
  QueryWord all_ = 0;
  double reach_ = 0;
};

}  // namespace

Unconnected nearest_unconnected(const Index& index, const BatchQuery& query, const Run& run) {
  const std::size_t rows = query.vertices.count(index.vertex_count());
  Unconnected result{std::vector<VertexId>(rows, kNoVertex), std::vector<double>(rows, kNoGap)};
  const IndexView& view = IndexAccess::view(index);
  const auto make_visitor = [&](unsigned /*thread*/) -> PacketVisitor {
    return [search = UnconnectedSearch(view, query.metric), &result](const PacketAnswer& packet) mutable {
      search.run(packet);
      for (std::size_t i = 0; i < packet.rows.size(); ++i) {
        const auto [vertex, gap] = search.found(i);
        result.vertices[packet.rows[i]] = vertex;
        result.gaps[packet.rows[i]] = gap;
      }
    };
  };
  for_each_packet(index, query, make_visitor, {}, run);
  return result;
}

}  // namespace meshhood
