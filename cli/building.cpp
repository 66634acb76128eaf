// SPDX-License-Identifier: MIT
#include "building.h"

#include "progress.h"

namespace meshhood::cli {

template <class Mesh>
Index build_exact_index(const Mesh& mesh, unsigned threads) {
  Progress progress("building the index");
  const auto report = [&](std::size_t done, std::size_t total) {
    progress.report(done, total);
    return true;
  };
  return build(mesh, {.threads = threads, .progress = report});
}

template <class Mesh>
paper::Index build_paper_index(const Mesh& mesh) {
  const Progress progress("building the index of the paper");
  return paper::build(mesh);
}

template Index build_exact_index(const MeshView& mesh, unsigned threads);
template Index build_exact_index(const GraphView& graph, unsigned threads);
template paper::Index build_paper_index(const MeshView& mesh);
template paper::Index build_paper_index(const GraphView& graph);

}  // namespace meshhood::cli
