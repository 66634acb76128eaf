// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>

#if defined(__STDCPP_THREADS__)
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>
#endif

#include "meshhood/export.h"

namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

/// Lets the C++ runtime allocate what it needs on this thread to handle exceptions. It would do so at the first
/// exception; if memory has run out by then, glibc ends the process, where the runtime was loaded by the program while
/// it ran, as Python does. Returns false if memory is that short already.
bool prepare_exceptions();

/// Keeps the first exception of several threads. Without exceptions, nothing fails.
class Failure {
 public:
  /// Calls `f`, and returns false if it threw.
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

  /// To be called when all threads have stopped.
  void pass_on() const {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  std::atomic_flag happened_;
  std::exception_ptr exception_;
};

#if defined(__STDCPP_THREADS__)

/// The threads that take part in the loops of a task, beside the one that it belongs to. They start once, and sleep
/// between the loops.
class HelperThreads {
 public:
  HelperThreads() = default;
  HelperThreads(const HelperThreads&) = delete;
  HelperThreads& operator=(const HelperThreads&) = delete;

  ~HelperThreads();

  /// Calls `body(0)` on this thread, and `body(1)`, `body(2)` ... `body(most)` on others, but only on those that are
  /// ready before `body(0)` ends: there are fewer also if the system cannot create them, or if they have no memory at
  /// their start. Returns when all have ended. `body` must not throw.
  void run(std::size_t most, const std::function<void(unsigned)>& body);

  /// Returns whether this process was forked since the threads were started. They belong to the parent then: this
  /// object can neither be used nor destroyed.
  [[nodiscard]] bool are_lost() const;

 private:
  enum class Order { Wait, Help, End };

  void start(std::size_t count);
  void give(Order order, std::size_t most, const std::function<void(unsigned)>* body);
  void help(unsigned thread, std::size_t seen);

  std::mutex mutex_;  // for what follows, up to `at_work_`
  std::condition_variable given_;
  std::condition_variable ended_;
  Order order_ = Order::Wait;
  std::size_t most_ = 0;
  const std::function<void(unsigned)>* body_ = nullptr;
  std::size_t orders_ = 0;  // how many were given
  std::size_t at_work_ = 0;
  std::vector<std::thread> threads_;
  long process_ = 0;  // that the threads were started in
};

#else

class HelperThreads {
 public:
  void run(std::size_t /*most*/, const std::function<void(unsigned)>& body) { body(0); }
  [[nodiscard]] bool are_lost() const { return false; }
};

#endif

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
