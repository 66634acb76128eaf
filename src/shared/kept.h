// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <memory>
#include <utility>

namespace meshhood::inline v0_1 {

/// Holds a value that is made at its first use, and kept. Any thread may ask for it. There is no lock, because a fork
/// could leave it held: if several threads make it at once, one result is kept.
template <class T>
class Kept {
 public:
  Kept() = default;
  Kept(const Kept&) = delete;
  Kept& operator=(const Kept&) = delete;
  ~Kept() { delete made(); }

  template <class Make>
  const T& get(Make&& make) {
    if (const T* const found = made()) return *found;
    auto value = std::make_unique<T>(std::forward<Make>(make)());
    T* found = nullptr;
    if (!value_.compare_exchange_strong(found, value.get(), std::memory_order_acq_rel)) return *found;
    return *value.release();
  }

  /// Returns the value, or null if it has not been made. It may be changed while no other thread uses it.
  [[nodiscard]] T* made() const { return value_.load(std::memory_order_acquire); }

  /// Deletes the value, which no other thread may use meanwhile.
  void drop() { delete value_.exchange(nullptr, std::memory_order_acq_rel); }

 private:
  std::atomic<T*> value_{nullptr};
};

}  // namespace meshhood::inline v0_1
