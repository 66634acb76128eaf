// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <span>
#include <string>

#include "format/section_reader.h"
#include "paper/hierarchy.h"

/// What a search in the paper's index relies on. All errors are Error{MalformedIndex}.
namespace meshhood::file {

/// The ids 0 .. size - 1, each once.
void verify_permutation(std::span<const VertexId> ids, const SectionReader& file);

/// Ascending from 0 to `end`; none is empty.
void verify_starts(std::span<const paper::ClusterId> starts, std::size_t end, const SectionReader& file);

/// One row a cluster, ascending, in range, without the cluster itself, and each in both directions.
void verify_siblings(const AdjacencyView& siblings, const SectionReader& file);

template <class Real>
void verify_spheres(std::span<const Sphere<Real>> spheres, const SectionReader& file) {
  for (const Sphere<Real>& s : spheres) {
    const bool is_sphere = std::isfinite(s.x) && std::isfinite(s.y) && std::isfinite(s.z) && std::isfinite(s.radius);
    if (!is_sphere || s.radius < 0) file.refuse(&s, "a sphere that is none");
  }
}

/// Spheres hold their vertices, as a query computes distances.
template <class Real>
void verify_enclosed(const paper::Hierarchy<Real>& hierarchy, const SectionReader& file);

}  // namespace meshhood::file
