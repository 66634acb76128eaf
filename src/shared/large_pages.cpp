// SPDX-License-Identifier: MIT
#include "shared/large_pages.h"

#include <memory>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace meshhood::inline v0_1 {

void prefer_large_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#if defined(MADV_HUGEPAGE)
  constexpr std::size_t kLargePage = std::size_t{1} << 21;
  if (std::align(kLargePage, kLargePage, memory, bytes) == nullptr) return;
  static_cast<void>(madvise(memory, bytes, MADV_HUGEPAGE));  // if it fails, all is as it was
#endif
}

}  // namespace meshhood::inline v0_1
