// SPDX-License-Identifier: MIT
#include "statistics.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "io/weld.h"

namespace meshhood::cli {
namespace {

std::map<std::size_t, std::size_t> polygon_degrees(const FacesView& faces) {
  std::map<std::size_t, std::size_t> degrees;
  faces.for_each([&](std::size_t, std::span<const VertexId> corners) { ++degrees[corners.size()]; });
  return degrees;
}

std::size_t repeated_corners(const FacesView& faces) {
  std::size_t repeated = 0;
  std::vector<VertexId> sorted;
  faces.for_each([&](std::size_t, std::span<const VertexId> corners) {
    sorted.assign(corners.begin(), corners.end());
    std::sort(sorted.begin(), sorted.end());
    repeated += static_cast<std::size_t>(sorted.end() - std::unique(sorted.begin(), sorted.end()));
  });
  return repeated;
}

/// The edges of all faces as sorted pairs, sorted: an edge occurs once for each of its faces.
std::vector<std::pair<VertexId, VertexId>> sides(const FacesView& faces) {
  std::vector<std::pair<VertexId, VertexId>> all;
  all.reserve(faces.corners().size());
  faces.for_each([&](std::size_t, std::span<const VertexId> corners) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const VertexId a = corners[i];
      const VertexId b = corners[i + 1 < corners.size() ? i + 1 : 0];
      if (a != b) all.emplace_back(std::min(a, b), std::max(a, b));
    }
  });
  std::sort(all.begin(), all.end());
  return all;
}

void count_edges(const FacesView& faces, Statistics& result) {
  const auto all = sides(faces);
  for (auto edge = all.begin(); edge != all.end();) {
    const auto next = std::find_if(edge, all.end(), [&](const auto& other) { return other != *edge; });
    ++result.edges;
    result.boundary_edges += next - edge == 1 ? 1 : 0;
    result.nonmanifold_edges += next - edge > 2 ? 1 : 0;
    edge = next;
  }
}

/// For each vertex: whether it is in no face.
std::vector<char> mark_isolated(const MeshView& mesh) {
  std::vector<char> done(mesh.positions.size(), 1);
  mesh.faces.for_each([&](std::size_t, std::span<const VertexId> corners) {
    for (const VertexId v : corners) done[v] = 0;
  });
  return done;
}

void mark_component(const AdjacencyView& adjacency, std::size_t start, std::vector<char>& done,
                    std::vector<VertexId>& stack) {
  stack.assign(1, static_cast<VertexId>(start));
  done[start] = 1;
  while (!stack.empty()) {
    const VertexId v = stack.back();
    stack.pop_back();
    for (const VertexId w : adjacency[v]) {
      if (done[w] == 0) stack.push_back(w);
      done[w] = 1;
    }
  }
}

std::size_t repeated_positions(const PositionsView& positions) {
  const std::vector<VertexId> ids = io::welded_ids(positions);
  return ids.empty() ? 0 : ids.size() - 1 - *std::max_element(ids.begin(), ids.end());
}

std::optional<Box> bounds(const PositionsView& positions) {
  if (positions.size() == 0) return std::nullopt;
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Box box{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  positions.visit([&](const auto& xyz) {
    for (std::size_t i = 0; i < 3 * xyz.size(); ++i) {
      const auto value = static_cast<double>(xyz(i / 3, i % 3));
      box.min[i % 3] = std::min(box.min[i % 3], value);
      box.max[i % 3] = std::max(box.max[i % 3], value);
    }
  });
  return box;
}

}  // namespace

std::size_t count_components(const MeshView& mesh, const AdjacencyView& adjacency) {
  std::vector<char> done = mark_isolated(mesh);
  std::vector<VertexId> stack;
  std::size_t components = 0;
  for (std::size_t v = 0; v < done.size(); ++v) {
    if (done[v] != 0) continue;
    mark_component(adjacency, v, done, stack);
    ++components;
  }
  return components;
}

Statistics statistics(const MeshView& mesh, const AdjacencyView& adjacency) {
  Statistics result;
  result.vertices = mesh.positions.size();
  result.faces = mesh.faces.size();
  result.polygon_degrees = polygon_degrees(mesh.faces);
  count_edges(mesh.faces, result);
  const std::vector<char> isolated = mark_isolated(mesh);
  result.isolated_vertices = static_cast<std::size_t>(std::count(isolated.begin(), isolated.end(), 1));
  result.components = count_components(mesh, adjacency);
  result.average_edge = mean_edge_length({mesh.positions, adjacency});
  result.repeated_corners = repeated_corners(mesh.faces);
  result.repeated_positions = repeated_positions(mesh.positions);
  result.bounds = bounds(mesh.positions);
  return result;
}

}  // namespace meshhood::cli
