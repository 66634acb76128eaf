// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "meshhood/reference.h"

namespace meshhood {

/// Lets tests bring a searcher into rare states.
struct ReferenceAccess {
  /// Continues as if there had been `queries` queries.
  static void set_query(ReferenceSearcher& searcher, std::uint32_t queries);
};

}  // namespace meshhood
