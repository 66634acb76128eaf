// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include <nanobind/nanobind.h>

#if defined(__GLIBCXX__)
#include <cxxabi.h>
#endif

#include "meshhood/run.h"

/// The interpreter lock, also while the interpreter shuts down with a daemon thread in a call.
///
/// Before version 3.14, Python ends a thread that takes the lock then: pthread_exit unwinds its stack, and the process
/// aborts at the first noexcept function or `catch (...)`. Therefore such a thread sleeps here until the process ends,
/// as it does in Python 3.14.
///
/// A thread that has released the lock takes it only with the state that it had, by PyEval_RestoreThread. Python keeps
/// that safe even after the interpreter is freed, since threads return from a sleep or a read in this way: of a state
/// that may be freed, only the address is compared. PyGILState_Ensure has no such promise before version 3.14: it makes
/// a new state for a thread whose state is gone, in an interpreter that is gone.
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

/// Takes the lock for its lifetime, on a thread that has released it. `state` is what PyThreadState_Get returned on
/// this thread while it had the lock.
class Locked {
 public:
  explicit Locked(PyThreadState* state) {
    stop_at_shutdown([state] { PyEval_RestoreThread(state); });
  }
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;
  ~Locked() { PyEval_SaveThread(); }
};

/// Calls `f` with the lock.
template <class F>
auto with_lock(PyThreadState* state, F&& f) {
  const Locked locked(state);
  return stop_at_shutdown(std::forward<F>(f));
}

/// Handles signals such as Ctrl-C and calls `callable(done, total)`, unless it is None, each time a long call reports
/// progress. An exception from either ends the call. Made with the lock, by the thread that will report, and called
/// without it; `callable` must outlive the result.
[[nodiscard]] Progress progress_to(nanobind::handle callable);

}  // namespace meshhood::python
