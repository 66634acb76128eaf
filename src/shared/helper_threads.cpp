// SPDX-License-Identifier: MIT
#include "shared/helper_threads.h"

#include <cstdlib>
#include <exception>
#include <limits>
#include <span>

#if defined(__STDCPP_THREADS__) && !defined(_WIN32)
#include <unistd.h>
#endif
#if defined(__STDCPP_THREADS__) && defined(__linux__) && !defined(__ANDROID__)
#define MESHHOOD_PLACES_THREADS
#include <pthread.h>
#include <sched.h>
#endif

#include "shared/failure.h"

namespace meshhood {

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

namespace {

// About 500 microseconds, longer than most of what one thread does between the loops of a small mesh. Other threads
// have the processor meanwhile if they need it.
constexpr int kLooksBeforeSleep = 2000;

/// Looks for a while whether `happened()`.
template <class F>
void look(F&& happened) {
  for (int i = 0; i < kLooksBeforeSleep && !happened(); ++i) std::this_thread::yield();
}

/// Linux may start or wake a thread on the processor of its creator, which leaves it only after milliseconds: longer
/// than all neighborhoods of a small mesh take. So the threads that were `started` use only the other processors, if
/// there is one for each of the `helpers`.
void keep_off_this_processor([[maybe_unused]] std::span<std::thread> started, [[maybe_unused]] std::size_t helpers) {
#if defined(MESHHOOD_PLACES_THREADS)
  cpu_set_t others;
  const int processor = sched_getcpu();
  if (processor < 0 || pthread_getaffinity_np(pthread_self(), sizeof(others), &others) != 0) return;
  CPU_CLR(static_cast<std::size_t>(processor), &others);
  if (static_cast<std::size_t>(CPU_COUNT(&others)) < helpers) return;
  for (std::thread& thread : started) {
    static_cast<void>(pthread_setaffinity_np(thread.native_handle(), sizeof(others), &others));
  }
#endif
}

long this_process() {
#if defined(_WIN32)
  return 0;  // cannot be forked
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
  lock.unlock();
  const auto all_ended = [this] { return at_work_.load(std::memory_order_acquire) == 0; };
  look(all_ended);
  lock.lock();
  ended_.wait(lock, all_ended);
}

bool HelperThreads::are_lost() const { return !threads_.empty() && process_ != this_process(); }

/// So that there are `count`, or as many as the system can create.
void HelperThreads::start(std::size_t count) {
  const std::size_t before = threads_.size();
  if (before >= count) return;
  if (before == 0) process_ = this_process();
  Failure ignored;
  static_cast<void>(ignored.guard([&] {
    while (threads_.size() < count) {
      const auto thread = static_cast<unsigned>(threads_.size() + 1);
      threads_.emplace_back([this, thread, seen = orders_.load()] {
        // Without memory it has no part in any loop, but it ends with the others: to set the processors of a thread
        // that has ended would set those of the caller.
        help(prepare_exceptions() ? thread : std::numeric_limits<unsigned>::max(), seen);
      });
    }
  }));
  keep_off_this_processor(std::span(threads_).subspan(before), threads_.size());
}

void HelperThreads::give(Order order, std::size_t most, const std::function<void(unsigned)>* body) {
  {
    const std::lock_guard lock(mutex_);
    order_ = order;
    most_ = most;
    body_ = body;
    orders_.fetch_add(1, std::memory_order_release);
  }
  given_.notify_all();
}

void HelperThreads::help(unsigned thread, std::size_t seen) {
  const auto is_new = [&] { return orders_.load(std::memory_order_acquire) != seen; };
  for (;;) {
    look(is_new);
    std::unique_lock lock(mutex_);
    given_.wait(lock, is_new);
    seen = orders_.load(std::memory_order_relaxed);
    if (order_ == Order::End) return;
    if (order_ == Order::Wait || thread > most_) continue;
    at_work_.fetch_add(1, std::memory_order_relaxed);
    const std::function<void(unsigned)>& body = *body_;
    lock.unlock();
    body(thread);
    lock.lock();
    at_work_.fetch_sub(1, std::memory_order_release);
    if (at_work_.load(std::memory_order_relaxed) == 0) ended_.notify_one();
  }
}

#endif

}  // namespace meshhood
