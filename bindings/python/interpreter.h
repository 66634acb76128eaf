// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include <nanobind/nanobind.h>

#if defined(__GLIBCXX__)
#include <cxxabi.h>
#endif

#include "meshhood/progress.h"

/// The interpreter lock. Before version 3.14, Python ends a thread that takes the lock while the interpreter shuts
/// down: pthread_exit unwinds its stack, and the process aborts at the first noexcept function or `catch (...)`.
/// Therefore such a thread sleeps here until the process ends, as it does in Python 3.14.
namespace meshhood::python {

[[noreturn]] void sleep_until_exit() noexcept;

/// Calls `f`, which may run Python code.
template <class F>
auto stop_at_shutdown(F&& f) {
#if defined(__GLIBCXX__)
  try {
    return std::forward<F>(f)();
  } catch (abi::__forced_unwind&) {
    sleep_until_exit();
  }
#else
  return std::forward<F>(f)();
#endif
}

/// Releases the lock for its lifetime.
class Unlocked {
 public:
  Unlocked() : state_(PyEval_SaveThread()) {}
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;
  ~Unlocked() {
    stop_at_shutdown([this] { PyEval_RestoreThread(state_); });
  }

 private:
  PyThreadState* state_;
};

/// Calls `f` without the lock.
template <class F>
auto without_lock(F&& f) {
  const Unlocked unlocked;
  return std::forward<F>(f)();
}

/// Takes the lock for its lifetime, on a thread that has released it.
class Locked {
 public:
  Locked() : state_(stop_at_shutdown([] { return PyGILState_Ensure(); })) {}
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;
  ~Locked() { PyGILState_Release(state_); }

 private:
  PyGILState_STATE state_;
};

/// Calls `f` with the lock.
template <class F>
auto with_lock(F&& f) {
  const Locked locked;
  return stop_at_shutdown(std::forward<F>(f));
}

/// Handles signals such as Ctrl-C and calls `callable(done, total)`, unless it is None, each time a long call reports
/// progress. An exception from either ends the call. Called without the lock; `callable` must outlive the result.
[[nodiscard]] Progress progress_to(nanobind::handle callable);

}  // namespace meshhood::python
