// SPDX-License-Identifier: MIT
// The ids of all vertices in one array, where what is found while rows are counted is kept for writing them, beside the
// same where each row is searched twice, which a limit of memory causes: there, too, it is kept, and then dropped, so
// that the gain is shown a little too large. On one thread, in alternating rounds, by the exact index and by rings:
// microseconds a vertex, and the ratio.
//
//   bench_kept MESH [RADIUS IN MEAN EDGES...]
#include <cstdint>
#include <cstdio>
#include <memory>
#include <vector>

#include "meshhood/meshhood.h"

#include "mesh_argument.h"
#include "program.h"
#include "rounds.h"

namespace meshhood::bench {
namespace {

void compare(const SearchMethod& method, const char* name, double edges, double radius) {
  const BatchQuery query{.radius = radius};
  std::uint64_t total = 0;
  for (const std::uint64_t size : counts(method, query, {.threads = 1})) total += size;
  const auto list = [&](std::uint64_t max_bytes) {
    return [&, max_bytes] {
      std::unique_ptr<VertexId[]> ids;  // NOLINT(modernize-avoid-c-arrays): a vector would be written twice
      const auto allocate = [&](std::size_t count) -> BatchMemory {
        ids = std::make_unique_for_overwrite<VertexId[]>(count);  // NOLINT(modernize-avoid-c-arrays)
        return {{ids.get(), count}};
      };
      static_cast<void>(neighborhoods(method, query, allocate, {}, {.threads = 1, .max_bytes = max_bytes}));
    };
  };
  const auto [count, once, twice] = fastest<3>({[&] { static_cast<void>(counts(method, query, {.threads = 1})); },
                                                list(Run::kUnlimited), list(total * sizeof(VertexId))});
  const auto size = static_cast<double>(method.vertex_count());
  std::printf("%-6s %6.4g %9.1f %8.3f %8.3f %8.3f %6.2f\n", name, edges, static_cast<double>(total) / size,
              1e6 * count / size, 1e6 * once / size, 1e6 * twice / size, once / twice);
  std::fflush(stdout);
}

int run(const Arguments& arguments) {
  const MeshArgument mesh(arguments[0]);
  const Index index = build(mesh.view());
  const double mean_edge = mean_edge_length(index);
  const std::vector<double> radii = numbers(arguments, 1, {2, 3, 5, 10});
  std::printf("%-6s %6s %9s %8s %8s %8s %6s\n", "", "edges", "vertices", "counts", "once", "twice", "ratio");
  for (const double edges : radii) compare(index, "exact", edges, edges * mean_edge);
  for (const double edges : radii) compare(SearchMethod(index).by(Metric::Rings), "rings", edges, edges);
  return 0;
}

}  // namespace
}  // namespace meshhood::bench

int main(int argc, char** argv) {
  return meshhood::bench::run_program(argc, argv, {"bench_kept MESH [RADIUS IN MEAN EDGES...]", 1},
                                      meshhood::bench::run);
}
