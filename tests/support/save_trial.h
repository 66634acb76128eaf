// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/scratch.h"

namespace meshhood::test {

/// What a file holds, or is to hold: one of two versions, which differ in content and in size.
enum class Version { Old, New, None, Torn };

/// Something that writes a file. Both versions are larger than what the file writer collects before it writes.
struct Saver {
  std::string name;
  std::function<void(const std::filesystem::path& file, Version version)> save;
};

void PrintTo(const Saver& saver, std::ostream* out);

/// Everything of ours that writes a file.
[[nodiscard]] const std::vector<Saver>& savers();

/// A file in a folder of its own, saved again and again while things go wrong.
class SaveTrial : public testing::TestWithParam<Saver> {
 protected:
  SaveTrial();

  void save(Version version) const { GetParam().save(file, version); }

  /// What stands under the name of the file: a version as a whole, nothing, or anything else, which is called torn.
  [[nodiscard]] Version held() const;

  /// Makes `version` what the file holds, or removes it, as if nothing had happened before.
  void restore(Version version) const;

  /// Removes what saves have left beside the file, and returns how many there were. Anything beside it that cannot be
  /// recognised as such fails the test.
  [[nodiscard]] std::size_t remove_leftovers() const;

  [[nodiscard]] const std::string& content(Version version) const { return version == Version::Old ? old_ : new_; }

  Scratch scratch;
  std::filesystem::path file;  ///< the only one in its folder, which may be another than `scratch`

 private:
  [[nodiscard]] std::string saved(Version version) const;

  std::string old_;
  std::string new_;
};

/// How the cases of a saver are called.
[[nodiscard]] std::string saver_name(const testing::TestParamInfo<Saver>& saver);

}  // namespace meshhood::test

/// Runs the cases of a suite derived from `SaveTrial` with every saver.
#define MESHHOOD_TRY_ALL_SAVERS(suite) \
  INSTANTIATE_TEST_SUITE_P(Of, suite, ::testing::ValuesIn(::meshhood::test::savers()), ::meshhood::test::saver_name)
