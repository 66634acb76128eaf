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

/// One of two versions of a file, which differ in content and size.
enum class Version { Old, New, None, Torn };

/// A function that writes a file. Both versions are larger than the buffer of the file writer.
struct Saver {
  std::string name;
  std::function<void(const std::filesystem::path& file, Version version)> save;
};

void PrintTo(const Saver& saver, std::ostream* out);

/// All functions that write a file.
[[nodiscard]] const std::vector<Saver>& savers();

/// A file in a folder of its own, which is saved repeatedly under faults.
class SaveTrial : public testing::TestWithParam<Saver> {
 protected:
  SaveTrial();

  void save(Version version) const { GetParam().save(file, version); }

  /// The state of the file: a complete version, missing, or else torn.
  [[nodiscard]] Version held() const;

  /// Resets the file to `version`, or removes it.
  void restore(Version version) const;

  /// Removes the temporary files of saves and returns their number. Any other file beside the saved one fails the test.
  [[nodiscard]] std::size_t remove_leftovers() const;

  [[nodiscard]] const std::string& content(Version version) const { return version == Version::Old ? old_ : new_; }

  Scratch scratch;
  std::filesystem::path file;  ///< the only one in its folder, which need not be `scratch`

 private:
  [[nodiscard]] std::string saved(Version version) const;

  std::string old_;
  std::string new_;
};

/// The name of the test case of a saver.
[[nodiscard]] std::string saver_name(const testing::TestParamInfo<Saver>& saver);

}  // namespace meshhood::test

/// Runs the cases of a suite derived from `SaveTrial` with every saver.
#define MESHHOOD_TRY_ALL_SAVERS(suite) \
  INSTANTIATE_TEST_SUITE_P(Of, suite, ::testing::ValuesIn(::meshhood::test::savers()), ::meshhood::test::saver_name)
