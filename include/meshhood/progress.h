// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>

namespace meshhood {

/// Watches a long call: told how many of `total` equal parts are done, it returns false to stop. The call then throws
/// Error{Cancelled}, and leaves everything it was given as it was.
///
/// Called on the thread that makes the call and on no other, with 0 at the beginning and `total` at the end; `done`
/// never falls, `total` stays. What it throws ends the call too.
using Progress = std::function<bool(std::size_t done, std::size_t total)>;

/// The most threads that a call may be told to use.
inline constexpr unsigned kMaxThreads = 1024;

}  // namespace meshhood
