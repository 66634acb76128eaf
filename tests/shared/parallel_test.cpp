// SPDX-License-Identifier: MIT
#include "shared/parallel.h"

#include <array>
#include <atomic>
#include <chrono>
#include <new>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "meshhood/error.h"

#include "support/refusal.h"

namespace meshhood::test {
namespace {

constexpr std::array kThreads{1U, 2U, 3U, 8U};
const Progress kNoProgress;

TEST(ParallelFor, ChunksCoverAllNumbersAndDoNotDependOnTheThreads) {
  for (const unsigned threads : kThreads) {
    for (const std::size_t count : {0U, 1U, 9U, 10U, 11U, 1000U}) {
      TaskContext task(threads, kNoProgress, 0);
      std::vector<std::atomic<int>> visits(count);
      task.parallel_for(count, 10, [&](unsigned thread, std::size_t begin, std::size_t end) {
        EXPECT_LT(thread, threads);
        EXPECT_EQ(begin % 10, 0U);
        EXPECT_EQ(end, std::min(begin + 10, count));
        for (std::size_t i = begin; i < end; ++i) ++visits[i];
      });
      EXPECT_THAT(visits, testing::Each(testing::ResultOf([](const auto& n) { return n.load(); }, 1)));
    }
  }
}

TEST(ParallelFor, AThreadBeginsWithItsShareAndThenTakesWhatIsLeftOfOthers) {
  constexpr std::size_t kChunks = 100;
  for (const unsigned threads : kThreads) {
    TaskContext task(threads, kNoProgress, 0);
    std::vector<std::vector<std::size_t>> chunks(threads);  // by thread
    std::atomic<unsigned> begun{0};
    std::atomic<std::size_t> done{0};
    const auto end_of_patience = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    const auto wait_until = [&](auto&& happened) {
      while (!happened() && std::chrono::steady_clock::now() < end_of_patience) std::this_thread::yield();
    };
    task.parallel_for(kChunks, 1, [&](unsigned thread, std::size_t chunk, std::size_t) {
      if (chunks[thread].empty()) {
        ++begun;
        wait_until([&] { return begun == threads; });
      }
      chunks[thread].push_back(chunk);
      if (thread == 0 && threads > 1) wait_until([&] { return done == kChunks - 1; });  // the others do its share
      ++done;
    });
    std::size_t end_of_share = 0;
    for (unsigned thread = 0; thread < threads; ++thread) {
      ASSERT_FALSE(chunks[thread].empty()) << thread;
      EXPECT_EQ(chunks[thread].front(), end_of_share);
      end_of_share += kChunks / threads + (thread < kChunks % threads ? 1 : 0);
    }
    EXPECT_EQ(chunks[0].size(), threads > 1 ? 1U : kChunks);
    EXPECT_EQ(done, kChunks);
  }
}

TEST(ParallelFor, PassesOnOneExceptionOfMany) {
  for (const unsigned threads : kThreads) {
    TaskContext task(threads, kNoProgress, 0);
    EXPECT_THROW(task.parallel_for(1000, 1, [](unsigned, std::size_t, std::size_t) { throw std::bad_alloc(); }),
                 std::bad_alloc);
  }
}

TEST(ParallelFor, BeginsNoChunkAfterAnException) {
  for (const unsigned threads : kThreads) {
    TaskContext task(threads, kNoProgress, 0);
    std::atomic<std::size_t> after{0};
    std::atomic<bool> thrown{false};
    EXPECT_THROW(task.parallel_for(100000, 1,
                                   [&](unsigned, std::size_t begin, std::size_t) {
                                     if (thrown) ++after;
                                     if (begin != 5) return;
                                     thrown = true;
                                     throw std::runtime_error("five");
                                   }),
                 std::runtime_error);
    EXPECT_LT(after, 90000U);
  }
}

TEST(TaskContext, UsesAsManyThreadsAsTheProcessorHas) {
  EXPECT_GE(TaskContext(0, kNoProgress, 0).threads(), 1U);
  EXPECT_EQ(TaskContext(kMaxThreads, kNoProgress, 0).threads(), kMaxThreads);
  expect_refused(ErrorCode::InvalidOption, "threads is 1025", [] { const TaskContext task(1025, kNoProgress, 0); });
}

TEST(TaskContext, ReportsFinishedParts) {
  std::vector<std::pair<std::size_t, std::size_t>> reports;
  const Progress progress = [&](std::size_t done, std::size_t total) {
    reports.emplace_back(done, total);
    return reports.size() < 3;
  };
  TaskContext task(1, progress, 7);
  task.advance(4);
  task.report_progress();
  expect_refused(ErrorCode::Cancelled, "cancelled", [&] { task.report_progress(); });
  EXPECT_THAT(reports, testing::ElementsAre(std::pair(0, 7), std::pair(4, 7), std::pair(4, 7)));
}

TEST(TaskContext, AddsUpWhatTheThreadsHaveDone) {
  for (const unsigned threads : kThreads) {
    std::pair<std::size_t, std::size_t> last;
    const Progress progress = [&](std::size_t done, std::size_t total) {
      last = {done, total};
      return true;
    };
    TaskContext task(threads, progress, 300);
    for (std::size_t loop = 1; loop <= 2; ++loop) {
      task.parallel_for(100, 1, [&](unsigned thread, std::size_t, std::size_t) { task.advance(thread, 1); });
      task.step(7);
      EXPECT_EQ(last, std::pair(107 * loop, std::size_t{300}));
    }
    task.finish();
    EXPECT_EQ(last, std::pair(std::size_t{300}, std::size_t{300}));
  }
}

/// When a call forks the process.
enum class Fork { InProgressOfALoop, InProgressBetweenLoops, BetweenLoops };

/// Whether a call of three threads, which forks once, is cancelled. Sets `child`.
bool is_cancelled_by_fork(Fork when, pid_t& child) {
  constexpr unsigned kSeconds = 60;
  const auto fork_once = [&] {
    child = fork();
    if (child == 0) alarm(kSeconds);  // so that a child that waits fails
  };
  const Progress forks = [&](std::size_t done, std::size_t) {
    if (done > 0) fork_once();
    return true;
  };
  try {
    TaskContext task(3, when == Fork::BetweenLoops ? kNoProgress : forks, 1);
    std::atomic<bool> has_forked{when != Fork::InProgressOfALoop};
    task.parallel_for(100, 1, [&](unsigned thread, std::size_t, std::size_t) {
      if (thread == 0 && !has_forked) {
        task.step();
        has_forked = true;
      }
      while (!has_forked) std::this_thread::yield();
    });
    if (when == Fork::InProgressBetweenLoops) task.step();
    if (when == Fork::BetweenLoops) fork_once();
    task.parallel_for(100, 1, [](unsigned, std::size_t, std::size_t) {});
    return false;
  } catch (const Error& error) {
    return error.code() == ErrorCode::Cancelled;
  }
}

TEST(ParallelFor, EndsInAChildThatIsForkedDuringTheCallAndGoesOnInTheParent) {
  for (const Fork when : {Fork::InProgressOfALoop, Fork::InProgressBetweenLoops, Fork::BetweenLoops}) {
    for (int round = 0; round < 20; ++round) {
      pid_t child = -1;
      const bool cancelled = is_cancelled_by_fork(when, child);
      if (child == 0) _exit(cancelled ? 0 : 1);
      ASSERT_GT(child, 0);
      EXPECT_FALSE(cancelled);
      int status = 0;
      ASSERT_EQ(waitpid(child, &status, 0), child);
      EXPECT_EQ(status, 0);
    }
  }
}

}  // namespace
}  // namespace meshhood::test
