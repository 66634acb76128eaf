// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace meshhood::inline v0_1::io {

/// The least double that overflows when it is rounded to float.
inline constexpr double kFloatOverflow = 0x1.ffffffp127;

/// A number as it is written: `digits` times a power of ten, of which both the digits and the power are doubles.
struct Decimal {
  static constexpr std::uint64_t kMostDigits = std::uint64_t{1} << 53;
  static constexpr std::array kPowersOfTen = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                              1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

  bool is_negative = false;
  std::uint64_t digits = 0;
  double power = 1;         ///< 10^22 at most
  bool is_divided = false;  ///< by the power, not multiplied

  /// The nearest double, because there is one rounding.
  [[nodiscard]] double value() const {
    const auto whole = static_cast<double>(digits);
    const double magnitude = is_divided ? whole / power : whole * power;
    return is_negative ? -magnitude : magnitude;
  }

  /// `length` in units of the last digit.
  [[nodiscard]] double in_last_digit(double length) const { return is_divided ? length * power : length / power; }
};

/// Takes digits, with or without a point and an exponent, from a text that does not end with them. Returns the place
/// after them, or null where they are no `Decimal`.
[[nodiscard]] inline const char* take_decimal(const char* at, Decimal& decimal) {
  constexpr std::ptrdiff_t kMostCharacters = 19;
  const auto take_digits = [](const char* from, std::uint64_t& number) {
    for (; '0' <= *from && *from <= '9'; ++from) number = 10 * number + static_cast<std::uint64_t>(*from - '0');
    return from;
  };
  const bool is_negative = *at == '-';
  const char* const begin = at += is_negative ? 1 : 0;
  std::uint64_t digits = 0;
  at = take_digits(at, digits);
  std::ptrdiff_t exponent = 0;
  if (*at == '.') {
    const char* const point = at;
    at = take_digits(at + 1, digits);
    exponent = point + 1 - at;
    if (at - begin == 1) return nullptr;
  }
  if (at == begin || at - begin > kMostCharacters || digits > Decimal::kMostDigits) return nullptr;
  if (*at == 'e' || *at == 'E') {
    const char sign = *++at;
    const char* const first = at += sign == '-' || sign == '+' ? 1 : 0;
    std::uint64_t shift = 0;
    at = take_digits(at, shift);
    if (at == first || at - first > 3) return nullptr;
    exponent += sign == '-' ? -static_cast<std::ptrdiff_t>(shift) : static_cast<std::ptrdiff_t>(shift);
  }
  const auto size = static_cast<std::size_t>(std::abs(exponent));
  if (size >= Decimal::kPowersOfTen.size()) return nullptr;
  decimal = {is_negative, digits, Decimal::kPowersOfTen[size], exponent < 0};
  return at;
}

/// Whether float keeps what was written: the float nearest to it prints as it, with as many digits or with the fewest
/// that tell the float from others. So each number that was printed from a float is kept, as are all normal ones of six
/// digits, such as 0.1; 5412345.2 is not.
///
/// number  in decimal digits, without blanks
/// value   the double nearest to it
[[nodiscard]] bool float_keeps(std::string_view number, double value);

/// Whether that is certain at a glance.
[[nodiscard]] inline bool surely_keeps(const Decimal& decimal, double value) {
  constexpr std::uint64_t kSixDigits = 999'999;
  if (decimal.digits <= kSixDigits) return true;
  const double magnitude = std::abs(value);
  if (magnitude >= kFloatOverflow) return false;
  const double lost = std::abs(value - double{static_cast<float>(value)});
  return lost == 0 || decimal.in_last_digit(lost + 0x1p-52 * magnitude) < 0.5 - 0x1p-50;  // all rounding is less
}

}  // namespace meshhood::inline v0_1::io
