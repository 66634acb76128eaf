// SPDX-License-Identifier: MIT
// A disk that is full after any number of pages, and a limit on the size of files: row F10 of the catalogue.
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <string>
#include <system_error>

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
  /// Saves the new version over the old one with space for 0, 1, 2, ... pages. `limit(n)` leaves space for `n` pages,
  /// `lift()` for any number.
  template <class Limit, class Lift>
  void fill_up_at_every_page(int reason, Limit&& limit, Lift&& lift) {
    const std::uint64_t pages = (content(Version::New).size() + SmallDisk::kPage - 1) / SmallDisk::kPage;
    for (std::uint64_t room = 0; room <= pages; ++room) {
      SCOPED_TRACE(room);
      lift();
      restore(Version::Old);
      limit(room);
      const std::string message = save_new(reason);
      lift();
      if (room < pages) {
        EXPECT_THAT(message, AllOf(HasSubstr(file.string()), HasSubstr(std::generic_category().message(reason))));
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
  [[nodiscard]] std::string save_new(int reason) const {
    try {
      save(Version::New);
      return {};
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::IoFailure);
      EXPECT_EQ(error.path(), file.string());
      EXPECT_EQ(error.error_number(), reason);
      return error.what();
    }
  }
};

TEST_P(SaveToFullDisk, LeavesTheOldFileAtEveryPage) {
  const auto disk = SmallDisk::mount(file.parent_path());
  if (disk == nullptr) GTEST_SKIP() << "no tmpfs may be mounted here";
  constexpr std::uint64_t kPlenty = 4096;
  fill_up_at_every_page(
      ENOSPC, [&](std::uint64_t room) { disk->leave_free(room); }, [&] { disk->leave_free(kPlenty); });
}

bool is_set(const sigset_t& signals) { return ::sigismember(&signals, SIGXFSZ) == 1; }

bool is_blocked() {
  sigset_t mask;
  ::pthread_sigmask(SIG_SETMASK, nullptr, &mask);
  return is_set(mask);
}

bool is_pending() {
  sigset_t pending;
  ::sigpending(&pending);
  return is_set(pending);
}

// With the default disposition, SIGXFSZ would end the process. The disposition and the signal mask of the caller are
// not changed.
TEST_P(SaveToFullDisk, LeavesTheOldFileAtEveryFileSizeLimit) {
  std::signal(SIGXFSZ, SIG_DFL);
  rlimit before = {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto set = [&](rlim_t bytes) {
    const rlimit limit = {bytes, before.rlim_max};
    EXPECT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
  };
  fill_up_at_every_page(
      EFBIG, [&](std::uint64_t room) { set(room * SmallDisk::kPage); }, [&] { set(before.rlim_cur); });
  EXPECT_FALSE(is_blocked());
  EXPECT_FALSE(is_pending());
  EXPECT_EQ(std::signal(SIGXFSZ, SIG_DFL), SIG_DFL);
}

TEST_P(SaveToFullDisk, LeavesAPendingSignalOfTheCaller) {
  sigset_t signal;
  ::sigemptyset(&signal);
  ::sigaddset(&signal, SIGXFSZ);
  ASSERT_EQ(::pthread_sigmask(SIG_BLOCK, &signal, nullptr), 0);
  ::raise(SIGXFSZ);
  save(Version::New);
  EXPECT_TRUE(is_blocked());
  EXPECT_TRUE(is_pending());
  int taken = 0;
  ::sigwait(&signal, &taken);
  ASSERT_EQ(::pthread_sigmask(SIG_UNBLOCK, &signal, nullptr), 0);
}

MESHHOOD_TRY_ALL_SAVERS(SaveToFullDisk);

}  // namespace
}  // namespace meshhood::test
