// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <variant>
#include <vector>

#include "meshhood/index.h"

#include "exact/arrays.h"
#include "exact/index_access.h"

namespace meshhood::test {

template <class T>
void copy_array(std::vector<T>& to, std::span<const T> from) {
  to.assign(from.begin(), from.end());
}

inline void copy_array(PositionsData& to, const PositionsInOrder& from) {
  std::visit([&]<class Real>(std::span<const Real> xyz) { to = std::vector<Real>(xyz.begin(), xyz.end()); }, from);
}

/// A copy of the arrays of `index`, for tests that damage them.
[[nodiscard]] inline IndexData arrays_of(const Index& index) {
  const IndexView& from = IndexAccess::view(index);
  IndexData to;
  to.frame = from.frame;
  for_each_array([](ArrayInfo, auto& copy, const auto& array) { copy_array(copy, array); }, to, from);
  return to;
}

}  // namespace meshhood::test
