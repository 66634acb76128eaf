// SPDX-License-Identifier: MIT
#include "io/index_io.h"

#include <array>
#include <cstddef>
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
#include "io/watched_source.h"

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

  [[nodiscard]] std::span<const std::byte> bytes() const { return std::as_bytes(chars_of(lines, size)); }
};

/// All there is, or enough to see that it is no index. Of a pipe nobody knows beforehand how much that will be.
Content read_all(ByteSource& source) {
  constexpr std::size_t kFirstGuess = std::size_t{1} << 20;
  // One byte more, so that the end is seen without another growth.
  std::size_t capacity = source.size() ? static_cast<std::size_t>(*source.size()) + 1 : kFirstGuess;
  Content content{make_lines(capacity), 0};
  for (;;) {
    const std::size_t count = source.read(chars_of(content.lines, capacity).subspan(content.size));
    if (count == 0) return content;
    content.size += count;
    if (content.size >= sizeof(Line) && !meshhood::is_index(content.bytes())) return content;
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

/// `save` of the core finds the kind of the index.
template <class AnyIndex>
void save_any(const std::filesystem::path& path, const AnyIndex& index) {
  FileWriter file(path);
  const Sink sink = [&](std::span<const std::byte> bytes) {
    file.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  };
  save(index, sink);
  file.commit();
}

/// The index that `take(content, progress)` makes of the whole file; who watches is told of the bytes, and told again
/// while they are verified.
template <class F>
auto load_any(const std::filesystem::path& path, const LoadOptions& options, F&& take) {
  FileSource file(path);
  WatchedSource source(file, options.progress, path.string());
  file.while_waiting([&source] { source.tell(); });
  const Progress verifying = [&source](std::size_t, std::size_t) {
    source.tell();
    return true;
  };
  return naming(path, [&] {
    // What is no index, or not all of one, is not read into memory first.
    if (file.size()) static_cast<void>(meshhood::read_header(MappedFile(path).bytes()));
    auto index = take(read_all(source), verifying);
    source.finish();
    return index;
  });
}

}  // namespace

void save(const std::filesystem::path& path, const Index& index) { save_any(path, index); }
void save(const std::filesystem::path& path, const paper::Index& index) { save_any(path, index); }

Index load(const std::filesystem::path& path, const LoadOptions& options) {
  return load_any(path, options, [](Content content, const Progress& progress) {
    const auto bytes = content.bytes();
    return meshhood::map(bytes, std::shared_ptr<const Line[]>(std::move(content.lines)), {.progress = progress});
  });
}

paper::Index load_paper(const std::filesystem::path& path, const LoadOptions& options) {
  return load_any(path, options, [](const Content& content, const Progress& progress) {
    return paper::load(content.bytes(), {.progress = progress});
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
