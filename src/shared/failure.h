// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <exception>

namespace meshhood {

/// Keeps the first exception of several threads. Without exceptions, nothing fails.
class Failure {
 public:
  /// Calls `f`; false if it threw.
  template <class F>
  bool guard(F&& f) {
#if defined(__cpp_exceptions)
    try {
      f();
    } catch (...) {
      if (!happened_.test_and_set()) exception_ = std::current_exception();
      return false;
    }
#else
    f();
#endif
    return true;
  }

  /// Called when all threads have stopped.
  void pass_on() const {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  std::atomic_flag happened_;
  std::exception_ptr exception_;
};

}  // namespace meshhood
