// SPDX-License-Identifier: MIT
#pragma once

#include <cerrno>

namespace meshhood::io {

/// Makes the system call `call()`, again if a signal interrupted it, and returns its result.
template <class F>
[[nodiscard]] auto uninterrupted(F&& call) {
  for (;;) {
    const auto result = call();
    if (result >= 0 || errno != EINTR) return result;
  }
}

}  // namespace meshhood::io
