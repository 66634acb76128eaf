// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "meshhood/adjacency.h"
#include "meshhood/batch.h"
#include "meshhood/index.h"
#include "meshhood/mesh.h"
#include "meshhood/paper.h"
#include "meshhood/search.h"

namespace meshhood::python {

/// The answer to one query. `distances` is empty unless requested.
struct Answer {
  std::vector<VertexId> ids;
  std::vector<double> distances;
};

/// One way to find neighborhoods. Any number of threads may use it at the same time. Each call is made with the
/// interpreter lock, which is released while the call works. Throws as the C++ calls of the same names.
class Method {
 public:
  Method() = default;
  Method(const Method&) = delete;
  Method& operator=(const Method&) = delete;
  virtual ~Method() = default;

  virtual Answer neighborhood(VertexId v, double radius, bool distances) = 0;
  virtual std::size_t count(VertexId v, double radius) = 0;
  virtual std::vector<std::uint64_t> neighborhoods(const BatchQuery& query, const BatchAllocator& allocate,
                                                   const BatchOptions& options) = 0;
  virtual std::vector<std::uint64_t> neighborhood_sizes(const BatchQuery& query, const BatchOptions& options) = 0;
};

/// The exact neighborhood by the index, and the calls that only the index has.
class ExactMethod : public Method {
 public:
  [[nodiscard]] virtual const Index& index() const = 0;
  virtual std::vector<VertexRange> ranges(VertexId v, double radius) = 0;
};

[[nodiscard]] std::shared_ptr<ExactMethod> exact_method(Index index);

/// The approximate neighborhood by the index of the paper.
[[nodiscard]] std::shared_ptr<Method> paper_method(std::shared_ptr<const paper::Index> hierarchy,
                                                   const paper::QueryOptions& options);

/// The vertices within the radius along the edges, with path distances.
[[nodiscard]] std::shared_ptr<Method> edge_method(std::shared_ptr<const ExactMethod> exact);

/// Breadth-first search.
[[nodiscard]] std::shared_ptr<Method> bfs_method(std::shared_ptr<const GraphData> graph);

/// Every vertex within the radius in space, by a scan of all.
[[nodiscard]] std::shared_ptr<Method> ball_method(std::shared_ptr<const GraphData> graph);

}  // namespace meshhood::python
