// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>

#include "meshhood/export.h"

namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

/// Callback of a long call: `done` of `total` equal parts are complete. Return false to cancel. The call then throws
/// Error{Cancelled}, with the promise of `Error`.
///
/// It is called on the calling thread only, with 0 at the beginning and `total` at the end, in batches at most twenty
/// times a second. `done` never decreases and `total` is constant. An exception from it ends the call and is passed on.
/// If it forks the process while the call has threads, which stay with the parent, the call throws Error{Cancelled} in
/// the child. Values that the threads were changing are undefined there, so the child should soon call `_exit` or
/// `exec`.
using Progress = std::function<bool(std::size_t done, std::size_t total)>;

/// One thread for each processor.
inline constexpr unsigned kAllProcessors = 0;

/// The largest number of threads that calls accept; those that always run on one, such as `save`, may accept more.
inline constexpr unsigned kMaxThreads = 1024;

/// How a long call runs: the last argument of each. The result does not depend on it.
struct Run {
  static constexpr std::uint64_t kUnlimited = (std::numeric_limits<std::uint64_t>::max)();

  /// The number of threads, the calling one included; at most `kMaxThreads`. 1 starts no thread. Fewer are used if the
  /// system cannot create them, and one where the platform has none, as WebAssembly. They end with the call.
  /// `kAllProcessors` is -1 in Python.
  unsigned threads = kAllProcessors;

  Progress progress = {};

  /// The most bytes of the result of `neighborhoods`, `aggregate`, `aggregate_size`, `k_nearest` and `discs`; no other
  /// call looks at it. A larger result is refused before memory is allocated for it; by `discs`, and by `neighborhoods`
  /// without an index, once the rows so far exceed it.
  std::uint64_t max_bytes = kUnlimited;
};

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
