// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "meshhood/paper.h"

namespace meshhood::paper {

/// For tests that force what is rare.
struct SearcherAccess {
  /// As if so many queries had been asked.
  static void set_query(Searcher& searcher, std::uint32_t queries) { searcher.query_ = queries; }
};

}  // namespace meshhood::paper
