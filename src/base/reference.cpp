// SPDX-License-Identifier: MIT
// The breadth-first search of sec. 4.3. It shares with the indexes only the graph and the distance predicate.
#include "meshhood/reference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "base/prefetch.h"
#include "base/ranges.h"
#include "base/reference_access.h"
#include "shared/distance.h"

namespace meshhood::inline v0_1 {

/// The data of a vertex that the search reads, in one cache line: its position, and the last query that visited it.
template <class Real>
struct alignas(4 * sizeof(Real)) Record {
  Real x;
  Real y;
  Real z;
  std::uint32_t seen;
};

namespace {

template <class Real>
std::vector<Record<Real>> make_records(const StridedPositions<Real>& xyz) {
  std::vector<Record<Real>> records(xyz.size());
  for (std::size_t v = 0; v < records.size(); ++v) {
    records[v] = {xyz(v, 0), xyz(v, 1), xyz(v, 2), 0};
  }
  return records;
}

template <class Real>
Point position(const Record<Real>& record) {
  return {static_cast<double>(record.x), static_cast<double>(record.y), static_cast<double>(record.z)};
}

}  // namespace

struct ReferenceSearcher::State {
  Adjacency owned;
  AdjacencyView adjacency;
  std::variant<std::vector<Record<float>>, std::vector<Record<double>>> records;
  std::vector<VertexId> queue;
  std::vector<VertexRange> ranges;
  std::uint32_t query = 0;

  explicit State(const GraphView& graph) : adjacency(graph.adjacency), queue(graph.positions.size() + 1) {
    graph.positions.visit([&](const auto& xyz) { records = make_records(xyz); });
  }

  /// Returns a number that marks no record yet. All marks are cleared once in 2^32 queries.
  std::uint32_t next_query() {
    if (++query == 0) {
      std::visit(
          [](auto& all) {
            for (auto& record : all) record.seen = 0;
          },
          records);
      query = 1;
    }
    return query;
  }

  /// Prefetches the row offsets of vertices further down the queue, then their rows. Prefetching the records as well is
  /// faster on cold caches and much slower on warm ones.
  void fetch_ahead(std::size_t head, std::size_t end) const {
    if (head + 16 < end) prefetch(&adjacency.offsets[queue[head + 16]]);
    if (head + 8 < end) prefetch(adjacency.neighbors.data() + adjacency.offsets[queue[head + 8]]);
  }

  /// Leaves the component at the beginning of the queue and returns it.
  template <class Real>
  std::span<const VertexId> search(VertexId v, double squared_radius, std::vector<Record<Real>>& all) {
    const Point center = position(all[v]);
    const std::uint32_t current = next_query();
    all[v].seen = current;
    queue[0] = v;
    std::size_t end = 1;
    for (std::size_t head = 0; head < end; ++head) {
      fetch_ahead(head, end);
      for (const VertexId w : adjacency[queue[head]]) {
        Record<Real>& record = all[w];
        if (record.seen == current) continue;
        record.seen = current;
        // A branch would often be mispredicted.
        queue[end] = w;
        end += static_cast<std::size_t>(squared_distance(center, position(record)) <= squared_radius);
      }
    }
    return std::span(queue).first(end);
  }

  std::span<const VertexId> search(VertexId v, double squared_radius) {
    return std::visit([&](auto& all) { return search(v, squared_radius, all); }, records);
  }

  std::span<const VertexId> neighborhood(VertexId v, double radius) {
    check_query(v, adjacency.size(), radius);
    return search(v, squared_radius(radius));
  }

  void measure(VertexId v, std::span<const VertexId> ids, std::vector<double>& out) const {
    std::visit(
        [&](const auto& all) {
          const Point center = position(all[v]);
          out.resize(ids.size());
          std::transform(ids.begin(), ids.end(), out.begin(),
                         [&](VertexId w) { return std::sqrt(squared_distance(position(all[w]), center)); });
        },
        records);
  }
};

ReferenceSearcher::ReferenceSearcher(const MeshView& mesh) {
  Adjacency owned = meshhood::adjacency(mesh);
  state_ = std::make_unique<State>(GraphView{mesh.positions, owned.view()});
  state_->owned = std::move(owned);
}

ReferenceSearcher::ReferenceSearcher(const GraphView& graph) {
  validate(graph);
  state_ = std::make_unique<State>(graph);
}

ReferenceSearcher::ReferenceSearcher(std::unique_ptr<State> state) { state_ = std::move(state); }

std::size_t ReferenceSearcher::vertex_count() const { return state_->adjacency.size(); }

void ReferenceSearcher::neighborhood(Vertex v, double radius, std::vector<VertexId>& out) {
  const std::span<const VertexId> found = state_->neighborhood(v, radius);
  out.reserve(found.size());  // `assign` of libc++ frees the old memory before it allocates
  out.assign(found.begin(), found.end());
}

void ReferenceSearcher::neighborhood(Vertex v, double radius, std::vector<VertexId>& out,
                                     std::vector<double>& distances) {
  const std::span<const VertexId> found = state_->neighborhood(v, radius);
  // Both are reserved first, so that neither has changed if memory runs out.
  distances.reserve(found.size());
  out.reserve(found.size());
  out.assign(found.begin(), found.end());
  state_->measure(v, found, distances);
}

std::span<const VertexRange> ReferenceSearcher::ranges(Vertex v, double radius) & {
  const std::span<const VertexId> found = state_->neighborhood(v, radius);
  state_->ranges.clear();
  for (const VertexId w : found) append_to(state_->ranges, w);
  return state_->ranges;
}

std::size_t ReferenceSearcher::count(Vertex v, double radius) { return state_->neighborhood(v, radius).size(); }

std::span<const VertexId> ReferenceAccess::search(ReferenceSearcher& searcher, VertexId v, double squared_radius) {
  return searcher.state_->search(v, squared_radius);
}

ReferenceSearcher ReferenceAccess::make(const GraphView& graph) {
  return ReferenceSearcher(std::make_unique<ReferenceSearcher::State>(graph));
}

void ReferenceAccess::remove(ReferenceSearcher& searcher, VertexId v) {
  std::visit([v](auto& records) { records[v].x = std::numeric_limits<decltype(records[v].x)>::quiet_NaN(); },
             searcher.state_->records);
}

void ReferenceAccess::set_query(ReferenceSearcher& searcher, std::uint32_t queries) {
  searcher.state_->query = queries;
}

AdjacencyView ReferenceSearcher::adjacency() const& { return state_->adjacency; }

std::vector<VertexId> exact_neighborhood(const MeshView& mesh, Vertex v, double radius) {
  check_query(v, mesh.positions.size(), radius);
  std::vector<VertexId> result;
  ReferenceSearcher(mesh).neighborhood(v, radius, result);
  return result;
}

}  // namespace meshhood::inline v0_1
