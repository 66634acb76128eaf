// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "meshhood/paper.h"

namespace meshhood::paper {

/// For tests of rare cases.
struct SearcherAccess {
  /// Continues as if there had been `queries` queries.
  static void set_query(Searcher& searcher, std::uint32_t queries) { searcher.query_ = queries; }
};

}  // namespace meshhood::paper
