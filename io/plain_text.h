// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <system_error>

#include <fast_float/fast_float.h>

#include "io/float_keeps.h"
#include "shared/distance.h"

/// Text in the form that programs write: blanks are spaces and tabs, and numbers are digits. Each function takes a
/// place in a text that ends with a line end, and returns the place after what it has read, or null if that is not
/// plain. Null stays null.
namespace meshhood::inline v0_1::io::plain {

[[nodiscard]] inline bool is_blank(char c) { return c == ' ' || c == '\t'; }
[[nodiscard]] inline bool is_digit(char c) { return '0' <= c && c <= '9'; }

[[nodiscard]] inline const char* skip_blanks(const char* at) {
  while (is_blank(*at)) ++at;
  return at;
}

/// Past blanks and the end of the line.
[[nodiscard]] inline const char* take_line_end(const char* at) {
  if (at == nullptr) return at;
  at = skip_blanks(at);
  if (*at == '\r') ++at;
  return *at == '\n' ? at + 1 : nullptr;
}

[[nodiscard]] inline bool ends_token(const char* at) { return is_blank(*at) || *at == '\n' || *at == '\r'; }

/// A number that ends with its token, whatever its size.
template <class Real>
[[nodiscard]] const char* take_number(const char* at, const char* end, Real& value) {
  if (at == nullptr) return at;
  const auto [after, error] = fast_float::from_chars(skip_blanks(at), end, value);
  return error == std::errc() && ends_token(after) ? after : nullptr;
}

/// A number that is a coordinate.
template <class Real>
[[nodiscard]] const char* take_coordinate(const char* at, const char* end, Real& value) {
  const char* const after = take_number(at, end, value);
  return after != nullptr && double{std::abs(value)} <= kLargestCoordinate ? after : nullptr;  // false for NaN
}

/// The same, with a look at how the number is written: `keeps` becomes false unless float keeps it (see `float_keeps`).
[[nodiscard]] inline const char* take_coordinate(const char* at, const char* end, double& value, bool& keeps) {
  if (at == nullptr) return at;
  at = skip_blanks(at);
  Decimal decimal;
  const char* after = keeps ? take_decimal(at, decimal) : nullptr;
  if (after != nullptr && ends_token(after)) {
    value = decimal.value();
    if (surely_keeps(decimal, value)) return after;
  } else {
    after = take_coordinate(at, end, value);
    if (after == nullptr || !keeps) return after;
  }
  keeps = float_keeps(std::string_view(at, static_cast<std::size_t>(after - at)), value);
  return after;
}

/// Float is asked for.
[[nodiscard]] inline const char* take_coordinate(const char* at, const char* end, float& value, bool& /*keeps*/) {
  return take_coordinate(at, end, value);
}

/// A whole number of at most nine digits, whatever follows.
[[nodiscard]] inline const char* take_digits(const char* at, std::uint32_t& value) {
  constexpr int kMostDigits = 9;
  const char* const begin = at;
  value = 0;
  for (; is_digit(*at); ++at) {
    if (at - begin == kMostDigits) return nullptr;
    value = 10 * value + static_cast<std::uint32_t>(*at - '0');
  }
  return at == begin ? nullptr : at;
}

/// The same, where the token ends.
[[nodiscard]] inline const char* take_integer(const char* at, std::uint32_t& value) {
  const char* const after = at == nullptr ? at : take_digits(skip_blanks(at), value);
  return after != nullptr && ends_token(after) ? after : nullptr;
}

/// A token of any printable characters.
[[nodiscard]] inline const char* skip_token(const char* at) {
  if (at == nullptr) return at;
  const char* const begin = skip_blanks(at);
  at = begin;
  while ('!' <= *at && *at <= '~') ++at;
  return at != begin && ends_token(at) ? at : nullptr;
}

}  // namespace meshhood::inline v0_1::io::plain
