// SPDX-License-Identifier: MIT
#pragma once

#include "simd/kernels.h"

#if defined(__wasm_simd128__) && !defined(MESHHOOD_NARROW_IDS)
#define MESHHOOD_HAS_WASM128 1

namespace meshhood {

/// The kernels for WebAssembly with vectors of 128 bits.
const Kernels& wasm128_kernels();

}  // namespace meshhood

#endif
