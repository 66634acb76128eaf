// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <variant>

#include "base/prefetch.h"
#include "exact/layout.h"

namespace meshhood {

/// Fetches the positions of `size` vertices from `first` on, in index order.
inline void fetch_positions(const IndexView& index, std::size_t first, std::size_t size) {
  std::visit([&](auto xyz) { fetch_lines(&xyz[3 * first], 3 * size * sizeof(xyz[0]) / kCacheLine + 1); },
             index.positions);
}

}  // namespace meshhood
