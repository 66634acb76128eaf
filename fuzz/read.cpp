// SPDX-License-Identifier: MIT
#include "read.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <variant>

#include "meshhood/error.h"

#include "io/byte_source.h"
#include "io/input_buffer.h"
#include "judge.h"

namespace meshhood::fuzz {
namespace {

constexpr std::size_t kLarge = 300;  // vertices or corners; the oracle would be too slow for more

std::optional<io::Mesh> try_to_read(std::span<const std::byte> bytes, Reader reader) {
  io::MemorySource source(bytes);
  io::InputBuffer input(source, "fuzz", bytes.size());
  try {
    return reader(input, {});
  } catch (const Error& error) {
    const std::string_view line = error.what();
    if (error.code() == ErrorCode::InvalidMesh && line.find("fuzz") == std::string_view::npos) {
      fail("the error does not name the file: " + std::string(line));
    }
    if (line.find_first_of("\n\r\x1b") != std::string_view::npos) fail("the error has more than one line");
    return std::nullopt;
  }
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
  const std::optional<io::Mesh> mesh = try_to_read(bytes, reader);
  if (!mesh) return;
  validate(mesh->view());
  if (std::max(mesh->view().positions.size(), mesh->corners.size()) > kLarge) return;
  test::Random random(bytes.size());
  judge(copied(*mesh), random, 8);
}

}  // namespace meshhood::fuzz
