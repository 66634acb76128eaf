// SPDX-License-Identifier: MIT
#include "progress.h"

#include <chrono>
#include <cstdio>
#include <mutex>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>

#include <fmt/format.h>
#include <unistd.h>

#include "output.h"

namespace meshhood::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kPatience = std::chrono::seconds(1);
constexpr auto kRefresh = std::chrono::milliseconds(200);
constexpr const char* kClearLine = "\r\x1b[K";

}  // namespace

Progress::Progress(std::string_view what) : what_(printable(what)) {
  if (isatty(STDERR_FILENO) == 0) return;
  watcher_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
}

Progress::~Progress() = default;

void Progress::watch(const std::stop_token& stop) {
  const auto start = Clock::now();
  std::unique_lock lock(mutex_);
  const auto wait = [&](auto time) {
    finished_.wait_for(lock, stop, time, [] { return false; });
    return !stop.stop_requested();
  };
  if (!wait(kPatience)) return;
  do {
    draw(std::chrono::duration<double>(Clock::now() - start).count());
  } while (wait(kRefresh));
  std::fputs(kClearLine, stderr);
}

void Progress::draw(double seconds) const {
  const double fraction = fraction_;
  const std::string done = fraction < 0 ? "" : fmt::format(" {:3.0f} %", 100 * fraction);
  fmt::print(stderr, "{}{}:{} {:.0f} s", kClearLine, what_, done, seconds);
  std::fflush(stderr);
}

}  // namespace meshhood::cli
