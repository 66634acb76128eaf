// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "meshhood/mesh.h"

#include "methods.h"

namespace meshhood::cli {

/// A point of a curve of the paper's Table 2: a method at a radius, per query.
struct Measurement {
  double radius_edges;
  std::string method;
  double microseconds;  ///< of processor time, the median over blocks of queries
  double lower;         ///< quartile of the same
  double upper;
  double count;  ///< means over all queries
  double extra;
  double missing;
};

/// How queries follow each other.
enum class Order {
  Cold,  ///< each somewhere else: the caches know nothing of it
  Warm,  ///< each next to the one before, in the order of the index
};

struct Plan {
  std::vector<double> radii;  ///< in average edges
  std::size_t queries = 1000;
  Order order = Order::Cold;
  std::uint64_t seed = 1;
};

/// Times `methods` at every radius of `plan`. The queries come in blocks that all methods answer one after the other,
/// so that whatever disturbs the machine disturbs all of them; answers are compared outside the timed section with
/// those of the first method. A method that visits all vertices is timed on fewer queries of each block; one that does
/// not list them is not compared.
///
/// unit          one average edge, in the unit of the positions.
/// permutation   the vertices, #V >= 1, neighbours near each other.
/// report        called with the fraction done.
[[nodiscard]] std::vector<Measurement> measure(std::span<const Method> methods, const Plan& plan, double unit,
                                               std::span<const VertexId> permutation,
                                               const std::function<void(double)>& report);

}  // namespace meshhood::cli
