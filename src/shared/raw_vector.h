// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace meshhood::inline v0_1 {

/// Leaves the memory of new elements as it is, which `std::allocator` would set to zero.
template <class T>
class RawAllocator : public std::allocator<T> {
 public:
  RawAllocator() = default;
  template <class U>
  RawAllocator(const RawAllocator<U>& other) noexcept : std::allocator<T>(other) {}

  template <class U>
  struct rebind {                   // NOLINT(readability-identifier-naming): the standard's, as the next
    using other = RawAllocator<U>;  // NOLINT(readability-identifier-naming)
  };

  template <class U>
  void construct(U* at) {
    static_assert(std::is_trivially_destructible_v<U>);
    ::new (static_cast<void*>(at)) U;
  }
  template <class U, class First, class... Rest>
  void construct(U* at, First&& first, Rest&&... rest) {
    std::construct_at(at, std::forward<First>(first), std::forward<Rest>(rest)...);
  }
};

/// A vector that leaves new elements unset: each must be written before it is read. If several threads write them, they
/// share the page faults, which take longer than the writing.
template <class T>
using RawVector = std::vector<T, RawAllocator<T>>;

/// Appends `count` elements that are not set.
template <class T>
std::span<T> add_raw(RawVector<T>& values, std::size_t count) {
  const std::size_t before = values.size();
  values.resize(before + count);
  return std::span(values).subspan(before);
}

}  // namespace meshhood::inline v0_1
