// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "meshhood/search.h"

#include "exact/index_access.h"
#include "exact/layout.h"
#include "exact/search/straight_search.h"
#include "exact/vertex_set.h"
#include "exact/weighted_graph.h"
#include "shared/distance.h"
#include "simd/kernels.h"

namespace meshhood::inline v0_1 {

/// The connecting radius of a vertex that no radius connects.
inline constexpr double kNoRadius = kInfinity;

/// Answers single queries by one metric. Arguments are valid, unless a function says that it checks them.
struct SingleQueries {
  BoundIndex index;
  std::shared_ptr<KeptGraph> graph;
  Metric metric;
  Isa isa;
  const Kernels* kernels;
  VertexSet answer;

  SingleQueries(BoundIndex bound, std::shared_ptr<KeptGraph> kept, Metric by, Isa chosen)
      : index(std::move(bound)),
        graph(std::move(kept)),
        metric(by),
        isa(chosen),
        kernels(&meshhood::kernels(isa)),
        answer(*index) {}
  SingleQueries(const SingleQueries&) = delete;
  SingleQueries& operator=(const SingleQueries&) = delete;
  virtual ~SingleQueries() = default;

  /// Throws unless the start of a query is valid. `where` begins the messages.
  void check(const Start& start, std::string_view where = {}) const;

  /// Goes on with the present state of the same index.
  virtual void rebind(BoundIndex bound, std::shared_ptr<KeptGraph> kept);

  /// Returns the neighborhood, valid until the next call. Checks its arguments.
  [[nodiscard]] virtual VertexSet& search(const Start& start, double radius) = 0;

  /// Returns the center of the ball of a start.
  [[nodiscard]] Point center_of(const Start& start) const;

  /// Returns the size of the neighborhood. Checks its arguments.
  [[nodiscard]] virtual std::size_t count(const Start& start, double radius) { return search(start, radius).count(); }

  /// Refills `out` with its ids, and `distances` unless that is null. Checks its arguments, and changes nothing if it
  /// throws.
  virtual void list(const Start& start, double radius, std::vector<VertexId>& out, std::vector<double>* distances);

  /// Adds its vertices to `found`.
  virtual void collect(const Start& start, double radius, std::vector<LeafSubset>& found) = 0;

  /// Adds its rings to `ids`, and their ends to `sizes`. There is a radius.
  virtual void nested(const Start& start, std::span<const double> radii, std::vector<VertexId>& ids,
                      std::vector<std::size_t>& sizes);

  [[nodiscard]] virtual bool contains(const Start& start, VertexId w, double radius) = 0;
  [[nodiscard]] virtual double connecting_radius(const Start& start, VertexId w) = 0;

  /// Adds the `k` >= 1 nearest vertices, and their connecting radii.
  virtual void nearest(const Start& start, std::size_t k, std::vector<VertexId>& ids, std::vector<double>& radii) = 0;
};

/// Makes the queries of a metric. Each part is made when it is first needed.
[[nodiscard]] std::unique_ptr<SingleQueries> make_queries(BoundIndex index, std::shared_ptr<KeptGraph> graph,
                                                          Metric metric, Isa isa);

/// Makes what searches of an index share, where several threads will begin at once: each would make it.
void prepare_searches(const Index& index, Metric metric);

/// Makes the queries of `Metric::Space`.
[[nodiscard]] std::unique_ptr<SingleQueries> make_space_queries(BoundIndex index, std::shared_ptr<KeptGraph> graph,
                                                                Isa isa);

/// Makes the queries of `Metric::Path` and `Metric::Rings`.
[[nodiscard]] std::unique_ptr<SingleQueries> make_length_queries(BoundIndex index, std::shared_ptr<KeptGraph> graph,
                                                                 Metric metric, Isa isa);

/// Gives tests access to the parts of a searcher.
struct SearcherAccess {
  using State = StraightSearch;

  /// Returns the search of the neighborhoods of vertices by the straight metric.
  static StraightSearch& state(Searcher& searcher);

  static void set_isa(Searcher& searcher, Isa isa);
};

}  // namespace meshhood::inline v0_1
