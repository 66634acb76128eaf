// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

namespace meshhood::inline v0_1 {

/// The Gaussian that falls from 1 to 1/1000, `1000^-s` for the share s of the squared radius, 0 to 1: a polynomial for
/// `1000^(-s/32)`, which is 1 at 0, squared `kGaussianSquarings` times. Its relative error with all roundings is at
/// most 1e-14. No function of a C library takes part, so it has the same bits everywhere.
constexpr std::array kGaussian{1.0,
                               -0.2158673524681917,
                               0.023299356930803216,
                               -0.001676523498077354,
                               9.047667053802229e-05,
                               -3.906185266943825e-06,
                               1.4052225189689913e-07,
                               -4.316853840930143e-09,
                               1.0627860032275078e-10};
constexpr int kGaussianSquarings = 5;

inline double gaussian(double share) {
  double result = kGaussian.back();
  for (std::size_t i = kGaussian.size() - 1; i-- > 0;) result = result * share + kGaussian[i];
  for (int i = 0; i < kGaussianSquarings; ++i) result *= result;
  return result;
}

}  // namespace meshhood::inline v0_1
