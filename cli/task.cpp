// SPDX-License-Identifier: MIT
#include "task.h"

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <mutex>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "meshhood/error.h"

#include "io/messages.h"
#include "system.h"

namespace meshhood::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kDelay = std::chrono::seconds(1);
constexpr auto kRefresh = std::chrono::milliseconds(200);
constexpr const char* kClearLine = "\r\x1b[K";

volatile std::sig_atomic_t caught = 0;

/// "42,000", with three significant digits.
std::string rounded_text(double number) {
  std::string text = fmt::format("{:.3g}", number);
  if (number < 999.5 || !std::isfinite(number)) return text;
  const double step = std::pow(10.0, std::floor(std::log10(number)) - 2);
  text = fmt::format("{:.0f}", std::round(number / step) * step);
  for (std::size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, ",");
  return text;
}

void remember([[maybe_unused]] int signal) {
  caught = 1;
#if defined(_WIN32)
  std::signal(signal, remember);  // which the system has reset
#endif
}

void replace_handlers(void (*expected)(int), void (*handler)(int)) {
  for (const int signal : ending_signals()) {
    // An ignored signal stays ignored: nohup and background jobs rely on it.
    const auto previous = std::signal(signal, handler);
    if (previous != expected) std::signal(signal, previous);
  }
}

}  // namespace

Task::Task(std::string_view description, Unit unit) : description_(io::printable_name(description)), unit_(unit) {
  replace_handlers(SIG_DFL, remember);
  if (!shows_messages_on_terminal()) return;
  display_ = std::thread([this] { show(); });
}

Task::~Task() {
  replace_handlers(remember, SIG_DFL);
  if (!display_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    is_finished_ = true;
  }
  finished_.notify_one();
  display_.join();
}

void Task::check_cancelled() {
  if (caught != 0) raise(ErrorCode::Cancelled, "cancelled");
}

Progress Task::progress(std::size_t pass, std::size_t passes) {
  return [this, pass, passes](std::size_t done, std::size_t total) {
    done_ = pass * total + done;
    total_ = passes * total;
    return caught == 0;
  };
}

void Task::show() {
  const auto start = Clock::now();
  std::unique_lock lock(mutex_);
  const auto finishes_within = [&](auto time) {
    return finished_.wait_for(lock, time, [this] { return is_finished_; });
  };
  if (finishes_within(kDelay)) return;
  do {
    draw(std::chrono::duration<double>(Clock::now() - start).count());
  } while (!finishes_within(kRefresh));
  std::fputs(kClearLine, stderr);
}

void Task::draw(double seconds) const {
  const auto done = static_cast<double>(done_);
  const auto total = static_cast<double>(total_);
  std::string line = fmt::format("{}:", description_);
  if (total > 0) line += fmt::format(" {:.0f} %,", 100 * done / total);
  line += fmt::format(" {:.0f} s", seconds);
  if (done > 0 && !unit_.name.empty())
    line += fmt::format(", {} {}/s", rounded_text(done / unit_.parts / seconds), unit_.name);
  if (done > 0 && total > 0) line += fmt::format(", {:.0f} s left", seconds * (total - done) / done);
  fmt::print(stderr, "{}{}", kClearLine, line);
  std::fflush(stderr);
}

}  // namespace meshhood::cli
