// SPDX-License-Identifier: MIT
// One case of the regression guard. guard.py runs it under callgrind and holds the list of cases.
// Usage: guard CASE | --compiler. CASE is build:KIND:SHAPE or METHOD:SHAPE:RADIUS, radii in edges: "ids:scroll:10".
#include <cstdio>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "meshhood/meshhood.h"

#include "exact/query/single_queries.h"
#include "shapes/shapes.h"

/// Only the instructions executed in here are counted: guard.py switches counting by the name of this function.
extern "C" [[gnu::noinline]] void meshhood_guard_measured(const std::function<void()>& work) { work(); }

namespace meshhood::bench {
namespace {

constexpr std::size_t kVertices = 50'000;
constexpr std::size_t kQueries = 40;
constexpr std::size_t kWarming = 5;    // so that buffers have grown before counting begins
constexpr std::size_t kStride = 7919;  // a prime: vertices all over the shape

using Query = std::function<void(VertexId)>;

/// The same kernels on every machine: Valgrind supports nothing above AVX2. None if this processor does not have them.
std::optional<Isa> avx2() {
  for (std::size_t i = 0; i <= static_cast<std::size_t>(best_isa()); ++i) {
    if (name_of(static_cast<Isa>(i)) == std::string_view("AVX2")) return static_cast<Isa>(i);
  }
  return std::nullopt;
}

Searcher searcher_of_avx2(const Index& index) {
  Searcher searcher(index);
  SearcherAccess::set_isa(searcher, avx2().value());
  return searcher;
}

void count_queries(const Query& query) {
  const auto vertex = [](std::size_t i) { return static_cast<VertexId>(i * kStride % kVertices); };
  for (std::size_t i = 0; i < kWarming; ++i) query(vertex(kQueries + i));
  meshhood_guard_measured([&] {
    for (std::size_t i = 0; i < kQueries; ++i) query(vertex(i));
  });
}

void count_exact(const std::string& method, const MeshView& mesh, double radius) {
  const Index index = build(mesh);
  Searcher searcher = searcher_of_avx2(index);
  std::vector<VertexId> out;
  if (method == "ids") count_queries([&](VertexId v) { searcher.neighborhood(v, radius, out); });
  if (method == "count") count_queries([&](VertexId v) { static_cast<void>(searcher.count(v, radius)); });
  if (method == "ranges") count_queries([&](VertexId v) { static_cast<void>(searcher.ranges(v, radius)); });
}

void count_paper(const MeshView& mesh, double radius) {
  const paper::Index index = paper::build(mesh);
  paper::Searcher searcher(index);
  std::vector<VertexId> out;
  count_queries([&](VertexId v) { searcher.neighborhood(v, radius, out); });
}

void count_reference(const MeshView& mesh, double radius) {
  ReferenceSearcher searcher(mesh);
  std::vector<VertexId> out;
  count_queries([&](VertexId v) { searcher.neighborhood(v, radius, out); });
}

void count_build(const std::string& kind, const MeshView& mesh) {
  meshhood_guard_measured([&] {
    if (kind == "exact") static_cast<void>(build(mesh, {.threads = 1}));
    if (kind == "paper") static_cast<void>(paper::build(mesh));
  });
}

struct Case {
  std::string method;
  std::string middle;  // the index that is built, or the shape
  std::string last;    // the shape, or the radius

  explicit Case(const std::string& name) {
    const auto first = name.find(':');
    const auto second = name.find(':', first + 1);
    if (second == std::string::npos) throw std::invalid_argument(name + ": expected METHOD:SHAPE:RADIUS");
    method = name.substr(0, first);
    middle = name.substr(first + 1, second - first - 1);
    last = name.substr(second + 1);
  }
};

shapes::Shape make(const std::string& kind) { return shapes::find_kind(kind)->make(kVertices); }

void run(const Case& c) {
  if (c.method == "build") return count_build(c.middle, make(c.last).view());
  const shapes::Shape shape = make(c.middle);
  const double radius = std::stod(c.last);
  if (c.method == "paper") return count_paper(shape.view(), radius);
  if (c.method == "reference") return count_reference(shape.view(), radius);
  count_exact(c.method, shape.view(), radius);
}

}  // namespace
}  // namespace meshhood::bench

int main(int arguments, char** values) {
  using namespace meshhood;
  if (arguments != 2) return 2;
  const std::string argument = values[1];
#if defined(__clang__)
  constexpr const char* kCompiler = __VERSION__;
#else
  constexpr const char* kCompiler = "g++ " __VERSION__;
#endif
  if (argument == "--compiler") return std::puts(kCompiler) < 0 ? 1 : 0;
  constexpr int kSkipped = 77;
  if (!bench::avx2()) {
    std::puts("skipped: the baseline counts AVX2 instructions, which this processor does not have");
    return kSkipped;
  }
  bench::run(bench::Case(argument));
  return 0;
}
