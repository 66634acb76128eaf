// SPDX-License-Identifier: MIT
#include "io/mesh_io.h"

#include <algorithm>
#include <new>
#include <stdexcept>

#include <fmt/format.h>

#include "meshhood/error.h"

#include "io/byte_source.h"
#include "io/input_buffer.h"
#include "io/readers.h"
#include "io/waiting.h"

namespace meshhood::inline v0_1::io {
namespace {

void check_threads(const ReadOptions& options) {
  if (options.threads <= kMaxThreads) return;
  raise(ErrorCode::InvalidOption, fmt::format("threads is {}, expected at most {}", options.threads, kMaxThreads));
}

[[noreturn, maybe_unused]] void refuse_memory(const InputBuffer& input) {
  raise(ErrorCode::TooLarge, input.name() + ": not enough memory for this mesh");
}

Mesh read_whole(ByteSource& source, InputBuffer& input, const std::string& name, const ReadOptions& options) {
  Mesh mesh = read_format(detect_format(input, name), input, {options});
  source.finish();
  return mesh;
}

Mesh read(ByteSource& source, const std::string& name, const ReadOptions& options) {
  check_threads(options);
  InputBuffer input(source, name, options.max_bytes);
#if defined(__cpp_exceptions)
  try {
    return read_whole(source, input, name, options);
  } catch (const std::bad_alloc&) {
    refuse_memory(input);
  } catch (const std::length_error&) {
    refuse_memory(input);
  }
#else
  return read_whole(source, input, name, options);
#endif
}

}  // namespace

std::string Warning::text() const {
  return fmt::format("{}{}{}{}", first_place, first_place.empty() ? "" : ": ", what,
                     count > 1 ? fmt::format(" ({} times)", count) : "");
}

Mesh read_format(Format format, InputBuffer& input, const ReaderOptions& options) {
  switch (format) {
    case Format::Ply: return read_ply(input, options);
    case Format::Obj: return read_obj(input, options);
    case Format::Off: return read_off(input, options);
    case Format::Stl: return read_stl(input, options);
    case Format::Vtk: return read_vtk(input, options);
    case Format::FreeSurfer:
    case Format::Other: break;  // none that `detect_format` returns
  }
  return read_freesurfer(input, options);
}

void refuse_walls(const Mesh& mesh, const std::string& name) {
  const auto wall = std::find(mesh.walls.begin(), mesh.walls.end(), 1);
  if (wall != mesh.walls.end()) refuse_wall(static_cast<std::uint64_t>(wall - mesh.walls.begin()), name);
}

void refuse_wall(std::uint64_t vertex, const std::string& name) {
  raise(ErrorCode::InvalidMesh,
        fmt::format("{}: vertex {} has no position (NaN), which an index file cannot say; write the mesh without such "
                    "vertices",
                    name, vertex));
}

Mesh read_mesh(const std::filesystem::path& path, const ReadOptions& options) {
  FileSource file(path);
  return read_mesh(file, path.string(), options);
}

Mesh read_mesh(FileSource& file, const std::string& name, const ReadOptions& options) {
  file.watch(options.progress, name);
  const WhileWaiting waiting([&file] { file.report(); });
  return read(file, name, options);
}

Mesh read_mesh(std::span<const std::byte> bytes, const std::string& name, const ReadOptions& options) {
  MemorySource memory(bytes);
  memory.watch(options.progress, name);
  return read(memory, name, options);
}

}  // namespace meshhood::inline v0_1::io
