// SPDX-License-Identifier: MIT
#include "parts/folder.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "meshhood/error.h"

#include "parts/manifest.h"

namespace meshhood::parts {
namespace {

namespace fs = std::filesystem;

bool is_file_of_part(const fs::directory_entry& entry) {
  const std::string name = entry.path().filename().string();
  return entry.is_regular_file() && (name == kPartFile || std::ranges::find(kPartFiles, name) != kPartFiles.end());
}

[[noreturn]] void refuse(const fs::path& entry) {
  raise(ErrorCode::MalformedIndex, fmt::format("{}: was not written by a partition, which would remove it; move it",
                                               io::printable_name(entry.string())));
}

}  // namespace

void mark_folder(const fs::path& folder) {
  const fs::path mark = folder / kMarkFile;
  if (fs::exists(mark)) return;
  // In one step: a temporary file that a killed run has left would be a file of others.
  io::Descriptor file = io::open_to_append(mark);
  if (!file.is_open() || !file.close()) io::raise_errno(mark, errno, "create");
}

void check_mark(const fs::path& folder) {
  if (fs::exists(folder / kMarkFile)) return;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename() == io::kLockFile) continue;
    raise(ErrorCode::MalformedIndex,
          fmt::format("{}: has files, but not {}, the mark of a partition; expected a new or an empty folder",
                      io::printable_name(folder.string()), kMarkFile));
  }
}

void check_part(const fs::path& part) {
  const fs::file_status status = fs::symlink_status(part);
  if (fs::is_symlink(status)) return;  // the link alone is removed
  if (!fs::is_directory(status)) refuse(part);
  for (const auto& entry : fs::directory_iterator(part)) {
    if (!is_file_of_part(entry)) refuse(entry.path());
  }
}

void remove_part(const fs::path& part, const fs::path& temporary) {
  const fs::path removed = temporary / part.filename();
  fs::rename(part, removed);
  fs::remove_all(removed);
}

}  // namespace meshhood::parts
