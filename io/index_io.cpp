// SPDX-License-Identifier: MIT
#include "io/index_io.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <utility>

#include "meshhood/error.h"

#include "io/aligned_buffer.h"
#include "io/byte_source.h"
#include "io/file_writer.h"
#include "io/mapped_file.h"
#include "io/place.h"
#include "io/tell.h"
#include "io/watched_source.h"

namespace meshhood::io {
namespace {

/// Reads until `out` is full or the source ends, and returns how much that is.
std::size_t fill(ByteSource& source, std::span<char> out) {
  std::size_t size = 0;
  while (size < out.size()) {
    const std::size_t count = source.read(out.subspan(size));
    if (count == 0) break;
    size += count;
  }
  return size;
}

using Head = std::array<char, kIndexHeadBytes>;

std::span<const std::byte> bytes_of(const Head& head, std::size_t size) {
  return std::as_bytes(std::span(head).first(size));
}

/// Refuses what is no index, or not all of one, by its first bytes; of a pipe nobody knows how much will come.
void check_head(std::span<const std::byte> first_bytes, const std::optional<std::uint64_t>& size) {
  if (size) {
    static_cast<void>(meshhood::read_header(first_bytes, *size));
  } else if (!meshhood::is_index(first_bytes)) {
    static_cast<void>(meshhood::read_header(first_bytes));
  }
}

/// All there is, unless its beginning is refused, before anything is allocated for it.
AlignedBuffer read_all(ByteSource& source) {
  constexpr std::size_t kFirstGuess = std::size_t{1} << 20;
  Head head;
  const std::size_t known = fill(source, head);
  check_head(bytes_of(head, known), source.size());
  // One byte more than there are, so that the end is seen without another growth.
  AlignedBuffer all(std::max(known, static_cast<std::size_t>(source.size().value_or(kFirstGuess))) + 1);
  std::copy_n(head.begin(), known, all.room().begin());
  all.add(known);
  for (;;) {
    all.add(fill(source, all.room()));
    if (!all.room().empty()) return all;
    all.grow();
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
void save_any(const std::filesystem::path& path, const AnyIndex& index, const SaveOptions& options) {
  FileWriter file(path);
  const std::string name = path.string();
  std::size_t all = 0;
  const Progress progress = [&](std::size_t done, std::size_t total) {
    all = total;
    report(options.progress, done, total, name);
    return true;
  };
  const Sink sink = [&](std::span<const std::byte> bytes) {
    file.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  };
  save(index, sink, {.progress = progress});
  file.commit([&] { report(options.progress, all, all, name); });
}

/// The index that `take(content, progress)` makes of the whole file; who watches is told of the bytes, and told again
/// while they are verified.
template <class F>
auto load_any(const std::filesystem::path& path, const LoadOptions& options, F&& take) {
  FileSource file(path);
  WatchedSource source(file, options.progress, path.string());
  file.while_waiting([&source] { source.report(); });
  const Progress verifying = [&source](std::size_t, std::size_t) {
    source.report();
    return true;
  };
  return naming(path, [&] {
    auto index = take(read_all(source), verifying);
    source.finish();
    return index;
  });
}

}  // namespace

void save(const std::filesystem::path& path, const Index& index, const SaveOptions& options) {
  save_any(path, index, options);
}

void save(const std::filesystem::path& path, const paper::Index& index, const SaveOptions& options) {
  save_any(path, index, options);
}

Index load(const std::filesystem::path& path, const LoadOptions& options) {
  return load_any(path, options, [](AlignedBuffer content, const Progress& progress) {
    const auto bytes = content.bytes();
    return meshhood::map(bytes, content.take_owner(), {.progress = progress});
  });
}

paper::Index load_paper(const std::filesystem::path& path, const LoadOptions& options) {
  return load_any(path, options, [](const AlignedBuffer& content, const Progress& progress) {
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
  const std::size_t count = fill(source, first);
  return meshhood::is_index(std::as_bytes(std::span(first).first(count)));
}

IndexHeader read_header(const std::filesystem::path& path) {
  FileSource source(path);
  if (!source.is_ordinary()) {
    raise(ErrorCode::IoFailure, printable_name(path.string()) + ": is no ordinary file, which an index has to be");
  }
  Head head;
  const std::size_t known = fill(source, head);
  return naming(path, [&] { return meshhood::read_header(bytes_of(head, known), source.size().value_or(known)); });
}

}  // namespace meshhood::io
