// SPDX-License-Identifier: MIT
#pragma once

#include <tuple>

#include "meshhood/vertex_id.h"

namespace meshhood {

/// One of the vertices that a growing ball reaches at the same radius.
struct NextVertex {
  double distance;  // from the center
  VertexId vertex;

  friend bool operator<(const NextVertex& a, const NextVertex& b) {
    return std::tie(a.distance, a.vertex) < std::tie(b.distance, b.vertex);
  }
};

}  // namespace meshhood
