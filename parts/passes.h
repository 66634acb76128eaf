// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "meshhood/error.h"
#include "meshhood/run.h"

#include "parts/chunked_mesh.h"
#include "parts/cut_tree.h"
#include "shared/distance.h"

/// Passes over the vertices of a chunked mesh, with progress.
namespace meshhood::parts {

/// The progress of a run in stages: each stage has a share of the whole.
class Stages {
 public:
  explicit Stages(const Progress& progress) : progress_(progress) { report(0); }

  /// Begins a stage, at whose end `share` of the whole is done.
  void begin(double share) {
    begin_ = end_;
    end_ = share;
    report(0);
  }

  void report(double fraction) {
    done_ = std::max(done_, static_cast<std::size_t>(kTotal * (begin_ + (end_ - begin_) * std::min(1.0, fraction))));
    if (progress_ && !progress_(done_, kTotal)) raise(ErrorCode::Cancelled, "cancelled");
  }

  void report(std::uint64_t done, std::uint64_t total) {
    report(total == 0 ? 1.0 : static_cast<double>(done) / static_cast<double>(total));
  }

 private:
  static constexpr std::size_t kTotal = 10'000;

  const Progress& progress_;
  double begin_ = 0;
  double end_ = 0;
  std::size_t done_ = 0;
};

/// Calls `f(first, positions)` for all vertices, a chunk at a time.
template <class F>
void for_each_vertex_chunk(ChunkedMesh& mesh, Stages& stages, F&& f) {
  constexpr std::uint64_t kVertexChunk = std::uint64_t{1} << 16;  // fixed, because the content hash depends on it
  std::vector<Point> positions;
  for (std::uint64_t first = 0; first < mesh.vertex_count(); first += positions.size()) {
    positions.resize(static_cast<std::size_t>(std::min(kVertexChunk, mesh.vertex_count() - first)));
    mesh.read_positions(first, positions);
    f(first, std::span<const Point>(positions));
    stages.report(first + positions.size(), mesh.vertex_count());
  }
}

/// The same for single vertices: `f(site)`.
template <class F>
void for_each_vertex(ChunkedMesh& mesh, Stages& stages, F&& f) {
  for_each_vertex_chunk(mesh, stages, [&](std::uint64_t first, std::span<const Point> positions) {
    for (std::size_t i = 0; i < positions.size(); ++i) f(Site{positions[i], first + i});
  });
}

}  // namespace meshhood::parts
