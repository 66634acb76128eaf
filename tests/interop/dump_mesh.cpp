// SPDX-License-Identifier: MIT
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <span>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "support/shared_meshes.h"

// dump_mesh NAME FOLDER: writes a shared mesh as bytes that any program can read: `plain` (the file itself,
// decompressed) and, as this library reads it, `positions` (float32, #V by 3), `sides` (uint64, #F) and `corners`
// (uint32).

namespace {

using namespace meshhood;

template <class T>
void write(const std::filesystem::path& path, std::span<const T> values) {
  std::ofstream file(path, std::ios::binary);
  const auto bytes = std::as_bytes(values);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

void dump(const std::string& name, const std::filesystem::path& folder) {
  const auto bytes = test::shared_mesh_bytes(name);
  if (!bytes) throw std::runtime_error("no shared mesh " + name);
  const auto mesh = io::read_mesh(*bytes, test::plain_name(name), {.precision = io::Precision::Float});
  std::vector<std::uint64_t> sides;
  mesh.view().faces.for_each(
      [&sides](std::size_t, std::span<const VertexId> corners) { sides.push_back(corners.size()); });
  write<std::byte>(folder / "plain", *bytes);
  write<float>(folder / "positions", std::get<std::vector<float>>(mesh.positions));
  write<std::uint64_t>(folder / "sides", sides);
  write<std::uint32_t>(folder / "corners", mesh.corners);
}

}  // namespace

int main(int argc, char** argv) try {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() != 2) {
    std::fputs("usage: dump_mesh NAME FOLDER\n", stderr);
    return 2;
  }
  dump(arguments[0], arguments[1]);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
