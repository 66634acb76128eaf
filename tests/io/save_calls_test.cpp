// SPDX-License-Identifier: MIT
// Each system call of a save fails, is interrupted, or is the last: rows F10 and F11 of the catalogue.
#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <iterator>
#include <system_error>

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include "meshhood/error.h"

#include "support/save_trial.h"
#include "support/system_calls.h"

namespace meshhood::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::array<Version, 2> kBefore = {Version::Old, Version::None};

std::ptrdiff_t open_files() { return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {}); }

class SaveCalls : public SaveTrial {
 protected:
  /// The system calls of a successful save of the new version.
  std::vector<Call> calls_of_a_save(Version before) {
    restore(before);
    const SystemCalls calls;
    save(Version::New);
    return calls.made();
  }

  /// Saves the new version with a fault. Returns the message of the error, or nothing.
  std::string save_with(const Fault& fault) {
    const SystemCalls calls(fault);
    std::string message;
    try {
      save(Version::New);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::IoFailure);
      message = error.what();
    }
    EXPECT_GT(calls.made().size(), fault.at) << "the call was never made";
    return message;
  }

  void expect_success(const std::string& message) const {
    EXPECT_EQ(message, "");
    EXPECT_EQ(held(), Version::New);
    EXPECT_EQ(remove_leftovers(), 0U);
  }

  void expect_refused(const std::string& message, int error, Version still_there) const {
    EXPECT_THAT(message, AllOf(HasSubstr(file.string()), HasSubstr(std::generic_category().message(error))));
    EXPECT_EQ(held(), still_there);
  }
};

std::size_t rename_in(const std::vector<Call>& calls) {
  return static_cast<std::size_t>(std::find(calls.begin(), calls.end(), Call::Rename) - calls.begin());
}

/// The call that a message names.
std::string label(const std::vector<Call>& calls, std::size_t at, Version before) {
  return std::string(name_of(calls[at])) + ", call " + std::to_string(at) +
         (before == Version::None ? ", no file before" : "");
}

// The tests below try each of these calls.
TEST_P(SaveCalls, AreAllIntercepted) {
  const auto calls = calls_of_a_save(Version::Old);
  EXPECT_EQ(calls.front(), Call::Open);
  EXPECT_GE(std::count(calls.begin(), calls.end(), Call::Write), 2);
  EXPECT_THAT(std::vector<Call>(calls.end() - 9, calls.end()),
              ElementsAre(Call::Look, Call::ChangeOwner, Call::ChangeMode, Call::Open, Call::Sync, Call::Close,
                          Call::Rename, Call::Sync, Call::Close));
}

TEST_P(SaveCalls, EachFailureIsAnErrorAndLeavesTheOldFile) {
  std::size_t failures = 0;
  for (const Version before : kBefore) {
    const auto calls = calls_of_a_save(before);
    const auto files = open_files();
    for (std::size_t at = 0; at < calls.size(); ++at) {
      for (const int error : {EIO, ENOSPC, EDQUOT}) {
        SCOPED_TRACE(label(calls, at, before));
        restore(before);
        const std::string message = save_with({FaultKind::Error, at, error});
        if (at <= rename_in(calls)) {
          expect_refused(message, error, before);
        } else if (calls[at] == Call::Sync) {
          expect_refused(message, error, Version::New);
          EXPECT_THAT(message, HasSubstr("the new file is in place"));
        } else {
          expect_success(message);  // only the folder was closed
        }
        EXPECT_EQ(remove_leftovers(), 0U);
        EXPECT_EQ(open_files(), files);
        ++failures;
      }
    }
  }
  std::printf("%zu failed calls\n", failures);
}

TEST_P(SaveCalls, TheFirstErrorIsReportedIfRemovingFailsToo) {
  const auto calls = calls_of_a_save(Version::Old);
  for (std::size_t at = 1; at <= rename_in(calls); ++at) {
    SCOPED_TRACE(label(calls, at, Version::Old));
    restore(Version::Old);
    expect_refused(save_with({.kind = FaultKind::Error, .at = at, .error = ENOSPC, .stuck = true}), ENOSPC,
                   Version::Old);
    EXPECT_EQ(remove_leftovers(), 1U);
  }
}

TEST_P(SaveCalls, SignalsAndShortWritesAreNoErrors) {
  std::size_t times = 0;
  for (const Version before : kBefore) {
    const auto calls = calls_of_a_save(before);
    for (std::size_t at = 0; at < calls.size(); ++at) {
      for (const FaultKind kind : {FaultKind::Error, FaultKind::Short}) {
        SCOPED_TRACE(label(calls, at, before));
        restore(before);
        expect_success(save_with({kind, at, EINTR}));
        ++times;
      }
    }
  }
  std::printf("%zu calls cut short\n", times);
}

// A folder that is writable but not readable, a file of another owner, a file system without support.
TEST_P(SaveCalls, OptionalCallsMayFail) {
  const auto calls = calls_of_a_save(Version::Old);
  const std::size_t rename = rename_in(calls);
  for (const Fault& fault :
       {Fault{FaultKind::Error, rename - 5, EPERM}, Fault{FaultKind::Error, rename - 5, EINVAL},
        Fault{FaultKind::Error, rename - 3, EACCES}, Fault{FaultKind::Error, rename + 1, EINVAL}}) {
    SCOPED_TRACE(label(calls, fault.at, Version::Old));
    restore(Version::Old);
    expect_success(save_with(fault));
  }
}

TEST_P(SaveCalls, TheProcessMayEndBeforeAnyCall) {
  std::size_t kills = 0;
  for (const Version before : kBefore) {
    const auto calls = calls_of_a_save(before);
    for (std::size_t at = 0; at < calls.size(); ++at) {
      for (const FaultKind kind : {FaultKind::Kill, FaultKind::KillWithin}) {
        SCOPED_TRACE(label(calls, at, before));
        restore(before);
        const pid_t child = ::fork();
        if (child == 0) {
          static_cast<void>(save_with({kind, at, 0}));
          ::_exit(0);
        }
        int status = 0;
        ASSERT_EQ(::waitpid(child, &status, 0), child);
        ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) << status;
        EXPECT_EQ(held(), at <= rename_in(calls) ? before : Version::New);
        EXPECT_EQ(remove_leftovers(), 0 < at && at <= rename_in(calls) ? 1U : 0U);
        ++kills;
      }
    }
  }
  std::printf("killed at %zu calls\n", kills);
}

// A pipe or a device is written directly.
TEST_P(SaveCalls, ADeviceFailsByName) {
  file = "/dev/null";
  std::vector<Call> calls;
  {
    const SystemCalls recorded;
    save(Version::New);
    calls = recorded.made();
  }
  ASSERT_EQ(std::count(calls.begin(), calls.end(), Call::Rename), 0);
  for (std::size_t at = 0; at < calls.size(); ++at) {
    SCOPED_TRACE(label(calls, at, Version::None));
    EXPECT_THAT(save_with({FaultKind::Error, at, EIO}), HasSubstr("/dev/null: cannot "));
    EXPECT_EQ(save_with({FaultKind::Error, at, EINTR}), "");
    EXPECT_EQ(save_with({FaultKind::Short, at, 0}), "");
  }
}

MESHHOOD_TRY_ALL_SAVERS(SaveCalls);

}  // namespace
}  // namespace meshhood::test
