// SPDX-License-Identifier: MIT
#include <cstdio>
#include <exception>

#include <sys/resource.h>

#include "io/mesh_io.h"

// read_peak FILE: reads a mesh and prints "DECODED BASE PEAK": the bytes of its arrays, and the peak resident memory of
// the process before and after, in bytes.

namespace {

using namespace meshhood;

std::size_t peak_bytes() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

template <class T>
std::size_t bytes(const std::vector<T>& array) {
  return array.size() * sizeof(T);
}

std::size_t decoded_bytes(const io::Mesh& mesh) {
  return std::visit([](const auto& xyz) { return bytes(xyz); }, mesh.positions) + bytes(mesh.offsets) +
         bytes(mesh.corners);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) return 2;
  const auto base = peak_bytes();
  const auto mesh = io::read_mesh(argv[1]);
  std::printf("%zu %zu %zu\n", decoded_bytes(mesh), base, peak_bytes());
  return 0;
} catch (const std::exception& error) {
  const auto peak = peak_bytes();
  std::printf("0 0 %zu\n%s\n", peak, error.what());
  return 1;
}
