// SPDX-License-Identifier: MIT
#include "read.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "meshhood/error.h"

#include "io/byte_source.h"
#include "io/input_buffer.h"
#include "io/readers.h"
#include "judge.h"

namespace meshhood::fuzz {
namespace {

constexpr std::size_t kLarge = 300;  // vertices or corners; the oracle would be too slow for more

struct Outcome {
  std::optional<io::Mesh> mesh;
  std::string error;
};

Outcome try_to_read(std::span<const std::byte> bytes, Reader reader, const io::ReaderOptions& options) {
  io::MemorySource source(bytes);
  io::InputBuffer input(source, "fuzz", bytes.size());
  try {
    return {reader(input, options), {}};
  } catch (const Error& error) {
    const std::string_view line = error.what();
    if (error.code() == ErrorCode::InvalidMesh && line.find("fuzz") == std::string_view::npos) {
      fail("the error does not name the file: " + std::string(line));
    }
    if (line.find_first_of("\n\r\x1b") != std::string_view::npos) fail("the error has more than one line");
    return {std::nullopt, error.what()};
  }
}

bool are_equal(const io::Warning& a, const io::Warning& b) {
  return a.what == b.what && a.count == b.count && a.first_place == b.first_place;
}

bool are_equal(const Outcome& a, const Outcome& b) {
  if (!a.mesh || !b.mesh) return a.mesh.has_value() == b.mesh.has_value() && a.error == b.error;
  const auto equal_warnings = [](const io::Warning& x, const io::Warning& y) { return are_equal(x, y); };
  return a.mesh->positions == b.mesh->positions && a.mesh->offsets == b.mesh->offsets &&
         a.mesh->corners == b.mesh->corners && std::ranges::equal(a.mesh->warnings, b.mesh->warnings, equal_warnings);
}

/// Blocks of any size, also tiny ones, must give what the reader gives row by row.
Outcome read_in_blocks(std::span<const std::byte> bytes, Reader reader) {
  Outcome whole = try_to_read(bytes, reader, {});
  for (const std::size_t block : {std::size_t{0}, 1 + bytes.size() % 61}) {
    if (!are_equal(try_to_read(bytes, reader, {{}, block}), whole)) {
      fail("blocks of " + std::to_string(block) + " bytes change the result");
    }
  }
  return whole;
}

test::TestMesh copied(const io::Mesh& mesh) {
  test::TestMesh result;
  result.single_precision = std::holds_alternative<std::vector<float>>(mesh.positions);
  std::visit([&](const auto& xyz) { result.positions.assign(xyz.begin(), xyz.end()); }, mesh.positions);
  result.corners = mesh.corners;
  if (!mesh.offsets.empty()) result.offsets = mesh.offsets;
  while (result.offsets.back() < result.corners.size()) result.offsets.push_back(result.offsets.back() + 3);
  return result.finish(result.single_precision);
}

}  // namespace

void read(std::span<const std::byte> bytes, Reader reader) {
  const std::optional<io::Mesh> mesh = read_in_blocks(bytes, reader).mesh;
  if (!mesh) return;
  validate(mesh->view());
  if (std::max(mesh->view().positions.size(), mesh->corners.size()) > kLarge) return;
  test::Random random(bytes.size());
  judge(copied(*mesh), random, 8);
}

}  // namespace meshhood::fuzz
