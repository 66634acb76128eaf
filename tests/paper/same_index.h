// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <variant>
#include <vector>

#include "paper/hierarchy.h"

namespace meshhood::test {

template <class Real>
bool same_sphere(const Sphere<Real>& a, const Sphere<Real>& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z && a.radius == b.radius;
}

template <class Real>
bool same_level(const paper::Level<Real>& a, const paper::Level<Real>& b) {
  return a.number == b.number && a.mean_radius == b.mean_radius &&
         std::ranges::equal(a.spheres, b.spheres, same_sphere<Real>) && a.first_vertex == b.first_vertex &&
         a.first_child == b.first_child && a.parent == b.parent && a.siblings.offsets == b.siblings.offsets &&
         a.siblings.neighbors == b.siblings.neighbors;
}

template <class Real>
bool same_hierarchy(const paper::Hierarchy<Real>& a, const paper::Hierarchy<Real>& b) {
  if (a.positions != b.positions || a.vertices != b.vertices) return false;
  for (std::size_t v = 0; v < a.vertices.size(); ++v) {
    if (a.lowest_cluster[v] != b.lowest_cluster[v]) return false;
  }
  return std::ranges::equal(a.levels, b.levels, same_level<Real>);
}

template <class Real, class Other>
bool same_hierarchy(const paper::Hierarchy<Real>&, const paper::Hierarchy<Other>&) {
  return false;
}

/// Whether all arrays of two indexes agree.
inline bool same_index(const paper::Index& a, const paper::Index& b) {
  return std::visit([](const auto& x, const auto& y) { return same_hierarchy(x, y); }, paper::IndexAccess::hierarchy(a),
                    paper::IndexAccess::hierarchy(b));
}

}  // namespace meshhood::test
