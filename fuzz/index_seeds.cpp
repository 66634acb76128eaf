// SPDX-License-Identifier: MIT
// Writes the first inputs of the index fuzzers: small indexes of every kind, of at most 4 KiB each.
// Usage: index_seeds FOLDER, as build/fuzz/corpus/index; `tools/fuzz --keep` then adds them to the archive.
#include <cstdio>
#include <fstream>
#include <string>

#include "meshhood/reorder.h"

#include "support/families.h"
#include "support/index_bytes.h"

namespace {

using namespace meshhood;

void write(const std::string& folder, const std::string& name, const Index& index, const SaveOptions& options = {}) {
  const std::vector<std::byte> bytes = test::saved(index, options);
  std::ofstream file(folder + "/" + name, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  std::printf("%s: %zu bytes\n", name.c_str(), bytes.size());
}

test::TestMesh grid(std::size_t rows, std::size_t regions, bool single) {
  test::Random random(rows);
  test::TestMesh mesh = test::make_grid(rows, regions, false);
  for (double& x : mesh.positions) x += random.uniform(-0.2, 0.2);
  return mesh.finish(single);
}

void write_all(const std::string& folder) {
  write(folder, "empty", build(MeshView{}));
  write(folder, "one_vertex", build(grid(1, 1, true).view()));
  write(folder, "one_leaf", build(grid(4, 4, true).view()));
  write(folder, "two_leaves", build(grid(6, 7, true).view()));
  write(folder, "double", build(grid(4, 9, false).view()));
  write(folder, "reordered", reorder(grid(6, 8, true).view()).index);
  for (const bool quads : {false, true}) {
    const test::TestMesh mesh = test::make_grid(4, 4, quads).finish(true);
    write(folder, quads ? "quads" : "triangles", build(mesh.view()), {.faces = mesh.view().faces});
  }
  test::TestMesh sheets = grid(4, 5, true);
  test::TestMesh upper = grid(4, 6, true);
  for (std::size_t i = 2; i < upper.positions.size(); i += 3) upper.positions[i] += 0.75;
  append(sheets, upper);
  write(folder, "two_sheets", build(sheets.finish(true).view()));
  test::TestMesh cloud = grid(5, 8, true);
  cloud.corners.clear();
  cloud.offsets = {0};
  write(folder, "cloud", build(cloud.view()));
}

}  // namespace

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) write_all(argv[i]);
  return argc > 1 ? 0 : 2;
}
