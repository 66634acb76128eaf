// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "meshhood/mesh.h"

namespace meshhood::wasm {

/// The arrays of the last answer, which JavaScript reads. Valid until the next call.
struct Answer {
  std::vector<VertexId> ids;
  std::vector<double> reals;          ///< distances, radii, aggregates, coordinates
  std::vector<std::uint32_t> counts;  ///< sizes, or the offsets of rows
};

/// One for each instance of the module, which has one thread.
inline Answer answer;

}  // namespace meshhood::wasm
