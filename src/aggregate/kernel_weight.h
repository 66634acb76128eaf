// SPDX-License-Identifier: MIT
#pragma once

#include "meshhood/aggregate.h"

namespace meshhood {

/// The weight of a vertex at a distance, as a part of its own; 1 without a smoothing kernel.
[[nodiscard]] inline double kernel_weight(SmoothingKernel kernel, double distance, double radius) {
  if (kernel == SmoothingKernel::Box || distance == 0) return 1;
  const double share = distance / radius;
  // Not 1 - share^2, whose rounding would give a vertex at the rim a weight.
  const double weight = (1 - share) * (1 + share);
  return kernel == SmoothingKernel::Biweight ? weight * weight : weight;
}

}  // namespace meshhood
