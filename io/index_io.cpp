// SPDX-License-Identifier: MIT
#include "io/index_io.h"

#include <cerrno>
#include <cstddef>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <variant>

#include "meshhood/error.h"

#include "io/byte_source.h"
#include "io/file_writer.h"
#include "io/mapped_file.h"
#include "io/messages.h"
#include "io/readers.h"
#include "io/waiting.h"
#include "shared/aligned_buffer.h"

namespace meshhood::inline v0_1::io {
namespace {

std::span<const std::byte> first_bytes(FileSource& file, std::size_t count = kIndexHeadBytes) {
  return std::as_bytes(std::span(file.peek(count)));
}

bool begins_index(FileSource& file) {
  constexpr std::size_t kMagicBytes = 8;
  return meshhood::is_index(first_bytes(file, kMagicBytes));
}

/// Refuses a file whose first bytes are not those of an index of its size. The size of a pipe is unknown.
void check_head(FileSource& file) {
  const std::span<const std::byte> head = first_bytes(file);
  if (file.size()) {
    static_cast<void>(meshhood::read_header(head, *file.size()));
  } else if (!meshhood::is_index(head)) {
    static_cast<void>(meshhood::read_header(head));
  }
}

/// Reads the whole file. A wrong beginning is refused before memory is allocated for the rest.
AlignedBuffer read_all(FileSource& file) {
  constexpr std::size_t kFirstGuess = std::size_t{1} << 20;
  check_head(file);
  // One byte more than the size, so that the end is found without growing the buffer.
  AlignedBuffer all(static_cast<std::size_t>(file.size().value_or(kFirstGuess)) + 1);
  for (;;) {
    all.add(file.fill(all.room()));
    if (!all.room().empty()) return all;
    all.grow();
  }
}

/// Returns `call()`. Adds the name of the file to errors about its content.
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

/// Writes what `save(sink, progress)` passes to the sink.
template <class F>
void save_with(const std::filesystem::path& path, const Progress& reported, F&& save) {
  const std::string name = path.string();
  std::size_t done = 0;
  std::size_t all = 0;
  const WhileWaiting waiting([&] { report(reported, done, all, name); });
  FileWriter file(path);
  const Progress progress = [&](std::size_t so_far, std::size_t total) {
    done = so_far;
    all = total;
    report(reported, done, total, name);
    return true;
  };
  const Sink sink = [&](std::span<const std::byte> bytes) {
    file.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  };
  save(sink, progress);
  file.commit([&] { report(reported, all, all, name); });
}

/// Reads the whole file and returns `take(content, progress)`. Progress counts bytes; while the content is verified,
/// it is called again with the same count so that the caller can cancel.
template <class F>
auto load_with(FileSource& file, const std::filesystem::path& path, const Progress& progress, F&& take) {
  file.watch(progress, path.string());
  const WhileWaiting waiting([&file] { file.report(); });
  const Progress verifying = [&file](std::size_t, std::size_t) {
    file.report();
    return true;
  };
  return naming(path, [&] {
    auto index = take(read_all(file), verifying);
    file.finish();
    return index;
  });
}

Index take_exact(AlignedBuffer content, const Progress& progress) {
  const auto bytes = content.bytes();
  return meshhood::map(bytes, content.take_owner(), {}, {.progress = progress});
}

paper::Index take_paper(const AlignedBuffer& content, const Progress& progress) {
  return paper::load(content.bytes(), {.progress = progress});
}

LoadedIndex take_any(AlignedBuffer content, const Progress& progress) {
  const IndexHeader header = meshhood::read_header(content.bytes());
  if (header.kind == IndexKind::Paper) return {header, take_paper(content, progress)};
  return {header, take_exact(std::move(content), progress)};
}

}  // namespace

void save(const std::filesystem::path& path, const Index& index, const SaveOptions& options, const Run& run) {
  save_with(path, run.progress, [&](const Sink& sink, const Progress& progress) {
    meshhood::save(index, sink, options, {.progress = progress});
  });
}

void save(const std::filesystem::path& path, const paper::Index& index, const Run& run) {
  save_with(path, run.progress,
            [&](const Sink& sink, const Progress& progress) { paper::save(index, sink, {.progress = progress}); });
}

Index load(const std::filesystem::path& path, const Run& run) {
  FileSource file(path);
  return load_with(file, path, run.progress, take_exact);
}

paper::Index load_paper(const std::filesystem::path& path, const Run& run) {
  FileSource file(path);
  return load_with(file, path, run.progress, take_paper);
}

LoadedIndex load_any(const std::filesystem::path& path, const Run& run) {
  FileSource file(path);
  return load_with(file, path, run.progress, take_any);
}

std::variant<Mesh, LoadedIndex> read_mesh_or_index(const std::filesystem::path& path, const ReadOptions& options) {
  FileSource file(path);
  const bool is_index = [&] {
    const WhileWaiting waiting([&] { report(options.progress, 0, 0, path.string()); });
    return begins_index(file);
  }();
  if (!is_index) return read_mesh(file, path.string(), options);
  return load_with(file, path, options.progress, take_any);
}

Index map(const std::filesystem::path& path, const MapOptions& options, const Run& run) {
  const auto file = std::make_shared<const MappedFile>(path);
  return naming(path, [&] { return meshhood::map(file->bytes(), file, options, run); });
}

bool is_index(const std::filesystem::path& path) {
  std::error_code unknown;
  if (path == kStandardInput || !std::filesystem::is_regular_file(path, unknown)) return false;
  FileSource file(path);
  return begins_index(file);
}

IndexHeader read_header(const std::filesystem::path& path) {
  FileSource source(path);
  if (!source.is_regular()) {
    raise_io(path, EINVAL, "is not a regular file, expected an index file");
  }
  const std::span<const std::byte> head = first_bytes(source);
  return naming(path, [&] { return meshhood::read_header(head, source.size().value_or(head.size())); });
}

}  // namespace meshhood::inline v0_1::io
