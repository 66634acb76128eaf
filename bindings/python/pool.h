// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "interpreter.h"

namespace meshhood::python {

/// Reusable objects, each used by one thread at a time. The interpreter lock guards the pool: a mutex that another
/// thread holds during a fork would stay locked in the child for ever.
template <class T>
class Pool {
 public:
  /// Calls `f` with a free object, or with `make()` if there is none. Both run without the interpreter lock, which the
  /// caller holds. If `f` throws, the object is dropped.
  template <class Make, class F>
  auto with(Make&& make, F&& f) {
    std::unique_ptr<T> object = take();
    auto result = without_lock([&] {
      if (!object) object = std::make_unique<T>(make());
      return f(*object);
    });
    free_.push_back(std::move(object));
    return result;
  }

 private:
  std::unique_ptr<T> take() {
    if (free_.empty()) return nullptr;
    std::unique_ptr<T> object = std::move(free_.back());
    free_.pop_back();
    return object;
  }

  std::vector<std::unique_ptr<T>> free_;
};

}  // namespace meshhood::python
