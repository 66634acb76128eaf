// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace meshhood::io {

/// The number that the whole of `token` spells in decimal, correctly rounded, whatever the locale; a leading `+` is
/// allowed. `nan` and `inf`, in C's spellings, are numbers; one too large for `Real` becomes infinite.
template <class Real>
[[nodiscard]] std::optional<Real> parse_real(std::string_view token);

/// The integer that the whole of `token` spells in decimal, with an optional sign, where it fits.
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view token);

/// As `parse_integer`, for counts: the range reaches to 2^64 - 1 and ends at 0.
[[nodiscard]] std::optional<std::uint64_t> parse_count(std::string_view token);

}  // namespace meshhood::io
