// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>

#include "meshhood/fingerprint.h"

namespace meshhood {

using ByteSpans = std::initializer_list<std::span<const std::byte>>;

/// XXH3 of `parts`, one after the other: 64 bits.
[[nodiscard]] std::uint64_t checksum(ByteSpans parts);

/// The same with 128 bits.
[[nodiscard]] Fingerprint wide_checksum(ByteSpans parts);

}  // namespace meshhood
