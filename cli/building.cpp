// SPDX-License-Identifier: MIT
#include "building.h"

#include <cstddef>

#include "progress.h"

namespace meshhood::cli {
namespace {

auto on_progress(Progress& progress) {
  return [&progress](std::size_t done, std::size_t total) {
    progress.report(done, total);
    return true;
  };
}

}  // namespace

template <class Mesh>
Index build_exact_index(const Mesh& mesh, unsigned threads) {
  Progress progress("building the index");
  return build(mesh, {.threads = threads, .progress = on_progress(progress)});
}

template <class Mesh>
paper::Index build_paper_index(const Mesh& mesh) {
  Progress progress("building the index of the paper");
  return paper::build(mesh, {.progress = on_progress(progress)});
}

template Index build_exact_index(const MeshView& mesh, unsigned threads);
template Index build_exact_index(const GraphView& graph, unsigned threads);
template paper::Index build_paper_index(const MeshView& mesh);
template paper::Index build_paper_index(const GraphView& graph);

}  // namespace meshhood::cli
