// SPDX-License-Identifier: MIT
#pragma once

namespace meshhood {

/// Asks the processor to fetch what lies at `address`, which will be read soon. Never faults.
inline void prefetch(const void* address) {
#if defined(__GNUC__) || defined(__clang__)
  __builtin_prefetch(address);
#else
  static_cast<void>(address);
#endif
}

}  // namespace meshhood
