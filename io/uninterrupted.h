// SPDX-License-Identifier: MIT
#pragma once

#include <cerrno>

namespace meshhood::io {

/// What `call()` returns, a call of the operating system that is made again where a signal cut it short.
template <class F>
[[nodiscard]] auto uninterrupted(F&& call) {
  for (;;) {
    const auto result = call();
    if (result >= 0 || errno != EINTR) return result;
  }
}

}  // namespace meshhood::io
