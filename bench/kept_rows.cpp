// SPDX-License-Identifier: MIT
// Answers each line "FIRST ROWS RADIUS" of the input by a line: the microseconds a row, of processor time, in which one
// thread writes the neighborhoods of ROWS consecutive vertices from FIRST on into one array. bench/kept_rows.py answers
// the same lines from Python, so that the two can be called in turn.
//
//   kept_rows INDEX
#include <cstdio>
#include <iostream>
#include <memory>
#include <numeric>
#include <vector>

#include "meshhood/meshhood.h"

#include "io/index_io.h"
#include "measure/timing.h"
#include "program.h"

namespace meshhood::bench {
namespace {

double microseconds(const Index& index, const std::vector<VertexId>& rows, double radius) {
  std::unique_ptr<VertexId[]> ids;  // NOLINT(modernize-avoid-c-arrays): a vector would be written twice
  const auto allocate = [&](std::size_t count) -> BatchMemory {
    ids = std::make_unique_for_overwrite<VertexId[]>(count);  // NOLINT(modernize-avoid-c-arrays)
    return {{ids.get(), count}};
  };
  const double start = measure::processor_time();
  const auto offsets = neighborhoods(index, {.vertices = rows, .radius = radius}, allocate, {}, {.threads = 1});
  return 1e6 * (measure::processor_time() - start) / static_cast<double>(rows.size());
}

int run(const Arguments& arguments) {
  const Index index = io::load(arguments[0]);
  VertexId first = 0;
  std::size_t count = 0;
  double radius = 0;
  while (std::cin >> first >> count >> radius) {
    std::vector<VertexId> rows(count);
    std::iota(rows.begin(), rows.end(), first);
    std::printf("%.6f\n", microseconds(index, rows, radius));
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace meshhood::bench

int main(int argc, char** argv) {
  return meshhood::bench::run_program(argc, argv, {"kept_rows INDEX < LINES", 1, 1}, meshhood::bench::run);
}
