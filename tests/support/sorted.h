// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include "meshhood/mesh.h"

namespace meshhood::test {

[[nodiscard]] inline std::vector<VertexId> sorted(std::vector<VertexId> ids) {
  std::sort(ids.begin(), ids.end());
  return ids;
}

}  // namespace meshhood::test
