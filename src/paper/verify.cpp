// SPDX-License-Identifier: MIT
#include "paper/verify.h"

#include <vector>

#include "meshhood/error.h"

#include "shared/distance.h"

namespace meshhood::file {
namespace {

void verify_row(const AdjacencyView& siblings, std::size_t cluster, const SectionReader& file) {
  const std::span<const VertexId> row = siblings[cluster];
  for (const VertexId& sibling : row) {
    const bool is_next = &sibling == row.data() || (&sibling)[-1] < sibling;
    if (sibling < siblings.size() && sibling != cluster && is_next) continue;
    file.refuse(&sibling, "cluster " + std::to_string(cluster) + ": sibling " + std::to_string(sibling) +
                              ", expected another of " + std::to_string(siblings.size()) + ", in ascending order");
  }
}

}  // namespace

void verify_permutation(std::span<const VertexId> ids, const SectionReader& file) {
  std::vector<bool> seen(ids.size());
  for (const VertexId& id : ids) {
    if (id >= ids.size() || seen[id]) {
      file.refuse(&id, "vertex " + std::to_string(id) + ", expected each of " + std::to_string(ids.size()) + " once");
    }
    seen[id] = true;
  }
}

void verify_starts(std::span<const paper::ClusterId> starts, std::size_t end, const SectionReader& file) {
  if (starts.front() != 0) file.refuse(starts.data(), "begins with " + std::to_string(starts.front()) + ", expected 0");
  for (std::size_t c = 0; c + 1 < starts.size(); ++c) {
    if (starts[c] < starts[c + 1] && starts[c + 1] <= end) continue;
    file.refuse(&starts[c], "cluster " + std::to_string(c) + ": range from " + std::to_string(starts[c]) + " to " +
                                std::to_string(starts[c + 1]) + ", expected a range that is not empty and ends by " +
                                std::to_string(end));
  }
  if (starts.back() != end) {
    file.refuse(&starts.back(), "ends with " + std::to_string(starts.back()) + ", expected " + std::to_string(end));
  }
}

void verify_siblings(const AdjacencyView& siblings, const SectionReader& file) {
  const std::size_t end = siblings.neighbors.size();
  if (siblings.offsets.front() != 0 || siblings.offsets.back() != end) {
    file.refuse(siblings.offsets.data(), "rows do not run from 0 to " + std::to_string(end));
  }
  for (std::size_t c = 0; c < siblings.size(); ++c) {
    if (siblings.offsets[c] <= siblings.offsets[c + 1] && siblings.offsets[c + 1] <= end) continue;
    file.refuse(&siblings.offsets[c], "cluster " + std::to_string(c) + ": rows do not ascend");
  }
  for (std::size_t c = 0; c < siblings.size(); ++c) verify_row(siblings, c, file);
  // Clusters are visited in ascending order, so their entries must come in that order in each sibling's row.
  std::vector<EdgeOffset> next(siblings.offsets.begin(), siblings.offsets.end());
  for (std::size_t c = 0; c < siblings.size(); ++c) {
    for (const VertexId& sibling : siblings[c]) {
      const std::size_t back = next[sibling]++;
      if (back < siblings.offsets[sibling + std::size_t{1}] && siblings.neighbors[back] == c) continue;
      file.refuse(&sibling, "cluster " + std::to_string(c) + ": sibling " + std::to_string(sibling) +
                                " does not list it as a sibling");
    }
  }
}

template <class Real>
void verify_enclosed(const paper::Hierarchy<Real>& hierarchy, const SectionReader& file) {
  for (std::size_t l = 0; l < hierarchy.levels.size(); ++l) {
    const paper::Level<Real>& level = hierarchy.levels[l];
    for (std::size_t c = 0; c < level.size(); ++c) {
      const Sphere<Real>& sphere = level.spheres[c];
      for (std::size_t i = level.first_vertex[c]; i < level.first_vertex[c + 1]; ++i) {
        const double d2 = squared_distance(center_of(sphere), point<Real>(hierarchy.positions, i));
        if (std::sqrt(d2) <= static_cast<double>(sphere.radius)) continue;
        file.refuse_in(
            "spheres " + std::to_string(l), c * sizeof(Sphere<Real>),
            "cluster " + std::to_string(c) + ": does not enclose vertex " + std::to_string(hierarchy.vertices[i]));
      }
    }
  }
}

template void verify_enclosed(const paper::Hierarchy<float>& hierarchy, const SectionReader& file);
template void verify_enclosed(const paper::Hierarchy<double>& hierarchy, const SectionReader& file);

}  // namespace meshhood::file
