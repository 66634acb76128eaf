// SPDX-License-Identifier: MIT
// Compiles a source with kernels once for each target, and includes what the kernels share. The source defines
// HWY_TARGET_INCLUDE, its own path, before.
#include "simd/target_list.h"

// clang-format off: in this order.
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "simd/wasm_doubles-inl.h"
#include "simd/lanes-inl.h"
// clang-format on
