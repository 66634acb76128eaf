// SPDX-License-Identifier: MIT
#include "io/number.h"

#include <charconv>
#include <system_error>

#include <fast_float/fast_float.h>

namespace meshhood::inline v0_1::io {
namespace {

std::string_view without_plus(std::string_view token) {
  const bool plus = token.size() > 1 && token[0] == '+' && token[1] != '-' && token[1] != '+';
  return plus ? token.substr(1) : token;
}

template <class Integer>
std::optional<Integer> parse_whole(std::string_view token) {
  token = without_plus(token);
  Integer value = 0;
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
  if (error != std::errc() || end != token.data() + token.size()) return std::nullopt;
  return value;
}

}  // namespace

template <class Real>
std::optional<Real> parse_real(std::string_view token) {
  token = without_plus(token);
  if (token.empty()) return std::nullopt;
  Real value = 0;
  const auto [end, error] = fast_float::from_chars(token.data(), token.data() + token.size(), value);
  // Newer releases report overflow and underflow, but still set the infinite or tiny value.
  const bool is_number = error == std::errc() || error == std::errc::result_out_of_range;
  if (!is_number || end != token.data() + token.size()) return std::nullopt;
  return value;
}

template std::optional<float> parse_real<float>(std::string_view token);
template std::optional<double> parse_real<double>(std::string_view token);

std::optional<std::int64_t> parse_integer(std::string_view token) { return parse_whole<std::int64_t>(token); }

std::optional<std::uint64_t> parse_count(std::string_view token) { return parse_whole<std::uint64_t>(token); }

}  // namespace meshhood::inline v0_1::io
