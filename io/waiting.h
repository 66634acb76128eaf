// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>

#include "io/system.h"

namespace meshhood::inline v0_1::io {

/// While it lives, files of this thread that wait for another process call `f` about ten times a second, and whenever a
/// signal interrupts them: while a pipe has no partner, while there is nothing to read, and while there is no room to
/// write. What `f` throws ends the wait. One object within another replaces it meanwhile. On Windows, reading and
/// writing wait without calling it.
class WhileWaiting {
 public:
  explicit WhileWaiting(std::function<void()> f);
  WhileWaiting(const WhileWaiting&) = delete;
  WhileWaiting& operator=(const WhileWaiting&) = delete;
  ~WhileWaiting();

 private:
  std::function<void()> f_;
  const std::function<void()>* outer_;
};

/// Calls the function of this thread, if there is one.
void report_wait();

/// Waits until `file` is ready. Returns false after `limit`.
bool wait_for(const Descriptor& file, Ready ready, std::chrono::steady_clock::duration limit);

inline constexpr auto kPollInterval = std::chrono::milliseconds(100);
inline constexpr auto kNoTimeout = std::chrono::steady_clock::duration::max();

/// How long to wait for another process to open a named pipe at its other end.
inline constexpr auto kPartnerTimeout = std::chrono::seconds(2);

}  // namespace meshhood::inline v0_1::io
