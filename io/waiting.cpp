// SPDX-License-Identifier: MIT
#include "io/waiting.h"

#include <utility>

namespace meshhood::inline v0_1::io {
namespace {

thread_local const std::function<void()>* current = nullptr;

}  // namespace

WhileWaiting::WhileWaiting(std::function<void()> f) : f_(std::move(f)), outer_(std::exchange(current, &f_)) {}
WhileWaiting::~WhileWaiting() { current = outer_; }

void report_wait() {
  if (current != nullptr) (*current)();
}

bool wait_for(const Descriptor& file, Ready ready, std::chrono::steady_clock::duration limit) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  while (!becomes_ready(file, ready, kPollInterval)) {
    report_wait();
    if (Clock::now() - start >= limit) return false;
  }
  return true;
}

}  // namespace meshhood::inline v0_1::io
