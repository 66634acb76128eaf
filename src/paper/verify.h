// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <span>
#include <string>

#include "format/section_reader.h"
#include "paper/hierarchy.h"

/// Verifies what a search of the paper's index relies on. All throw Error{MalformedIndex}.
namespace meshhood::file {

/// `ids` has each of 0 .. size - 1 once.
void verify_permutation(std::span<const VertexId> ids, const SectionReader& file);

/// `starts` ascends strictly from 0 to `end`.
void verify_starts(std::span<const paper::ClusterId> starts, std::size_t end, const SectionReader& file);

/// Each row ascends, is in range, and does not contain its own cluster; each pair occurs in both directions.
void verify_siblings(const AdjacencyView& siblings, const SectionReader& file);

template <class Real>
void verify_spheres(std::span<const Sphere<Real>> spheres, const SectionReader& file) {
  for (const Sphere<Real>& s : spheres) {
    const bool is_sphere = std::isfinite(s.x) && std::isfinite(s.y) && std::isfinite(s.z) && std::isfinite(s.radius);
    if (!is_sphere || s.radius < 0)
      file.refuse(&s, "a sphere whose center or radius is not finite, or whose radius is negative");
  }
}

/// Spheres enclose their vertices, with the distances of the query.
template <class Real>
void verify_enclosed(const paper::Hierarchy<Real>& hierarchy, const SectionReader& file);

}  // namespace meshhood::file
