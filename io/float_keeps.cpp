// SPDX-License-Identifier: MIT
#include "io/float_keeps.h"

#include <algorithm>

#include <fmt/format.h>

#include "io/number.h"

namespace meshhood::io {
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
  return parse_real<double>(fmt::format("{:.{}e}", double{nearest}, digits - 1)) == value ||
         parse_real<double>(fmt::format("{}", nearest)) == value;
}

}  // namespace meshhood::io
