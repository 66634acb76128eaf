// SPDX-License-Identifier: MIT
// Finds the nearest vertices that do not belong to the neighborhoods of a packet, by a search through the tree that
// leaves out the nodes that all queries have reached.
#include "meshhood/unconnected.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "batch/packets.h"
#include "exact/index_access.h"
#include "exact/query/any_center.h"
#include "exact/query/arguments.h"
#include "exact/query/nearest_first.h"
#include "shared/distance.h"
#include "simd/ball.h"
#include "simd/kernels.h"

namespace meshhood::inline v0_1 {
namespace {

/// Where neighbors are not near in space, nodes are large, and a search through the tree visits most of them. To visit
/// one node for every `kVerticesPerNode` vertices takes about as long as a scan, which then takes over.
constexpr std::size_t kVerticesPerNode = 32;

/// The number of packets that are then scanned without a search, because they are probably like this one.
constexpr std::size_t kScans = 16;

class UnconnectedSearch {
 public:
  /// Borrows the index.
  UnconnectedSearch(const IndexView& index, Metric metric)
      : index_(&index), kernels_(&kernels(best_isa())), metric_(metric) {}

  void run(const PacketAnswer& packet) {
    pieces_ = packet.pieces;
    all_ = packet.queries;
    open_ = 0;
    queries_.clear();
    const LeafId leaf = leaf_of(index_->slot[packet.vertices.front()]);
    const Center center(index_->frame, index_->frame.from_frame(center_of(index_->leaves[leaf].bounds)));
    for (std::size_t i = 0; i < packet.vertices.size(); ++i) {
      const std::uint32_t slot = index_->slot[packet.vertices[i]];
      const Point p = index_->position_at(slot);
      const double from_center = std::sqrt(squared_distance(center.exact, p));
      const double radius = metric_ == Metric::Rings ? kInfinity : packet.radii[i];
      queries_.push_back({Center(index_->frame, p), LeafBall(p, LeafBounds(radius)), from_center, radius});
      open_ |= QueryWord{!index_->is_wall(slot)} << i;
    }
    if (scans_left_ == 0) search(center);
    if (nodes_left_ > 0) return;
    scans_left_ = scans_left_ == 0 ? kScans : scans_left_ - 1;
    scan();
  }

  struct Found {
    VertexId vertex;
    double distance;
  };
  [[nodiscard]] Found found(std::size_t query) const { return {queries_[query].vertex, queries_[query].distance}; }

  [[nodiscard]] double reach() const { return reach_; }

  /// Returns whether a query has not reached a vertex of the node, and the search goes on.
  [[nodiscard]] bool wants(NodeId node) {
    if (nodes_left_ > 0) --nodes_left_;
    if (nodes_left_ == 0) {
      reach_ = -1;
      return false;
    }
    const GroupRecord& record = index_->records[node / kFanOut];
    const Piece* const piece = find_piece(record.begin[node % kFanOut]);
    const bool is_reached = piece != nullptr && piece->is_run() && piece->queries == all_ &&
                            record.begin[node % kFanOut + 1] <= index_->leaf_begin[piece->leaves.end];
    return !is_reached;
  }

  void visit_leaf(LeafId leaf) {
    const std::size_t begin = index_->leaf_begin[leaf];
    if (offer_all(queries_near(leaf), begin, index_->leaf_begin[leaf + 1], find_piece(begin))) update_reach();
  }

 private:
  struct Query {
    Center center;
    LeafBall ball;       // of the limit
    double from_center;  // of the search
    double limit;        // the distance of the nearest vertex so far, or the radius
    VertexId vertex = kNoVertex;
    double distance = kInfinity;
  };

  /// Visits the nodes around the center, until none are left to visit.
  void search(const Center& center) {
    nodes_left_ = 1 + index_->vertex_count() / kVerticesPerNode;
    update_reach();
    NearestFirst(*index_, center, *this).run();
  }

  /// Compares all vertices with all queries.
  void scan() {
    std::size_t next = 0;
    for (const Piece& piece : pieces_) {
      const std::size_t begin = index_->leaf_begin[piece.leaves.begin];
      const std::size_t end = index_->leaf_begin[piece.leaves.end];
      offer_all(open_, next, begin, nullptr);
      offer_all(open_, begin, end, &piece);
      next = end;
    }
    offer_all(open_, next, index_->vertex_count(), nullptr);
  }

  /// Compares vertices, in index order, with those queries that have not reached them. They are in no piece, or all in
  /// the same. Returns whether a limit has shrunk.
  bool offer_all(QueryWord queries, std::size_t begin, std::size_t end, const Piece* piece) {
    bool has_shrunk = false;
    if (piece != nullptr) queries &= ~piece->queries;
    const QueryWord* const reached = piece != nullptr ? piece->reached : nullptr;
    if (reached != nullptr) queries &= ~std::accumulate(reached, reached + (end - begin), all_, std::bit_and<>());
    for_each_query(queries, [&](std::size_t i) {
      for (std::size_t first = begin; first < end; first += kLeafCapacity) {
        const std::size_t size = std::min<std::size_t>(end - first, kLeafCapacity);
        for_each_lane(kernels_->within(index_->positions, first, size, queries_[i].ball), [&](unsigned lane) {
          const bool is_reached = reached != nullptr && (reached[lane] >> i & 1U) != 0;
          if (!is_reached) has_shrunk |= offer(queries_[i], first + lane);
        });
      }
    });
    return has_shrunk;
  }

  /// Returns the piece that holds a vertex, by its place in index order; null if no query has reached it.
  [[nodiscard]] const Piece* find_piece(std::size_t vertex) const {
    const auto after = std::ranges::partition_point(
        pieces_, [&](const Piece& piece) { return index_->leaf_begin[piece.leaves.end] <= vertex; });
    const bool is_found = after != pieces_.end() && index_->leaf_begin[after->leaves.begin] <= vertex;
    return is_found ? &*after : nullptr;
  }

  /// Returns the queries for which the leaf may hold a vertex that is near enough.
  [[nodiscard]] QueryWord queries_near(LeafId leaf) const {
    QueryWord near = 0;
    for_each_query(open_, [&](std::size_t i) {
      const double low = squared_distances(index_->leaves[leaf].bounds, queries_[i].center).low;
      near |= QueryWord{low <= queries_[i].ball.squared_radius} << i;
    });
    return near;
  }

  /// Compares a vertex with a query that has not reached it, and whose ball held it before this leaf. Returns whether
  /// the limit has shrunk.
  bool offer(Query& query, std::size_t vertex) const {
    if (index_->is_wall_at(vertex) || index_->is_ignored_at(vertex)) return false;
    const Point p = index_->position(vertex);
    const double distance = std::sqrt(squared_distance(query.ball.center, p));
    const VertexId id = index_->id(vertex);
    if (distance > query.limit || (distance == query.distance && query.vertex < id)) return false;
    const bool has_shrunk = distance < query.limit;
    query.vertex = id;
    query.distance = query.limit = distance;
    if (has_shrunk) query.ball = LeafBall(query.ball.center, LeafBounds(distance));
    return has_shrunk;
  }

  /// Sets the reach. What is farther from the center is farther from each query than its limit.
  void update_reach() {
    double reach = -1;
    for_each_query(open_, [&](std::size_t i) { reach = std::max(reach, queries_[i].limit + queries_[i].from_center); });
    reach_ = reach_of(reach);
  }

  const IndexView* index_;
  const Kernels* kernels_;
  Metric metric_;
  std::span<const Piece> pieces_;
  std::vector<Query> queries_;
  QueryWord all_ = 0;
  QueryWord open_ = 0;          // those that are no walls, of which the others find nothing
  std::size_t nodes_left_ = 0;  // to visit; after the last one, all vertices are scanned
  std::size_t scans_left_ = 0;
  double reach_ = 0;
};

}  // namespace

Unconnected nearest_unconnected(const Index& index, const BatchQuery& query, const Run& run) {
  check_connects(query.metric);
  const std::size_t rows = query.result_rows(index.vertex_count());
  Unconnected result{std::vector<VertexId>(rows, kNoVertex), std::vector<double>(rows, kInfinity)};
  const IndexView& view = IndexAccess::view(index);
  const auto make_visitor = [&](unsigned /*thread*/) -> PacketVisitor {
    return [search = UnconnectedSearch(view, query.metric), &result](const PacketAnswer& packet) mutable {
      search.run(packet);
      for (std::size_t i = 0; i < packet.rows.size(); ++i) {
        const auto [vertex, distance] = search.found(i);
        result.vertex[packet.rows[i]] = vertex;
        result.distance[packet.rows[i]] = distance;
      }
    };
  };
  for_each_packet(index, query, make_visitor, run);
  return result;
}

}  // namespace meshhood::inline v0_1
