// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>

namespace meshhood {

/// Callback of a long call: `done` of `total` equal parts are complete. Return false to cancel. The call then throws
/// Error{Cancelled} and leaves its arguments unchanged.
///
/// It is called on the calling thread only, with 0 at the beginning and `total` at the end. `done` never decreases and
/// `total` is constant. An exception from it ends the call and is passed on. If it forks the process while the call has
/// threads, which stay with the parent, the call throws Error{Cancelled} in the child. Values that the threads were
/// changing are undefined there, so the child should soon call `_exit` or `exec`.
using Progress = std::function<bool(std::size_t done, std::size_t total)>;

/// The largest number of threads that a call accepts.
inline constexpr unsigned kMaxThreads = 1024;

}  // namespace meshhood
