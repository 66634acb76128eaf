// SPDX-License-Identifier: MIT
#include "support/shared_meshes.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include <zstd.h>

namespace meshhood::test {
namespace {

constexpr std::string_view kCompressed = ".zst";

std::vector<std::byte> file_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::vector<std::byte> bytes(std::filesystem::file_size(path));
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!file) throw std::runtime_error("cannot read " + path.string());
  return bytes;
}

std::vector<std::byte> decompressed(std::span<const std::byte> packed) {
  const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(), ZSTD_freeDCtx);
  std::vector<std::byte> result;
  std::vector<std::byte> chunk(ZSTD_DStreamOutSize());
  ZSTD_inBuffer in{packed.data(), packed.size(), 0};
  std::size_t state = 1;
  while (state != 0) {
    ZSTD_outBuffer out{chunk.data(), chunk.size(), 0};
    state = ZSTD_decompressStream(context.get(), &out, &in);
    if (ZSTD_isError(state) != 0) throw std::runtime_error(ZSTD_getErrorName(state));
    if (out.pos == 0 && in.pos == in.size && state != 0) throw std::runtime_error("a compressed file that ends early");
    result.insert(result.end(), chunk.begin(), chunk.begin() + static_cast<std::ptrdiff_t>(out.pos));
  }
  return result;
}

std::string trimmed(const std::string& cell) {
  const auto begin = cell.find_first_not_of(" `");
  const auto end = cell.find_last_not_of(" `");
  return begin == std::string::npos ? std::string() : cell.substr(begin, end - begin + 1);
}

std::vector<std::string> table_cells(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> cells;
  for (std::string cell; std::getline(in, cell, '|');) cells.push_back(trimmed(cell));
  if (!cells.empty()) cells.erase(cells.begin());  // a row of the table begins with a bar
  return cells;
}

/// "35,947" as 35947.
std::optional<std::size_t> figure(std::string cell) {
  std::erase(cell, ',');
  if (cell.empty() || cell.find_first_not_of("0123456789") != std::string::npos) return std::nullopt;
  return std::stoull(cell);
}

}  // namespace

std::filesystem::path shared_meshes_dir() {
  const char* const shared = std::getenv("MESHHOOD_SHARED");
  return std::filesystem::path(shared != nullptr ? shared : MESHHOOD_SHARED_DIR) / "meshes";
}

bool have_shared_meshes() { return std::filesystem::exists(shared_meshes_dir() / "MANIFEST.md"); }

std::string plain_name(const std::string& name) {
  return name.ends_with(kCompressed) ? name.substr(0, name.size() - kCompressed.size()) : name;
}

std::optional<std::vector<std::byte>> shared_mesh_bytes(const std::string& name) {
  const auto path = shared_meshes_dir() / name;
  if (!std::filesystem::is_regular_file(path)) return std::nullopt;
  auto bytes = file_bytes(path);
  return name.ends_with(kCompressed) ? decompressed(bytes) : bytes;
}

io::Mesh shared_mesh(const std::string& name, const io::ReadOptions& options) {
  const auto bytes = shared_mesh_bytes(name);
  if (!bytes) throw std::runtime_error("no shared mesh " + name);
  return io::read_mesh(*bytes, plain_name(name), options);
}

std::string shared_mesh_case(const testing::TestParamInfo<const char*>& file) {
  const std::string path = file.param;
  const auto begin = path.find('/') + 1;
  return path.substr(begin, path.find('.') - begin);
}

std::vector<ManifestRow> read_manifest() {
  std::ifstream file(shared_meshes_dir() / "MANIFEST.md");
  std::vector<ManifestRow> rows;
  std::ptrdiff_t vertices = 0;
  for (std::string line; std::getline(file, line);) {
    const auto cells = table_cells(line);
    const auto heading = std::find(cells.begin(), cells.end(), "vertices");
    if (heading != cells.end()) vertices = heading - cells.begin();
    if (vertices == 0 || !line.starts_with("| `")) continue;
    const auto at = cells.begin() + vertices;
    if (cells.end() - at >= 3) rows.push_back({cells[0], figure(at[0]), figure(at[1]), at[2]});
  }
  return rows;
}

}  // namespace meshhood::test
