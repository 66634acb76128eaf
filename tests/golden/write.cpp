// SPDX-License-Identifier: MIT
// Writes the golden files of the current format. Run it once for each format, never to make a test pass: released files
// must stay readable or be refused. Usage: write_golden FOLDER
#include <cstdio>
#include <fstream>

#include "shapes.h"

int main(int argc, char** argv) {
  using namespace meshhood::test;
  if (argc != 2) {
    std::fputs("usage: write_golden FOLDER\n", stderr);
    return 2;
  }
  for (const GoldenShape& shape : golden_shapes()) {
    const std::vector<std::byte> bytes = golden_bytes(shape);
    const std::string path = std::string(argv[1]) + "/" + shape.name + ".mhi";
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!file.flush()) return 5;
    std::printf("%s: %zu bytes\n", path.c_str(), bytes.size());
  }
  return 0;
}
