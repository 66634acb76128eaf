// SPDX-License-Identifier: MIT
#pragma once

namespace meshhood::cli {

/// Seconds of processor time that this thread has had. Unlike the time of day, it stands still while the machine runs
/// something else, which would hit the long runs of a slow method far more often than the short ones of a fast. A call
/// costs some 300 ns, too much for a single short query.
[[nodiscard]] double processor_time();

}  // namespace meshhood::cli
