// SPDX-License-Identifier: MIT
#include "io/float_keeps.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "io/number.h"

namespace meshhood::inline v0_1::io {
namespace {

// From the first that is not 0.
std::ptrdiff_t significant_digits(std::string_view number) {
  const auto mantissa = number.substr(0, number.find_first_of("eE"));
  const auto digits = mantissa.substr(std::min(mantissa.find_first_of("123456789"), mantissa.size()));
  return std::count_if(digits.begin(), digits.end(), [](char c) { return c != '.'; });
}

}  // namespace

bool float_keeps(std::string_view number, double value) {
  constexpr std::ptrdiff_t kMostDigits = 17;  // which tell doubles from each other
  if (std::abs(value) >= kFloatOverflow) return false;
  const auto nearest = static_cast<float>(value);
  if (double{nearest} == value) return true;
  const auto digits = std::clamp<std::ptrdiff_t>(significant_digits(number), 1, kMostDigits);
  if (parse_real<double>(fmt::format("{:.{}e}", double{nearest}, digits - 1)) == value) return true;
  // Below a power of two floats are nearer, so that the nearest number of so many digits may read as another float.
  const std::string fewest = fmt::format("{}", nearest);
  return significant_digits(fewest) == digits && parse_real<double>(fewest) == value;
}

}  // namespace meshhood::inline v0_1::io
