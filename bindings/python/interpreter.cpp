// SPDX-License-Identifier: MIT
#include "watch.h"

namespace nb = nanobind;

namespace meshhood::python {

Progress watch(nb::handle callable) {
  return [callable](std::size_t done, std::size_t total) {
    const nb::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    if (!callable.is_none()) callable(done, total);
    return true;
  };
}

}  // namespace meshhood::python
