// SPDX-License-Identifier: MIT
#include "quantity.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

#include <fmt/format.h>

namespace meshhood::cli {

std::string bytes_text(double bytes, int digits) {
  constexpr std::array<std::string_view, 6> kUnits{"bytes", "kB", "MB", "GB", "TB", "PB"};
  if (bytes < 1000) return fmt::format("{:.0f} bytes", bytes);
  std::size_t unit = 0;
  // 999.6 kB would be rounded to 1e+03 kB.
  const double most = 1000 - std::pow(10.0, 3 - digits) / 2;
  for (; bytes >= most && unit + 1 < kUnits.size(); ++unit) bytes /= 1000;
  return fmt::format("{:.{}g} {}", bytes, digits, kUnits[unit]);
}

std::string rounded_text(double number) {
  std::string text = fmt::format("{:.3g}", number);
  if (number < 999.5 || !std::isfinite(number)) return text;
  const double step = std::pow(10.0, std::floor(std::log10(number)) - 2);
  text = fmt::format("{:.0f}", std::round(number / step) * step);
  for (std::size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, ",");
  return text;
}

}  // namespace meshhood::cli
