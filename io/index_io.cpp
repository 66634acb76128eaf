// SPDX-License-Identifier: MIT
#include "io/index_io.h"

#include <array>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <system_error>
#include <utility>

#include "meshhood/error.h"

#include "io/byte_source.h"
#include "io/file_writer.h"
#include "io/mapped_file.h"
#include "io/place.h"

namespace meshhood::io {
namespace {

struct alignas(kIndexAlignment) Line {
  std::array<std::byte, kIndexAlignment> bytes;
};
using Lines = std::unique_ptr<Line[]>;  // NOLINT(modernize-avoid-c-arrays): a vector would write to all of it

Lines make_lines(std::size_t bytes) { return std::make_unique_for_overwrite<Line[]>(bytes / sizeof(Line) + 1); }

std::span<char> chars_of(const Lines& lines, std::size_t bytes) {
  return {reinterpret_cast<char*>(lines.get()), bytes};
}

/// The bytes of a file, where `map` wants them.
struct Content {
  Lines lines;
  std::size_t size = 0;
};

/// All there is. Of a pipe nobody knows beforehand how much that will be.
Content read_all(FileSource& source) {
  constexpr std::size_t kFirstGuess = std::size_t{1} << 20;
  // One byte more, so that the end is seen without another growth.
  std::size_t capacity = source.size() ? static_cast<std::size_t>(*source.size()) + 1 : kFirstGuess;
  Content content{make_lines(capacity), 0};
  for (;;) {
    const std::size_t count = source.read(chars_of(content.lines, capacity).subspan(content.size));
    if (count == 0) return content;
    content.size += count;
    if (content.size < capacity) continue;
    Lines wider = make_lines(2 * capacity);
    std::ranges::copy(chars_of(content.lines, content.size), chars_of(wider, content.size).begin());
    content.lines = std::move(wider);
    capacity *= 2;
  }
}

/// What `call` returns; what is wrong with the file's content is told with the file's name.
template <class F>
auto naming(const std::filesystem::path& path, F&& call) {
  try {
    return call();
  } catch (const Error& error) {
    if (error.code() != ErrorCode::MalformedIndex) throw;
    raise(error.code(), printable_name(path.string()) + ": " + error.what());
  } catch (const std::bad_alloc&) {
    raise(ErrorCode::TooLarge, printable_name(path.string()) + ": not enough memory for this index");
  }
}

}  // namespace

void save(const std::filesystem::path& path, const Index& index) {
  FileWriter file(path);
  meshhood::save(index, [&](std::span<const std::byte> bytes) {
    file.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  });
  file.commit();
}

Index load(const std::filesystem::path& path) {
  FileSource source(path);
  return naming(path, [&] {
    Content content = read_all(source);
    const auto bytes = std::as_bytes(chars_of(content.lines, content.size));
    return meshhood::map(bytes, std::shared_ptr<const Line[]>(std::move(content.lines)));
  });
}

Index map(const std::filesystem::path& path, const MapOptions& options) {
  const auto file = std::make_shared<const MappedFile>(path);
  return naming(path, [&] { return meshhood::map(file->bytes(), file, options); });
}

bool is_index(const std::filesystem::path& path) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(path, unknown)) return false;
  FileSource source(path);
  std::array<char, 8> first{};
  const std::size_t count = source.read(first);
  return meshhood::is_index(std::as_bytes(std::span(first).first(count)));
}

IndexHeader read_header(const std::filesystem::path& path) {
  const MappedFile file(path);
  return naming(path, [&] { return meshhood::read_header(file.bytes()); });
}

}  // namespace meshhood::io
