// SPDX-License-Identifier: MIT
#include "base/adjacency.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "meshhood/error.h"

#include "base/validate.h"
#include "shared/distance.h"

namespace meshhood::inline v0_1 {
namespace {

/// Sorts each row, removes duplicates, and closes the gaps.
Adjacency with_unique_rows(Adjacency all, TaskContext& task) {
  constexpr std::size_t kGrain = 4096;
  const std::size_t vertices = all.offsets.size() - 1;
  const auto row = [&](std::size_t v) { return all.neighbors.begin() + static_cast<std::ptrdiff_t>(all.offsets[v]); };
  Adjacency result;
  result.offsets.resize(vertices + 1);
  task.parallel_for(vertices, kGrain, [&](unsigned, std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      std::sort(row(v), row(v + 1));
      result.offsets[v + 1] = static_cast<EdgeOffset>(std::unique(row(v), row(v + 1)) - row(v));
    }
  });
  std::partial_sum(result.offsets.begin(), result.offsets.end(), result.offsets.begin());
  result.neighbors.resize(result.offsets.back());
  task.parallel_for(vertices, kGrain, [&](unsigned, std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const std::size_t size = result.offsets[v + 1] - result.offsets[v];
      std::copy_n(row(v), size, result.neighbors.data() + result.offsets[v]);
    }
  });
  return result;
}

std::string row_of(std::size_t v) { return "neighbors of vertex " + std::to_string(v) + ": "; }

void validate_row(const AdjacencyView& adjacency, std::size_t v) {
  const std::span<const VertexId> row = adjacency[v];
  for (std::size_t i = 0; i < row.size(); ++i) {
    const VertexId w = row[i];
    if (w >= adjacency.size()) {
      raise(ErrorCode::InvalidMesh, row_of(v) + "vertex " + std::to_string(w) + ", but the graph has " +
                                        std::to_string(adjacency.size()) + " vertices");
    }
    if (w == v) raise(ErrorCode::InvalidMesh, row_of(v) + "the vertex itself");
    if (i > 0 && row[i - 1] >= w) {
      raise(ErrorCode::InvalidMesh,
            row_of(v) + std::to_string(w) + " after " + std::to_string(row[i - 1]) + ", expected ascending ids");
    }
  }
}

void validate_symmetry(const AdjacencyView& adjacency, std::size_t v) {
  for (const VertexId w : adjacency[v]) {
    const std::span<const VertexId> row = adjacency[w];
    if (!std::binary_search(row.begin(), row.end(), static_cast<VertexId>(v))) {
      raise(ErrorCode::InvalidMesh, row_of(v) + std::to_string(w) + ", but " + std::to_string(v) +
                                        " is not among the neighbors of " + std::to_string(w));
    }
  }
}

void validate_offsets(const AdjacencyView& adjacency) {
  const auto& offsets = adjacency.offsets;
  if (!offsets.empty() && offsets[0] != 0) {
    raise(ErrorCode::InvalidMesh, "neighbor offsets begin with " + std::to_string(offsets[0]) + ", expected 0");
  }
  for (std::size_t v = 0; v + 1 < offsets.size(); ++v) {
    if (offsets[v + 1] < offsets[v] || offsets[v + 1] > adjacency.neighbors.size()) {
      raise(ErrorCode::InvalidMesh, row_of(v) + "from " + std::to_string(offsets[v]) + " to " +
                                        std::to_string(offsets[v + 1]) + " in a list of " +
                                        std::to_string(adjacency.neighbors.size()));
    }
  }
  const std::size_t end = offsets.empty() ? 0 : offsets.back();
  if (end != adjacency.neighbors.size()) {
    raise(ErrorCode::InvalidMesh, "neighbor offsets end with " + std::to_string(end) + ", but there are " +
                                      std::to_string(adjacency.neighbors.size()) + " neighbors");
  }
}

}  // namespace

void check_corner_count(const FacesView& faces) {
  // Every corner starts one side, and each side is in two rows.
  if (faces.corner_count() > kMaxNeighbors / 2) {
    raise(ErrorCode::TooLarge, std::to_string(faces.corner_count()) + " face corners, but the limit is " +
                                   std::to_string(kMaxNeighbors / 2));
  }
}

Adjacency adjacency(const MeshView& mesh) {
  TaskContext task;
  return adjacency(mesh, task);
}

Adjacency adjacency(const MeshView& mesh, TaskContext& task) {
  validate(mesh, task);
  check_corner_count(mesh.faces);
  const auto for_each_neighbor = [&](auto&& f) {
    for_each_side(mesh.faces, 0, mesh.faces.size(), [&](VertexId v, VertexId w) {
      f(v, w);
      f(w, v);
    });
  };
  return with_unique_rows(gather_rows(mesh.positions.size(), for_each_neighbor), task);
}

void validate(const GraphView& graph) {
  validate(graph.positions);
  const AdjacencyView& adjacency = graph.adjacency;
  if (adjacency.size() != graph.positions.size()) {
    raise(ErrorCode::InvalidMesh, std::to_string(adjacency.size()) + " rows of neighbors for " +
                                      std::to_string(graph.positions.size()) + " vertices");
  }
  validate_offsets(adjacency);
  for (std::size_t v = 0; v < adjacency.size(); ++v) validate_row(adjacency, v);
  for (std::size_t v = 0; v < adjacency.size(); ++v) validate_symmetry(adjacency, v);
}

double mean_edge_length(const GraphView& graph) {
  const AdjacencyView& adjacency = graph.adjacency;
  return graph.positions.visit([&](const auto& xyz) {
    double sum = 0;
    for (std::size_t v = 0; v < adjacency.size(); ++v) {
      const Point p = point(xyz, v);
      for (const VertexId w : adjacency[v]) {
        if (w > v) sum += std::sqrt(squared_distance(p, point(xyz, w)));
      }
    }
    const std::size_t edges = adjacency.neighbors.size() / 2;
    return edges == 0 ? 0.0 : sum / static_cast<double>(edges);
  });
}

}  // namespace meshhood::inline v0_1
