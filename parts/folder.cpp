// SPDX-License-Identifier: MIT
#include "parts/folder.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "meshhood/error.h"

#include "io/number.h"
#include "parts/manifest.h"

namespace meshhood::parts {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPartStem = "part-";

/// Whether a name is `stem` and numbers.
bool is_numbered(std::string_view name, std::string_view stem) {
  return name.size() > stem.size() && name.starts_with(stem) &&
         name.find_first_not_of("0123456789-", stem.size()) == std::string_view::npos;
}

bool is_file_of_part(std::string_view name) {
  return name == kPartFile || std::ranges::find(kPartFiles, name) != kPartFiles.end();
}

/// NAME, for the `.NAME.meshhood-PID-N.tmp` of a `FileWriter` that has not finished; otherwise the name itself.
std::string_view finished_name(std::string_view name) {
  constexpr std::string_view kMiddle = ".meshhood-";
  constexpr std::string_view kEnd = ".tmp";
  const std::size_t middle = name.rfind(kMiddle);
  if (!name.starts_with('.') || !name.ends_with(kEnd) || middle == std::string_view::npos || middle == 0) return name;
  const std::string_view numbers = name.substr(middle, name.size() - kEnd.size() - middle);
  return is_numbered(numbers, kMiddle) ? name.substr(1, middle - 1) : name;
}

/// Whether a name is that of a part, a spill, the edges of a run, or a file of a part or the manifest.
bool is_temporary(std::string_view name) {
  constexpr std::array kStems{kPartStem, std::string_view("vertices-"), std::string_view("faces-"),
                              std::string_view("edges")};
  const std::string_view finished = finished_name(name);
  return finished == kManifestFile || is_file_of_part(finished) ||
         std::ranges::any_of(kStems, [&](std::string_view stem) { return is_numbered(name, stem); });
}

[[noreturn]] void refuse_unknown(const fs::path& entry) {
  raise(ErrorCode::MalformedIndex,
        fmt::format("{}: was not written by a partition, so it is not removed; move it, or choose another folder",
                    io::printable_name(entry.string())));
}

void check_temporary(const fs::path& folder) {
  if (!fs::is_directory(fs::symlink_status(folder))) refuse_unknown(folder);
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!is_temporary(entry.path().filename().string())) refuse_unknown(entry.path());
  }
}

/// A manifest that is damaged at its beginning is known by the parts beside it.
void check_manifest(const fs::path& manifest) {
  if (!fs::is_regular_file(manifest)) refuse_unknown(manifest);
  if (fs::is_empty(manifest) || begins_as_json(manifest)) return;
  for (const auto& entry : fs::directory_iterator(manifest.parent_path())) {
    if (part_number(entry.path().filename()) && has_record(entry.path())) return;
  }
  refuse_unknown(manifest);
}

}  // namespace

std::optional<std::uint64_t> part_number(const fs::path& name) {
  const std::string text = name.string();
  if (!text.starts_with(kPartStem)) return std::nullopt;
  const auto number = io::parse_count(std::string_view(text).substr(kPartStem.size()));
  return number && part_name(*number) == text ? number : std::nullopt;
}

bool has_record(const fs::path& part) { return begins_as_json(part / kPartFile); }

void check_folder(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path name = entry.path().filename();
    if (name == kTemporaryFolder) check_temporary(entry.path());
    if (name == kManifestFile) check_manifest(entry.path());
  }
}

std::uint64_t listed_parts(const fs::path& folder) {
  if (!fs::exists(folder / kManifestFile)) return 0;
  try {
    return read_manifest(folder).plan.parts;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::MalformedIndex) throw;
    return 0;
  }
}

void check_part(const fs::path& part, std::uint64_t listed) {
  const fs::file_status status = fs::symlink_status(part);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status)) refuse_unknown(part);
  for (const auto& entry : fs::directory_iterator(part)) {
    if (!entry.is_regular_file() || !is_file_of_part(entry.path().filename().string())) refuse_unknown(entry.path());
  }
  const bool is_listed = part_number(part.filename()).value_or(listed) < listed;
  if (!is_listed && !has_record(part)) refuse_unknown(part);
}

void remove_part(const fs::path& part, std::uint64_t listed, const fs::path& temporary) {
  check_part(part, listed);
  if (!fs::exists(part)) return;
  const fs::path removed = temporary / part.filename();
  fs::rename(part, removed);
  fs::remove_all(removed);
}

}  // namespace meshhood::parts
