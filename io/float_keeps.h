// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

namespace meshhood::io {

/// The least double that overflows when it is rounded to float.
inline constexpr double kFloatOverflow = 0x1.ffffffp127;

/// Powers of ten, correct to a part in 10^14.
class PowersOfTen {
 public:
  constexpr PowersOfTen() {
    powers_[kMost] = 1;
    for (std::size_t i = 1; i <= kMost; ++i) {
      powers_[kMost + i] = powers_[kMost + i - 1] * 10;
      powers_[kMost - i] = powers_[kMost - i + 1] / 10;
    }
  }

  /// 0 where the exponent is not in the table.
  [[nodiscard]] constexpr double operator()(std::ptrdiff_t exponent) const {
    const auto i = static_cast<std::size_t>(exponent + static_cast<std::ptrdiff_t>(kMost));
    return i < powers_.size() ? powers_[i] : 0;
  }

 private:
  static constexpr std::size_t kMost = 64;
  std::array<double, 2 * kMost + 1> powers_ = {};
};

inline constexpr PowersOfTen kPowersOfTen;

/// The value of the last digit of a decimal number: 0.01 of "-12.50", 100 of "1.25e4". 0 where it needs a closer look.
[[nodiscard]] inline double last_place(std::string_view number) {
  const auto is_digit = [](char c) { return '0' <= c && c <= '9'; };
  const char* at = number.data();
  const char* const end = at + number.size();
  if (at != end && (*at == '-' || *at == '+')) ++at;
  while (at != end && is_digit(*at)) ++at;
  std::ptrdiff_t exponent = 0;
  if (at != end && *at == '.') {
    const char* const point = at++;
    while (at != end && is_digit(*at)) ++at;
    exponent = point + 1 - at;
  }
  if (at == end) return kPowersOfTen(exponent);
  if (*at != 'e' && *at != 'E') return 0;
  const bool is_negative = ++at != end && *at == '-';
  if (at != end && (*at == '-' || *at == '+')) ++at;
  if (end - at > 3) return 0;
  std::ptrdiff_t power = 0;
  for (; at != end; ++at) power = 10 * power + (*at - '0');
  return kPowersOfTen(exponent + (is_negative ? -power : power));
}

/// Whether the float nearest to `value` is `number` when it is printed with as many digits, or with the fewest that
/// tell it from other floats.
[[nodiscard]] bool prints_as(std::string_view number, double value);

/// Whether float keeps what was written: a float prints as it. So each number that was printed from a float is kept, as
/// are all normal ones of six digits, such as 0.1; 5412345.2 is not.
///
/// number  in decimal digits, without blanks
/// value   the double nearest to it
[[nodiscard]] inline bool float_keeps(std::string_view number, double value) {
  const double magnitude = std::abs(value);
  if (magnitude >= kFloatOverflow) return false;
  const double lost = std::abs(value - double{static_cast<float>(value)});
  if (lost == 0) return true;
  // Certainly less than half of the last place, although all three are rounded.
  if (lost + 0x1p-52 * magnitude < 0.4999 * last_place(number)) return true;
  return prints_as(number, value);
}

}  // namespace meshhood::io
