// SPDX-License-Identifier: MIT
#include "meshhood/aggregate.h"

#include "shared/distance.h"
#include "simd/gaussian.h"

namespace meshhood {

double smoothing_radius(double fwhm) {
  check_radius(fwhm, "fwhm: ");
  constexpr double kRadius = 1.5784315224822145;  // sqrt(log2(1000)) / 2
  return kRadius * fwhm;
}

double smoothing_weight(SmoothingKernel kernel, double distance, double radius) {
  if (!(distance <= radius)) return 0;
  if (kernel == SmoothingKernel::Box || distance == 0) return 1;
  const double share = distance / radius;
  if (kernel == SmoothingKernel::Gaussian) return gaussian(share * share);
  // Not 1 - share^2, whose rounding would give a vertex at the rim a weight.
  const double weight = (1 - share) * (1 + share);
  return kernel == SmoothingKernel::Biweight ? weight * weight : weight;
}

}  // namespace meshhood
