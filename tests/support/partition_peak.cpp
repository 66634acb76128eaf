// SPDX-License-Identifier: MIT
#include <cstdio>
#include <cstdlib>
#include <exception>

#include <sys/resource.h>

#include "parts/partition.h"

// partition_peak MESH FOLDER PARTS MEMORY: partitions a mesh with a halo of 5 edges and prints "BASE PEAK": the peak
// resident memory of the process before and after, in bytes.

namespace {

std::size_t peak_bytes() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 5) return 2;
  const std::size_t base = peak_bytes();
  const auto mesh = meshhood::parts::open_mesh(argv[1], 0);
  const auto result = meshhood::parts::partition(*mesh, argv[2],
                                                 {.parts = std::strtoull(argv[3], nullptr, 10),
                                                  .halo = 5,
                                                  .halo_in_edges = true,
                                                  .memory = std::strtoull(argv[4], nullptr, 10)});
  std::printf("%zu %zu\n", base, peak_bytes());
  return 0;
} catch (const std::exception& error) {
  std::printf("0 0 %s\n", error.what());
  return 1;
}
