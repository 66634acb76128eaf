// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <limits>
#include <new>
#include <ostream>

#include <gtest/gtest.h>

#include "meshhood/error.h"

/// Repeats a call, each time with another allocation failing. For that, every `operator new` of the program is
/// replaced: it counts the calls, and lets some fail. The operators call `malloc` and `free`, so that sanitizers still
/// see all allocations.
namespace meshhood::test {

enum class Shortage {
  Once,         ///< one allocation fails, later ones succeed
  FromThereOn,  ///< one fails, and all later ones
};

/// During its lifetime, allocation number `at` fails, counted from 0 over all threads. At most one object at a time.
class FailingAllocations {
 public:
  FailingAllocations(std::size_t at, Shortage shortage);
  ~FailingAllocations();
  FailingAllocations(const FailingAllocations&) = delete;
  FailingAllocations& operator=(const FailingAllocations&) = delete;

  /// Whether the allocation number was reached.
  [[nodiscard]] bool happened() const;

 private:
  std::size_t at_;
};

/// Blocks that were allocated and not yet freed.
[[nodiscard]] std::size_t blocks_in_use();

enum class Ending { Well, OutOfMemory };

/// Runs `call()` and returns how it ended. Other exceptions are passed on.
template <class Call>
[[nodiscard]] Ending ending_of(Call&& call) {
  try {
    call();
  } catch (const std::bad_alloc&) {
    return Ending::OutOfMemory;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::TooLarge) throw;
    return Ending::OutOfMemory;
  }
  return Ending::Well;
}

/// Resources that must not leak: memory and open files.
struct InUse {
  std::size_t blocks;
  std::ptrdiff_t files;

  friend bool operator==(const InUse&, const InUse&) = default;
  friend void PrintTo(const InUse& in_use, std::ostream* out) {
    *out << in_use.blocks << " blocks, " << in_use.files << " files";
  }
};

[[nodiscard]] inline InUse in_use() {
  const auto files = std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {});
  return {blocks_in_use(), files};
}

/// Counts, which the test prints at the end.
class Shortages {
 public:
  ~Shortages() {
    EXPECT_GT(failures_, 0U);
    std::printf("%zu allocations failed; %zu of the calls succeeded without the memory\n", failures_, did_without_);
  }
  Shortages() = default;
  Shortages(const Shortages&) = delete;
  Shortages& operator=(const Shortages&) = delete;

  /// From now on, fails only every `step`-th allocation.
  void skip_to_every(std::size_t step) { step_ = step; }

  /// Lets each allocation of `call(scene)` fail, alone and together with all later ones, on a new scene from
  /// `prepare()` each time. `judge(scene, ending)` then checks the scene; the first time, nothing has failed. When the
  /// scene is destroyed, no memory block and no open file may be left.
  template <class Prepare, class Call, class Judge>
  void fail_each(Prepare&& prepare, Call&& call, Judge&& judge);

 private:
  std::size_t step_ = 1;
  std::size_t failures_ = 0;
  std::size_t did_without_ = 0;  // as a sort without a buffer, or a build without a second thread
};

template <class Prepare, class Call, class Judge>
void Shortages::fail_each(Prepare&& prepare, Call&& call, Judge&& judge) {
  if (testing::Test::HasFailure()) return;
  // Returns whether an allocation has failed.
  const auto attempt = [&](std::size_t at, Shortage shortage) {
    auto scene = prepare();
    Ending ending = Ending::Well;
    bool happened = false;
    {
      const FailingAllocations failing(at, shortage);
      ending = ending_of([&] { call(scene); });
      happened = failing.happened();
    }
    failures_ += static_cast<std::size_t>(happened);
    did_without_ += static_cast<std::size_t>(happened && ending == Ending::Well);
    judge(scene, ending);
    return happened;
  };
  constexpr std::size_t kBeyondAll = std::numeric_limits<std::size_t>::max();
  ASSERT_FALSE(attempt(kBeyondAll, Shortage::Once));  // also creates what is created once and kept
  for (const Shortage shortage : {Shortage::Once, Shortage::FromThereOn}) {
    bool happened = true;
    for (std::size_t at = 0; happened; at += step_) {
      const InUse before = in_use();
      happened = attempt(at, shortage);
      ASSERT_FALSE(testing::Test::HasFailure()) << "when allocation " << at << " had failed";
      ASSERT_EQ(in_use(), before) << "left behind after allocation " << at << " had failed";
    }
  }
}

}  // namespace meshhood::test
