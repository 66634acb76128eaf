// SPDX-License-Identifier: MIT
#pragma once

#include <nanobind/nanobind.h>

#include "meshhood/progress.h"

namespace meshhood::python {

/// Looks for Ctrl-C, and tells `callable(done, total)` unless it is None, each time that a long call reports. What they
/// raise ends the call. Called without the interpreter lock; `callable` must outlive the result.
[[nodiscard]] Progress watch(nanobind::handle callable);

}  // namespace meshhood::python
