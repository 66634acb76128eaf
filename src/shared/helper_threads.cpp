// SPDX-License-Identifier: MIT
#include "shared/helper_threads.h"

#include <cstdlib>
#include <exception>

#if defined(__STDCPP_THREADS__) && !defined(_WIN32)
#include <unistd.h>
#endif

namespace meshhood::inline v0_1 {

bool prepare_exceptions() {
#if defined(__cpp_exceptions)
  constexpr std::size_t kMoreThanEnough = 4096;
  void* const volatile trial = std::malloc(kMoreThanEnough);  // without volatile, compilers omit it
  if (trial == nullptr) return false;
  std::free(trial);
  static_cast<void>(std::current_exception());
#endif
  return true;
}

#if defined(__STDCPP_THREADS__)

namespace {

long this_process() {
#if defined(_WIN32)
  return 0;  // it cannot be forked
#else
  return long{getpid()};
#endif
}

}  // namespace

HelperThreads::~HelperThreads() {
  give(Order::End, 0, nullptr);
  for (std::thread& thread : threads_) thread.join();
}

void HelperThreads::run(std::size_t most, const std::function<void(unsigned)>& body) {
  start(most);
  give(Order::Help, most, &body);
  body(0);
  if (are_lost()) return;
  std::unique_lock lock(mutex_);
  order_ = Order::Wait;  // no thread begins any more
  ended_.wait(lock, [this] { return at_work_ == 0; });
}

bool HelperThreads::are_lost() const { return !threads_.empty() && process_ != this_process(); }

/// Starts threads until there are `count`, or as many as the system can create.
void HelperThreads::start(std::size_t count) {
  if (threads_.empty()) process_ = this_process();
  Failure ignored;
  static_cast<void>(ignored.guard([&] {
    while (threads_.size() < count) {
      const auto thread = static_cast<unsigned>(threads_.size() + 1);
      threads_.emplace_back([this, thread, seen = orders_] {
        if (prepare_exceptions()) help(thread, seen);
      });
    }
  }));
}

void HelperThreads::give(Order order, std::size_t most, const std::function<void(unsigned)>* body) {
  {
    const std::lock_guard lock(mutex_);
    order_ = order;
    most_ = most;
    body_ = body;
    ++orders_;
  }
  given_.notify_all();
}

void HelperThreads::help(unsigned thread, std::size_t seen) {
  std::unique_lock lock(mutex_);
  for (;;) {
    given_.wait(lock, [&] { return orders_ != seen; });
    seen = orders_;
    if (order_ == Order::End) return;
    if (order_ == Order::Wait || thread > most_) continue;
    const std::function<void(unsigned)>& body = *body_;
    ++at_work_;
    lock.unlock();
    body(thread);
    lock.lock();
    if (--at_work_ == 0) ended_.notify_one();
  }
}

#endif

}  // namespace meshhood::inline v0_1
