// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "meshhood/fingerprint.h"

namespace meshhood::wasm {

/// Of the bytes of the corners and the offsets, in their order: `meshhood::fingerprint` does not see which way round a
/// face is, on which its normal depends.
[[nodiscard]] Fingerprint hash_faces(const void* corners, std::size_t corner_count, const void* offsets,
                                     std::size_t offset_count);

}  // namespace meshhood::wasm
