// SPDX-License-Identifier: MIT
#include "shared/parallel.h"

#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#if defined(__STDCPP_THREADS__)
#include <thread>
#endif

#include "meshhood/error.h"

namespace meshhood {
namespace {

constexpr std::chrono::milliseconds kBetweenReports{50};
const Progress kNoProgress;

unsigned thread_count([[maybe_unused]] unsigned wanted) {
#if defined(__STDCPP_THREADS__)
  return wanted == 0 ? std::clamp(std::thread::hardware_concurrency(), 1U, kMaxThreads) : wanted;
#else
  return 1;
#endif
}

/// Keeps the first exception of several threads.
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

/// Lets the C++ runtime allocate what it needs on this thread to handle exceptions. It would do so at the first
/// exception; if memory has run out by then, glibc ends the process, where the runtime was loaded by the program while
/// it ran, as Python does. False if memory is that short already.
bool prepare_exceptions() {
#if defined(__cpp_exceptions)
  constexpr std::size_t kMoreThanEnough = 4096;
  void* const volatile trial = std::malloc(kMoreThanEnough);  // volatile: or compilers omit it
  if (trial == nullptr) return false;
  std::free(trial);
  static_cast<void>(std::current_exception());
#endif
  return true;
}

#if defined(__STDCPP_THREADS__)
/// Threads that are joined at the end of their scope.
class Helpers {
 public:
  /// Calls `body(1)`, `body(2)` ... on up to `count` threads; on fewer if the system cannot create them, or if they
  /// have no memory at their start.
  Helpers(std::size_t count, const std::function<void(unsigned)>& body) {
    Failure ignored;
    static_cast<void>(ignored.guard([&] {
      threads_.reserve(count);
      for (unsigned thread = 1; thread <= count; ++thread) {
        threads_.emplace_back([body, thread] {
          if (prepare_exceptions()) body(thread);
        });
      }
    }));
  }
  Helpers(const Helpers&) = delete;
  Helpers& operator=(const Helpers&) = delete;
  ~Helpers() {
    for (std::thread& thread : threads_) thread.join();
  }

 private:
  std::vector<std::thread> threads_;
};
#else
struct Helpers {
  Helpers(std::size_t /*count*/, const std::function<void(unsigned)>& /*body*/) {}
};
#endif

}  // namespace

TaskContext::TaskContext(unsigned threads, const Progress& progress, std::size_t total)
    : threads_(thread_count(threads)), progress_(&progress), total_(total) {
  if (threads > kMaxThreads) {
    raise(ErrorCode::InvalidOption,
          "threads is " + std::to_string(threads) + ", expected at most " + std::to_string(kMaxThreads));
  }
  static_cast<void>(prepare_exceptions());
  report_progress();
}

TaskContext::TaskContext() : threads_(1), progress_(&kNoProgress), total_(0) {}

void TaskContext::report_progress() {
  if (!*progress_) return;
  if (!(*progress_)(done_.load(std::memory_order_relaxed), total_)) raise(ErrorCode::Cancelled, "cancelled");
  next_report_ = std::chrono::steady_clock::now() + kBetweenReports;
}

void TaskContext::run(std::size_t threads, const std::function<void(unsigned)>& body) {
  threads = std::min<std::size_t>(threads, threads_);
  if (threads <= 1) {
    body(0);
    return;
  }
  Failure failure;
  const auto guarded = [&](unsigned thread) {
    if (!failure.guard([&] { body(thread); })) stopped_ = true;
  };
  {
    const Helpers helpers(threads - 1, guarded);
    guarded(0);
  }
  failure.pass_on();
}

}  // namespace meshhood
