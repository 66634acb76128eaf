// SPDX-License-Identifier: MIT
#include "shared/parallel.h"

#include <string>

#if defined(__STDCPP_THREADS__)
#include <thread>
#endif

#include "meshhood/error.h"

#include "shared/helper_threads.h"

namespace meshhood::inline v0_1 {
namespace {

constexpr std::chrono::milliseconds kBetweenReports{50};
const Progress kNoProgress;

unsigned thread_count([[maybe_unused]] unsigned wanted) {
#if defined(__STDCPP_THREADS__)
  return wanted == 0 ? std::clamp(std::thread::hardware_concurrency(), 1U, kMaxThreads) : wanted;
#else
  return 1;
#endif
}

}  // namespace

TaskContext::TaskContext(unsigned threads, const Progress& progress, std::size_t total)
    : threads_(thread_count(threads)), progress_(&progress), total_(total) {
  if (threads > kMaxThreads) {
    raise(ErrorCode::InvalidOption,
          "threads is " + std::to_string(threads) + ", expected at most " + std::to_string(kMaxThreads));
  }
  static_cast<void>(prepare_exceptions());
  report_progress();
}

TaskContext::TaskContext(unsigned threads) : TaskContext(threads, kNoProgress, 0) {}

TaskContext::TaskContext() : threads_(1), progress_(&kNoProgress), total_(0) {}

TaskContext::~TaskContext() {
  // In a child, the helpers are threads of the parent, and cannot be joined.
  if (!helpers_ || !helpers_->are_lost()) return;
  const HelperThreads* const left_alone = helpers_.release();
  static_cast<void>(left_alone);
}

void TaskContext::report_progress() {
  if (!*progress_) return;
  std::size_t done = done_;
  for (const Share& share : shares_) done += share.done.load(std::memory_order_relaxed);
  const bool goes_on = (*progress_)(done, total_);
  check_not_forked();
  if (!goes_on) raise(ErrorCode::Cancelled, "cancelled");
  next_report_ = std::chrono::steady_clock::now() + kBetweenReports;
}

void TaskContext::finish() {
  for (Share& share : shares_) share.done = 0;
  done_ = total_;
  report_progress();
}

void TaskContext::check_not_forked() const {
  if (!helpers_ || !helpers_->are_lost()) return;
  raise(ErrorCode::Cancelled, "cancelled in a child that was forked during the call; it goes on in the parent");
}

std::span<TaskContext::Share> TaskContext::divide(std::size_t chunks) {
  if (shares_.empty()) shares_ = std::vector<Share>(threads_);
  const std::size_t count = std::min<std::size_t>(chunks, threads_);
  for (std::size_t i = 0; i < count; ++i) {
    const auto begin = [&](std::size_t share) { return chunks / count * share + std::min(share, chunks % count); };
    shares_[i].next = begin(i);
    shares_[i].end = begin(i + 1);
  }
  return std::span(shares_).first(count);
}

void TaskContext::run(std::size_t threads, const std::function<void(unsigned)>& body) {
  check_not_forked();
  if (threads <= 1) {
    body(0);
    return;
  }
  Failure failure;
  const auto guarded = [&](unsigned thread) {
    if (!failure.guard([&] { body(thread); })) stopped_ = true;
  };
  if (!helpers_) helpers_ = std::make_unique<HelperThreads>();
  helpers_->run(threads - 1, guarded);
  check_not_forked();  // the parent's threads may have failed, and not said so
  failure.pass_on();
}

}  // namespace meshhood::inline v0_1
