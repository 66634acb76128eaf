// SPDX-License-Identifier: MIT
// A disk that is full after any number of pages: row F10 of the catalogue.
#include <csignal>
#include <cstdint>
#include <cstdio>

#include <gmock/gmock.h>
#include <sys/resource.h>

#include "meshhood/error.h"

#include "support/save_trial.h"
#include "support/small_disk.h"

namespace meshhood::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class SaveToFullDisk : public SaveTrial {
 protected:
  /// Saves the new version over the old with room for none of its pages, for one, and so on. `limit(n)` leaves room for
  /// `n`, `lift()` for any number.
  template <class Limit, class Lift>
  void fill_up_at_every_page(const std::string& reason, Limit&& limit, Lift&& lift) {
    const std::uint64_t pages = (content(Version::New).size() + SmallDisk::kPage - 1) / SmallDisk::kPage;
    for (std::uint64_t room = 0; room <= pages; ++room) {
      SCOPED_TRACE(room);
      lift();
      restore(Version::Old);
      limit(room);
      const std::string message = save_new();
      lift();
      if (room < pages) {
        EXPECT_THAT(message, AllOf(HasSubstr(file.string()), HasSubstr(reason)));
        EXPECT_EQ(held(), Version::Old);
      } else {
        EXPECT_EQ(message, "");
        EXPECT_EQ(held(), Version::New);
      }
      EXPECT_EQ(remove_leftovers(), 0U);
    }
    std::printf("full after 0 to %ju pages: the old file; after %ju the new\n", std::uintmax_t{pages - 1},
                std::uintmax_t{pages});
  }

 private:
  [[nodiscard]] std::string save_new() const {
    try {
      save(Version::New);
      return {};
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::IoFailure);
      return error.what();
    }
  }
};

TEST_P(SaveToFullDisk, LeavesTheOldFileAtEveryPage) {
  const auto disk = SmallDisk::mount(file.parent_path());
  if (disk == nullptr) GTEST_SKIP() << "no tmpfs may be mounted here";
  constexpr std::uint64_t kPlenty = 4096;
  fill_up_at_every_page(
      "No space left on device", [&](std::uint64_t room) { disk->leave_free(room); },
      [&] { disk->leave_free(kPlenty); });
}

// The same wherever there is no such disk: what a file may not exceed.
TEST_P(SaveToFullDisk, LeavesTheOldFileAtEveryLimitOfItsSize) {
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before = {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto set = [&](rlim_t bytes) {
    const rlimit limit = {bytes, before.rlim_max};
    EXPECT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
  };
  fill_up_at_every_page(
      "File too large", [&](std::uint64_t room) { set(room * SmallDisk::kPage); }, [&] { set(before.rlim_cur); });
}

MESHHOOD_TRY_ALL_SAVERS(SaveToFullDisk);

}  // namespace
}  // namespace meshhood::test
