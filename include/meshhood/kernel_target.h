// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "meshhood/export.h"

namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

/// Returns the instructions that the inner loops use on this processor, as Google Highway names them: "AVX3" for
/// AVX-512, "AVX2", "SSE4", "NEON", "WASM", or "SCALAR" for none but those of every processor. They are chosen at the
/// first call. Answers do not depend on them, only their speed. Any number of threads may call it.
[[nodiscard]] std::string_view kernel_target();

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
