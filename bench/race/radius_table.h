// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "meshhood/batch.h"
#include "meshhood/mesh.h"

namespace meshhood::bench {

/// A search to be timed.
struct Contestant {
  std::string name;
  std::function<void(VertexId v, double radius, std::vector<VertexId>& out)> neighborhood;
  bool visits_all_vertices = false;  ///< each query costs O(#V)
  bool lists_vertices = true;        ///< if false, `neighborhood` does not write `out`
};

/// A searcher of `method`, for one thread.
[[nodiscard]] Contestant contestant(std::string name, const SearchMethod& method);

/// One contestant at one radius: a row of the paper's Table 2. All figures are per query.
struct Measurement {
  double radius_edges;
  std::string method;
  double microseconds;  ///< processor time, the median over blocks of queries
  double lower;         ///< quartiles of the same
  double upper;
  double count;  ///< means over all queries
  double extra;
  double missing;
};

/// How the query vertices follow each other.
enum class Order {
  Cold,  ///< each at a random place, so that the caches do not hold its surroundings
  Warm,  ///< each next to the one before, in index order
};

/// Which queries to time.
struct Plan {
  std::vector<double> radii;  ///< in mean edge lengths
  std::size_t queries = 1000;
  Order order = Order::Cold;
  std::uint64_t seed = 1;
};

/// Times all contestants at every radius of `plan`. They answer each block of queries in turn, so that a disturbance of
/// the machine affects all of them. Outside the timed part, answers are compared with those of the first. A
/// contestant that visits all vertices is timed on fewer queries of each block; one that does not list vertices is not
/// compared.
///
/// unit          the mean edge length, in the unit of the positions.
/// permutation   the vertices, #V >= 1, in an order that keeps neighbors close.
/// report        called after each block; an exception from it ends the measurement.
[[nodiscard]] std::vector<Measurement> measure_radii(
    std::span<const Contestant> contestants, const Plan& plan, double unit, std::span<const VertexId> permutation,
    const std::function<void(std::size_t done, std::size_t total)>& report);

}  // namespace meshhood::bench
