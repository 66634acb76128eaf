// SPDX-License-Identifier: MIT
#include "parts/folder.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "meshhood/error.h"

#include "parts/manifest.h"

namespace meshhood::parts {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPartStem = "part-";

/// Whether a name is that of a part, a spill or the edges of a run: `stem` and numbers.
bool is_numbered(std::string_view name, std::string_view stem) {
  return name.size() > stem.size() && name.starts_with(stem) &&
         name.find_first_not_of("0123456789-", stem.size()) == std::string_view::npos;
}

bool is_file_of_part(std::string_view name) {
  return name == kPartFile || std::ranges::find(kPartFiles, name) != kPartFiles.end();
}

/// `FileWriter` gives a file that it has not finished the middle of such a name.
bool is_temporary(std::string_view name) {
  constexpr std::array kStems{kPartStem, std::string_view("vertices-"), std::string_view("faces-"),
                              std::string_view("edges")};
  return name == kManifestFile || is_file_of_part(name) || name.find(".meshhood-") != std::string_view::npos ||
         std::ranges::any_of(kStems, [&](std::string_view stem) { return is_numbered(name, stem); });
}

[[noreturn]] void refuse_unknown(const fs::path& entry) {
  raise(ErrorCode::MalformedIndex,
        fmt::format("{}: was not written by a partition; expected an empty folder, or one with parts of an earlier run",
                    io::printable_name(entry.string())));
}

void check_temporary(const fs::path& folder) {
  if (!fs::is_directory(fs::symlink_status(folder))) refuse_unknown(folder);
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!is_temporary(entry.path().filename().string())) refuse_unknown(entry.path());
  }
}

}  // namespace

bool is_part_name(const fs::path& name) { return is_numbered(name.string(), kPartStem); }

void check_folder(const fs::path& folder) {
  const bool has_manifest = fs::exists(folder / kManifestFile);
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path name = entry.path().filename();
    if (name == kTemporaryFolder) {
      check_temporary(entry.path());
    } else if (name == kManifestFile ? !begins_as_json(entry.path()) : !has_manifest && !is_part_name(name)) {
      refuse_unknown(entry.path());
    }
  }
}

void check_part(const fs::path& part) {
  const fs::file_status status = fs::symlink_status(part);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status)) refuse_unknown(part);
  for (const auto& entry : fs::directory_iterator(part)) {
    if (!entry.is_regular_file() || !is_file_of_part(entry.path().filename().string())) refuse_unknown(entry.path());
  }
  const bool is_listed = begins_as_json(part.parent_path() / kManifestFile);
  if (!is_listed && !fs::is_empty(part) && !begins_as_json(part / kPartFile)) refuse_unknown(part);
}

void remove_part(const fs::path& part) {
  for (const std::string_view name : kPartFiles) fs::remove(part / name);
  fs::remove(part / kPartFile);
  fs::remove(part);
}

}  // namespace meshhood::parts
