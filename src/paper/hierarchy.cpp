// SPDX-License-Identifier: MIT
// Computes what follows from the rest of a hierarchy: parents, vertices, spheres, and what users see of it.
#include "paper/hierarchy.h"

#include <utility>

#include "meshhood/paper.h"

#include "base/sphere.h"

namespace meshhood::inline v0_1::paper {
namespace {

template <class Real>
void add_parents(const Level<Real>& level, Level<Real>& below) {
  below.parent.resize(below.size());
  for (std::size_t c = 0; c + 1 < level.first_child.size(); ++c) {
    for (std::size_t child = level.first_child[c]; child < level.first_child[c + 1]; ++child) {
      below.parent[child] = static_cast<ClusterId>(c);
    }
  }
}

template <class Real>
void add_first_vertices(Level<Real>& level, const Level<Real>& below) {
  level.first_vertex.reserve(level.first_child.size());
  for (const ClusterId child : level.first_child) level.first_vertex.push_back(below.first_vertex[child]);
}

template <class Real>
PackedIds cluster_of_vertex(const Level<Real>& level, const std::vector<VertexId>& vertices) {
  PackedIds result(vertices.size(), level.size());
  for (std::size_t c = 0; c < level.size(); ++c) {
    for (std::size_t i = level.first_vertex[c]; i < level.first_vertex[c + 1]; ++i) result.set(vertices[i], c);
  }
  return result;
}

template <class T>
std::size_t bytes_of(const std::vector<T>& array) {
  return array.size() * sizeof(T);
}

template <class Real>
std::size_t bytes_of_siblings(const Level<Real>& level) {
  return bytes_of(level.siblings.offsets) + bytes_of(level.siblings.neighbors);
}

template <class Real>
std::size_t bytes_of_clusters(const Level<Real>& level) {
  return bytes_of(level.spheres) + bytes_of(level.first_vertex) + bytes_of(level.first_child) + bytes_of(level.parent);
}

template <class Real>
LevelSummary summarize(const Level<Real>& level) {
  const auto clusters = static_cast<double>(level.size());
  const auto mean = [&](std::size_t total) { return level.size() == 0 ? 0.0 : static_cast<double>(total) / clusters; };
  return {.level = level.number,
          .clusters = level.size(),
          .mean_vertices = mean(level.first_vertex.back()),
          .mean_radius = level.mean_radius,
          .mean_siblings = mean(level.siblings.neighbors.size()),
          .bytes = bytes_of_siblings(level) + bytes_of_clusters(level)};
}

}  // namespace

template <class Real>
void derive(Hierarchy<Real>& hierarchy) {
  for (std::size_t l = 1; l < hierarchy.levels.size(); ++l) {
    add_parents(hierarchy.levels[l], hierarchy.levels[l - 1]);
    add_first_vertices(hierarchy.levels[l], hierarchy.levels[l - 1]);
  }
  hierarchy.lowest_cluster = cluster_of_vertex(hierarchy.levels.front(), hierarchy.vertices);
}

template <class Real>
void enclose(std::span<const Real> positions, Level<Real>& level) {
  level.spheres.resize(level.size());
  for (std::size_t c = 0; c < level.size(); ++c) {
    const std::size_t begin = level.first_vertex[c];
    const std::size_t end = level.first_vertex[c + 1];
    level.spheres[c] = bounding_sphere(positions.subspan(3 * begin, 3 * (end - begin)));
  }
  level.mean_radius = mean_radius(level);
}

template <class Real>
double mean_radius(const Level<Real>& level) {
  double sum = 0;
  for (const Sphere<Real>& sphere : level.spheres) sum += static_cast<double>(sphere.radius);
  return level.size() == 0 ? 0.0 : sum / static_cast<double>(level.size());
}

template void derive(Hierarchy<float>& hierarchy);
template void derive(Hierarchy<double>& hierarchy);
template void enclose(std::span<const float> positions, Level<float>& level);
template void enclose(std::span<const double> positions, Level<double>& level);
template double mean_radius(const Level<float>& level);
template double mean_radius(const Level<double>& level);

Index::Index(std::unique_ptr<const Storage> storage) : storage_(std::move(storage)) {}

std::size_t Index::vertex_count() const { return permutation().size(); }

PositionsView Index::positions() const& {
  return std::visit([](const auto& hierarchy) { return PositionsView(hierarchy.positions); }, storage_->hierarchy);
}

std::span<const VertexId> Index::permutation() const& {
  return std::visit([](const auto& hierarchy) { return std::span(hierarchy.vertices); }, storage_->hierarchy);
}

std::vector<LevelSummary> Index::levels() const {
  return std::visit(
      [](const auto& hierarchy) {
        std::vector<LevelSummary> result;
        result.reserve(hierarchy.levels.size());
        for (const auto& level : hierarchy.levels) result.push_back(summarize(level));
        return result;
      },
      storage_->hierarchy);
}

IndexBytes Index::bytes() const {
  return std::visit(
      [](const auto& hierarchy) {
        IndexBytes result;
        result.positions = bytes_of(hierarchy.positions);
        result.permutation = bytes_of(hierarchy.vertices) + hierarchy.lowest_cluster.bytes();
        for (const auto& level : hierarchy.levels) {
          result.graph += bytes_of_siblings(level);
          result.tree += bytes_of_clusters(level);
        }
        return result;
      },
      storage_->hierarchy);
}

}  // namespace meshhood::inline v0_1::paper
