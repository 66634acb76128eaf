// SPDX-License-Identifier: MIT
#include "support/save_trial.h"

#include <fstream>
#include <ostream>
#include <regex>

namespace meshhood::test {

void PrintTo(const Saver& saver, std::ostream* out) { *out << saver.name; }

std::string saver_name(const testing::TestParamInfo<Saver>& saver) { return saver.param.name; }

SaveTrial::SaveTrial()
    : file(scratch.path() / "trial" / "out.file"), old_(saved(Version::Old)), new_(saved(Version::New)) {
  std::filesystem::create_directory(file.parent_path());
  EXPECT_NE(old_.size(), new_.size());
}

std::string SaveTrial::saved(Version version) const {
  const auto sample = scratch.path() / "sample";
  GetParam().save(sample, version);
  return read_file(sample);
}

Version SaveTrial::held() const {
  if (!std::filesystem::exists(file)) return Version::None;
  const std::string found = read_file(file);
  return found == old_ ? Version::Old : found == new_ ? Version::New : Version::Torn;
}

void SaveTrial::restore(Version version) const {
  std::filesystem::remove(file);
  if (version == Version::None) return;
  std::ofstream(file, std::ios::binary) << content(version);
}

std::size_t SaveTrial::remove_leftovers() const {
  const std::regex leftover(R"(\.out\.file\.meshhood-\d+-\d+\.tmp)");
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(file.parent_path())) {
    if (entry.path() == file) continue;
    EXPECT_TRUE(std::regex_match(entry.path().filename().string(), leftover)) << entry.path();
    found.push_back(entry.path());
  }
  for (const auto& path : found) std::filesystem::remove(path);
  return found.size();
}

}  // namespace meshhood::test
