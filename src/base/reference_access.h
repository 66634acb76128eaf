// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "meshhood/reference.h"

namespace meshhood {

/// For tests that force what is rare.
struct ReferenceAccess {
  /// As if so many queries had been asked.
  static void set_query(ReferenceSearcher& searcher, std::uint32_t queries);
};

}  // namespace meshhood
