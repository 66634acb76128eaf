// SPDX-License-Identifier: MIT
// kill -9 at any moment leaves the old file or the new one: row F11 of the catalogue.
#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <thread>

#include <sys/wait.h>
#include <unistd.h>

#include "support/random.h"
#include "support/save_trial.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

/// The state of the file after each kill.
struct Tally {
  std::size_t kills = 0;
  std::array<std::size_t, 4> held = {};  ///< by `Version`
  std::size_t leftovers = 0;

  [[nodiscard]] std::size_t of(Version version) const { return held[static_cast<std::size_t>(version)]; }
};

class SaveKilled : public SaveTrial {
 protected:
  [[nodiscard]] Tally kill_often(std::size_t times) const {
    const std::size_t most = microseconds_of_two_rounds();
    Random random(1);
    Tally tally;
    restore(Version::Old);
    while (tally.kills < times) {
      kill_a_process_that_saves(std::chrono::microseconds(random.below(most)));
      ++tally.kills;
      ++tally.held[static_cast<std::size_t>(held())];
      tally.leftovers += remove_leftovers();
    }
    std::printf("%zu kills: %zu times the old file, %zu the new, %zu none, %zu torn; %zu leftovers\n", tally.kills,
                tally.of(Version::Old), tally.of(Version::New), tally.of(Version::None), tally.of(Version::Torn),
                tally.leftovers);
    return tally;
  }

 private:
  /// On a slow disk, too, a kill should hit any of the first saves.
  [[nodiscard]] std::size_t microseconds_of_two_rounds() const {
    const auto start = std::chrono::steady_clock::now();
    for (int round = 0; round < 2; ++round) {
      save(Version::New);
      save(Version::Old);
    }
    const std::chrono::duration<double, std::micro> elapsed = std::chrono::steady_clock::now() - start;
    return 1 + static_cast<std::size_t>(elapsed.count());
  }

  void kill_a_process_that_saves(std::chrono::microseconds after) const {
    std::array<int, 2> begun = {};
    ASSERT_EQ(::pipe(begun.data()), 0);
    const pid_t child = ::fork();
    if (child == 0) save_for_ever(begun[1]);
    char byte = 0;
    ASSERT_EQ(::read(begun[0], &byte, 1), 1);
    std::this_thread::sleep_for(after);
    ::kill(child, SIGKILL);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) << status;
    ::close(begun[0]);
    ::close(begun[1]);
  }

  [[noreturn]] void save_for_ever(int begun) const {
    if (::write(begun, "!", 1) != 1) ::_exit(1);
    for (;;) {
      save(Version::New);
      save(Version::Old);
    }
  }
};

TEST_P(SaveKilled, TheFileIsOldOrNew) {
  const Tally tally = kill_often(scaled(200, 40));
  EXPECT_EQ(tally.of(Version::Torn), 0U);
  EXPECT_EQ(tally.of(Version::None), 0U);
  EXPECT_GT(tally.leftovers, 0U) << "no kill has hit a save";
}

MESHHOOD_TRY_ALL_SAVERS(SaveKilled);

// A test of the trial: a writer that overwrites the file in place.
class SaveInPlaceKilled : public SaveKilled {};

TEST_P(SaveInPlaceKilled, TheTrialDetectsATornFile) { EXPECT_GT(kill_often(40).of(Version::Torn), 0U); }

void save_in_place(const std::filesystem::path& path, Version version) {
  std::ofstream file(path, std::ios::binary);
  const std::string line(version == Version::Old ? 1000 : 900, 'x');
  for (int i = 0; i < 500; ++i) file << line << std::flush;
}

INSTANTIATE_TEST_SUITE_P(Control, SaveInPlaceKilled, testing::Values(Saver{"InPlace", save_in_place}));

}  // namespace
}  // namespace meshhood::test
