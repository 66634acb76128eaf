// SPDX-License-Identifier: MIT
// Folders of parts. The first byte of an input says what the others are: a manifest or the record of a part, whose
// checksum is corrected before it is read; or changes to the files of a folder, which a run then completes.
#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <span>
#include <string>

#include <fmt/format.h>

#include "bytes.h"
#include "parts/folder.h"
#include "parts/manifest.h"
#include "parts/partition.h"
#include "refusal.h"
#include "shared/checksum.h"
#include "support/families.h"
#include "support/parts_folder.h"
#include "support/scratch.h"
#include "target.h"

namespace meshhood::fuzz {
namespace {

namespace fs = std::filesystem;
using parts::Manifest;

const test::TestMesh& mesh() {
  static const test::TestMesh made = test::make_grid(4, 8, true).finish(true);
  return made;
}

parts::PartitionResult partition_into(const fs::path& folder) {
  return parts::partition(*test::chunked(mesh()), folder, {.parts = 2, .halo = 1});
}

void write(const fs::path& path, const std::string& content) {
  fs::remove(path);  // a file that is mapped keeps its content
  std::ofstream(path, std::ios::binary) << content;
}

using Contents = std::map<std::string, std::string>;

/// Name -> content of the files of a folder.
Contents contents(const fs::path& folder) {
  Contents files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files[fs::relative(entry.path(), folder).string()] = test::read_file(entry.path());
  }
  return files;
}

/// In memory, where a sync takes no time, if the system has a folder there.
fs::path fast_folder() {
  const fs::path memory = "/dev/shm";
  return fs::is_directory(memory) ? memory : fs::temp_directory_path();
}

/// A complete folder and what it holds.
struct Folder {
  test::Scratch scratch{fast_folder()};
  fs::path path = scratch.path() / "parts";
  parts::PartitionResult result = partition_into(path);
  Contents expected = contents(path);

  void restore() const {
    fs::remove_all(path);
    for (const auto& [name, content] : expected) {
      fs::create_directories((path / name).parent_path());
      write(path / name, content);
    }
  }
};

Folder& folder() {
  static Folder one;
  return one;
}

/// The text of a JSON file of a folder, whose first line is its checksum.
std::string sealed(std::string_view rest) {
  return fmt::format("{{\"checksum\": \"{:016x}\",\n{}", checksum({std::as_bytes(std::span(rest))}), rest);
}

bool is_same(const parts::Part& a, const parts::Part& b) {
  return a.vertices == b.vertices && a.owned == b.owned && a.faces == b.faces && a.files == b.files;
}

/// A manifest that is accepted is the same when it is written and read again.
void read_manifest(const std::string& text) {
  const fs::path place = folder().scratch.path() / "manifest";
  fs::create_directory(place);
  write(place / parts::kManifestFile, text);
  try {
    const Manifest read = parts::read_manifest(place);
    parts::write_manifest(place, read);
    const Manifest again = parts::read_manifest(place);
    if (again.plan != read.plan || !std::ranges::equal(again.parts, read.parts, is_same)) fail("another manifest");
  } catch (const Error& error) {
    expect_clear(error, {ErrorCode::MalformedIndex}, "manifest.json");
  }
}

/// That of the parts in fuzz/seeds.py.
const parts::Plan kPlan{.vertices = 32,
                        .faces = 42,
                        .is_double = false,
                        .content_hash = {0x0123456789abcdef, 0x0123456789abcdef},
                        .mean_edge_length = 1.2,
                        .halo = 1,
                        .parts = 2};

void read_part(const std::string& text) {
  const fs::path place = folder().scratch.path() / "part";
  fs::create_directory(place);
  write(place / parts::kPartFile, text);
  try {
    const auto part = parts::read_part(place, kPlan, 1);
    if (!part || part->owned > part->vertices) fail("an impossible part was accepted");
  } catch (const Error& error) {
    expect_clear(error, {ErrorCode::MalformedIndex}, "part.json");
  }
}

void change(const fs::path& path, const std::string& content, Bytes& bytes) {
  const auto kind = bytes.take<std::uint8_t>();
  const std::size_t place = content.empty() ? 0 : bytes.take<std::uint16_t>() % content.size();
  std::string changed = content;
  switch (kind % 4) {
    case 0: fs::remove(path); return;
    case 1: changed.resize(place); break;
    case 2: changed += static_cast<char>(bytes.take<std::uint8_t>()); break;
    default:
      if (!changed.empty()) changed[place] = static_cast<char>(bytes.take<std::uint8_t>());
  }
  write(path, changed);
}

/// The next run refuses the folder, or completes it with the bytes that it had.
void complete(Bytes& bytes) {
  Folder& one = folder();
  constexpr std::size_t kMostChanges = 6;
  std::set<fs::path> changed;  // with the folder of each, which names a part whose record is missing
  for (std::size_t i = 0; i < kMostChanges && !bytes.empty(); ++i) {
    const auto file = std::next(one.expected.begin(), bytes.take<std::uint8_t>() % std::ssize(one.expected));
    if (file->first == parts::kMarkFile) continue;  // which no run reads or writes again
    change(one.path / file->first, file->second, bytes);
    changed.insert({file->first, fs::path(file->first).parent_path()});
  }
  try {
    static_cast<void>(partition_into(one.path));
    if (contents(one.path) != one.expected) fail("a run kept a changed file");
  } catch (const Error& error) {
    const std::string line = error.what();
    const auto is_named = [&](const fs::path& name) { return line.starts_with((one.path / name).string() + ": "); };
    if (std::ranges::none_of(changed, is_named)) fail("the error names no changed file: " + line);
    expect_clear(error, {ErrorCode::MalformedIndex}, one.path.string());
  }
  one.restore();
}

}  // namespace

void run(std::span<const std::byte> input) {
  Bytes bytes(input);
  const auto kind = bytes.take<std::uint8_t>();
  const auto body = input.subspan(std::min<std::size_t>(1, input.size()));
  const std::string text(reinterpret_cast<const char*>(body.data()), body.size());
  switch (kind % 4) {
    case 0: return read_manifest(sealed(text));
    case 1: return read_part(sealed(text));
    case 2: return read_manifest(text);
    default: return complete(bytes);
  }
}

}  // namespace meshhood::fuzz
