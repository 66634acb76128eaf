// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>

#include "meshhood/export.h"

namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN
namespace detail {

/// Throws Error{InvalidOption}.
[[noreturn]] void raise_moved_from();

/// Owns the state of an object that can be moved, but not copied. To use the state of one that has been moved from
/// throws Error{InvalidOption}; to assign and to destroy it does not.
template <class T>
class Owner {
 public:
  Owner() = default;
  Owner(std::unique_ptr<T> state) : state_(std::move(state)) {}
  Owner(std::shared_ptr<T> state) : state_(std::move(state)) {}
  Owner(Owner&&) noexcept = default;
  Owner& operator=(Owner&&) noexcept = default;
  Owner(const Owner&) = delete;
  Owner& operator=(const Owner&) = delete;
  ~Owner() = default;

  [[nodiscard]] T& operator*() const {
    if (!state_) raise_moved_from();
    return *state_;
  }
  [[nodiscard]] T* operator->() const { return &**this; }

  /// Returns the pointer by which others keep the state alive.
  [[nodiscard]] const std::shared_ptr<T>& share() const {
    static_cast<void>(**this);
    return state_;
  }

  [[nodiscard]] explicit operator bool() const { return state_ != nullptr; }

 private:
  std::shared_ptr<T> state_;  // shared, so that the type may be incomplete
};

}  // namespace detail
MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
