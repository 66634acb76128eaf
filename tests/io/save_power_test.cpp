// SPDX-License-Identifier: MIT
// The power fails after any system call of a save: row F11 of the catalogue. A model of the disk enumerates the
// possible contents, from the recorded calls and their data.
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "support/disk_model.h"
#include "support/save_trial.h"
#include "support/system_calls.h"

namespace meshhood::test {
namespace {

using Trace = std::vector<Effect>;

/// The number of possible contents of each kind.
struct Found {
  std::size_t before = 0;
  std::size_t after = 0;
  std::size_t torn = 0;  // or missing
};

Found& operator+=(Found& sum, const Found& found) {
  sum.before += found.before;
  sum.after += found.after;
  sum.torn += found.torn;
  return sum;
}

class PowerLoss : public SaveTrial {
 protected:
  Trace trace_of_a_save(Version before) {
    restore(before);
    const SystemCalls calls;
    save(Version::New);
    return calls.effects();
  }

  /// The possible contents of the file if the power fails after the first `count` calls.
  [[nodiscard]] Found lose_power(Version before, const Trace& trace, std::size_t count) const {
    DiskModel disk;
    if (before != Version::None) disk.put(file.string(), content(before));
    for (std::size_t i = 0; i < count; ++i) disk.apply(trace[i]);
    Found found;
    disk.for_each_survivor(file.string(), [&](const std::string* survivor) {
      const bool is_before = before == Version::None ? survivor == nullptr : survivor && *survivor == content(before);
      const bool is_after = survivor != nullptr && *survivor == content(Version::New);
      ++(is_before ? found.before : is_after ? found.after : found.torn);
    });
    return found;
  }

  [[nodiscard]] Found lose_power_anywhere(Version before, const Trace& trace) const {
    Found sum;
    for (std::size_t count = 0; count <= trace.size(); ++count) sum += lose_power(before, trace, count);
    return sum;
  }
};

std::ptrdiff_t find(const Trace& trace, Call call) {
  const auto found = std::find_if(trace.begin(), trace.end(), [=](const Effect& e) { return e.call == call; });
  return found - trace.begin();
}

/// The first sync is of the file, the last of its folder.
Trace without_sync_of_file(Trace trace) {
  trace.erase(trace.begin() + find(trace, Call::Sync));
  return trace;
}

Trace without_sync_of_folder(Trace trace) {
  const auto last = std::find_if(trace.rbegin(), trace.rend(), [](const Effect& e) { return e.call == Call::Sync; });
  trace.erase(std::next(last).base());
  return trace;
}

/// As if the file were synced after the rename.
Trace with_sync_after_rename(Trace trace) {
  const auto sync = trace.begin() + find(trace, Call::Sync);
  const auto close = sync + 1;
  const auto rename = trace.begin() + find(trace, Call::Rename);
  EXPECT_EQ(close->call, Call::Close);
  EXPECT_EQ(rename, close + 1);
  std::rotate(sync, rename, rename + 1);
  return trace;
}

TEST_P(PowerLoss, KeepsTheOldOrTheNewFile) {
  Found sum;
  std::size_t cuts = 0;
  for (const Version before : {Version::Old, Version::None}) {
    const Trace trace = trace_of_a_save(before);
    sum += lose_power_anywhere(before, trace);
    cuts += trace.size() + 1;
    const Found in_the_end = lose_power(before, trace, trace.size());
    EXPECT_EQ(in_the_end.before, 0U) << "saved, but not for good";
    EXPECT_EQ(in_the_end.after, 1U);
  }
  EXPECT_EQ(sum.torn, 0U);
  EXPECT_GT(sum.before, 0U);
  EXPECT_GT(sum.after, 0U);
  std::printf("power lost at %zu places: the old file in %zu states of the disk, the new in %zu, torn in %zu\n", cuts,
              sum.before, sum.after, sum.torn);
}

// A test of the model: it must detect these faults.
TEST_P(PowerLoss, TearsAFileThatIsNotSynced) {
  const Trace trace = trace_of_a_save(Version::Old);
  const Found unsynced = lose_power_anywhere(Version::Old, without_sync_of_file(trace));
  const Found late = lose_power_anywhere(Version::Old, with_sync_after_rename(trace));
  EXPECT_GT(unsynced.torn, 100U);
  EXPECT_GT(late.torn, 100U);
  std::printf("torn in %zu states of the disk without the sync, in %zu where it comes late\n", unsynced.torn,
              late.torn);
}

TEST_P(PowerLoss, MayLoseTheNewFileIfTheFolderIsNotSynced) {
  const Trace trace = without_sync_of_folder(trace_of_a_save(Version::Old));
  const Found in_the_end = lose_power(Version::Old, trace, trace.size());
  EXPECT_EQ(in_the_end.before, 1U);
  EXPECT_EQ(in_the_end.after, 1U);
  EXPECT_EQ(in_the_end.torn, 0U);
}

MESHHOOD_TRY_ALL_SAVERS(PowerLoss);

// One page is overwritten and one is appended.
TEST(DiskModel, EnumeratesTheStatesOfTwoPages) {
  const std::string old_page(DiskModel::kPage, 'o');
  const std::string new_page(DiskModel::kPage, 'n');
  const std::string zeros(DiskModel::kPage, '\0');
  DiskModel disk;
  disk.put("/folder/file", old_page);
  disk.apply({.call = Call::Open, .file = 3, .path = "/folder/file"});
  disk.apply({.call = Call::Write, .file = 3, .bytes = new_page + new_page});
  std::set<std::string> left;
  const auto note = [&](const std::string* content) { left.insert(*content); };
  disk.for_each_survivor("/folder/file", note);
  EXPECT_THAT(left, testing::UnorderedElementsAre(old_page, new_page, old_page + zeros, new_page + zeros,
                                                  old_page + new_page, new_page + new_page));
  disk.apply({.call = Call::Sync, .file = 3});
  left.clear();
  disk.for_each_survivor("/folder/file", note);
  EXPECT_THAT(left, testing::ElementsAre(new_page + new_page));
}

}  // namespace
}  // namespace meshhood::test
