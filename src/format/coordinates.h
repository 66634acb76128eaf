// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <span>

#include "format/section_reader.h"
#include "shared/distance.h"

namespace meshhood::file {

/// Throws if a coordinate is one that `validate` rejects.
template <class Real>
void verify_coordinates(std::span<const Real> xyz, const SectionReader& file) {
  for (const Real& value : xyz) {
    if (std::abs(static_cast<double>(value)) <= kLargestCoordinate) continue;
    file.refuse(&value, "a coordinate is not finite or exceeds 2^500");
  }
}

}  // namespace meshhood::file
