// SPDX-License-Identifier: MIT
#include "interpreter.h"

#include <chrono>
#include <cstddef>
#include <thread>

namespace nb = nanobind;

namespace meshhood::python {
namespace {

/// False if Python has raised an exception.
bool call(nb::handle callable, std::size_t done, std::size_t total) {
  if (PyErr_CheckSignals() != 0) return false;
  if (callable.is_none()) return true;
  // Without objects of nanobind, whose destructors must not run while the stack is unwound without the lock.
  PyObject* const result =
      PyObject_CallFunction(callable.ptr(), "nn", static_cast<Py_ssize_t>(done), static_cast<Py_ssize_t>(total));
  Py_XDECREF(result);
  return result != nullptr;
}

}  // namespace

void sleep_until_exit() noexcept {
  for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

Progress progress_to(nb::handle callable) {
  return [callable, state = PyThreadState_Get()](std::size_t done, std::size_t total) {
    const Locked locked(state);
    if (!stop_at_shutdown([&] { return call(callable, done, total); })) throw nb::python_error();
    return true;
  };
}

}  // namespace meshhood::python
