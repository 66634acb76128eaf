// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace meshhood::python {

/// Objects that one thread at a time may use, kept for whoever comes next.
template <class T>
class Pool {
 public:
  /// Calls `f` with an object that is free, or with `make()` where none is. Where `f` throws, the object is dropped.
  template <class Make, class F>
  auto with(Make&& make, F&& f) {
    std::unique_ptr<T> object = take();
    if (!object) object = std::make_unique<T>(make());
    auto result = f(*object);
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(object));
    return result;
  }

 private:
  std::unique_ptr<T> take() {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) return nullptr;
    std::unique_ptr<T> object = std::move(free_.back());
    free_.pop_back();
    return object;
  }

  std::mutex mutex_;
  std::vector<std::unique_ptr<T>> free_;
};

}  // namespace meshhood::python
