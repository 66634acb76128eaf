// SPDX-License-Identifier: MIT
// The yardsticks of sec. 4.3. They share nothing with the indexes but the graph and the distance predicate.
#include "meshhood/reference.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "base/distance.h"
#include "base/prefetch.h"
#include "base/reference_access.h"

namespace meshhood {

/// What the search asks of a vertex, in one cache line: where it is, and which query saw it last.
template <class Real>
struct alignas(4 * sizeof(Real)) Record {
  Real x;
  Real y;
  Real z;
  std::uint32_t seen;
};

namespace {

template <class Real>
std::vector<Record<Real>> make_records(std::span<const Real> xyz) {
  std::vector<Record<Real>> records(xyz.size() / 3);
  for (std::size_t v = 0; v < records.size(); ++v) {
    records[v] = {xyz[3 * v], xyz[3 * v + 1], xyz[3 * v + 2], 0};
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
  std::uint32_t query = 0;

  explicit State(const GraphView& graph) : adjacency(graph.adjacency), queue(graph.positions.size() + 1) {
    graph.positions.visit([&](auto xyz) { records = make_records(xyz); });
  }

  /// A number no record carries yet. Once in 2^32 queries all records are cleared.
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

  /// Where the rows of the vertices that come next begin, and a little later the rows. (Their records too would be
  /// faster where all is cold, and far slower where it is not.)
  void fetch_ahead(std::size_t head, std::size_t end) const {
    if (head + 16 < end) prefetch(&adjacency.offsets[queue[head + 16]]);
    if (head + 8 < end) prefetch(adjacency.neighbors.data() + adjacency.offsets[queue[head + 8]]);
  }

  /// Leaves the component in the first places of the queue and returns its size.
  template <class Real>
  std::size_t search(VertexId v, double radius, std::vector<Record<Real>>& all) {
    const std::uint32_t current = next_query();
    const SearchBall ball(position(all[v]), radius);
    all[v].seen = current;
    queue[0] = v;
    std::size_t end = 1;
    for (std::size_t head = 0; head < end; ++head) {
      fetch_ahead(head, end);
      for (const VertexId w : adjacency[queue[head]]) {
        Record<Real>& record = all[w];
        if (record.seen == current) continue;
        record.seen = current;
        // Written always, kept if it is inside: cheaper than a second jump that cannot be foretold.
        queue[end] = w;
        end += static_cast<std::size_t>(ball.contains(position(record)));
      }
    }
    return end;
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

ReferenceSearcher::ReferenceSearcher(ReferenceSearcher&&) noexcept = default;
ReferenceSearcher& ReferenceSearcher::operator=(ReferenceSearcher&&) noexcept = default;
ReferenceSearcher::~ReferenceSearcher() = default;

void ReferenceSearcher::neighborhood(VertexId v, double radius, std::vector<VertexId>& out) {
  check_query(v, state_->adjacency.size(), radius);
  const std::size_t count = std::visit([&](auto& all) { return state_->search(v, radius, all); }, state_->records);
  const auto first = state_->queue.begin();
  out.assign(first, first + static_cast<std::ptrdiff_t>(count));
}

void ReferenceAccess::set_query(ReferenceSearcher& searcher, std::uint32_t queries) {
  searcher.state_->query = queries;
}

AdjacencyView ReferenceSearcher::adjacency() const { return state_->adjacency; }

std::vector<VertexId> exact_neighborhood(const MeshView& mesh, VertexId v, double radius) {
  check_query(v, mesh.positions.size(), radius);
  std::vector<VertexId> result;
  ReferenceSearcher(mesh).neighborhood(v, radius, result);
  return result;
}

void vertices_in_ball(const PositionsView& positions, VertexId v, double radius, std::vector<VertexId>& out) {
  check_query(v, positions.size(), radius);
  positions.visit([&](auto xyz) {
    const SearchBall ball(point(xyz, v), radius);
    out.clear();
    for (std::size_t w = 0; w < xyz.size() / 3; ++w) {
      if (ball.contains(point(xyz, w))) out.push_back(static_cast<VertexId>(w));
    }
  });
}

}  // namespace meshhood
