// SPDX-License-Identifier: MIT
#include <utility>

#include "meshhood/paper.h"

#include "paper/hierarchy.h"

namespace meshhood::inline v0_1::paper {
namespace {

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
