// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>

#include "meshhood/export.h"
#include "meshhood/fingerprint.h"

namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

using ByteSpans = std::initializer_list<std::span<const std::byte>>;

/// Returns the 64-bit XXH3 hash of the concatenation of `parts`.
[[nodiscard]] std::uint64_t checksum(ByteSpans parts);

/// Returns the 128-bit XXH3 hash of the concatenation of `parts`.
[[nodiscard]] Fingerprint wide_checksum(ByteSpans parts);

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
