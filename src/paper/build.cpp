// SPDX-License-Identifier: MIT
// Runs the level loop of sec. 3.2, and its steps in our order: create and select in select.cpp, fusion in fusion.cpp,
// link in link.cpp. The spheres of step 3 come last, in `keep`, by `enclose` in hierarchy.cpp.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "meshhood/error.h"
#include "meshhood/paper.h"

#include "base/packed_positions.h"
#include "paper/draft.h"
#include "paper/hierarchy.h"
#include "shared/parallel.h"
#include "shared/text.h"

namespace meshhood::inline v0_1::paper {
namespace {

void check_options(const BuildOptions& options) {
  if (options.levels < 1) {
    raise(ErrorCode::InvalidOption, "levels is " + std::to_string(options.levels) + ", expected at least 1");
  }
  if (options.discard < 0) {
    raise(ErrorCode::InvalidOption, "discard is " + std::to_string(options.discard) + ", expected at least 0");
  }
  if (!std::isfinite(options.fusion_growth) || options.fusion_growth < 0) {
    raise(ErrorCode::InvalidOption,
          "fusion_growth is " + to_text(options.fusion_growth) + ", expected a finite number >= 0");
  }
}

/// Returns an upper bound, as the number of levels is not known in advance. Each has four steps, and one for its
/// spheres.
std::size_t max_steps(const BuildOptions& options) {
  return 5 * static_cast<std::size_t>(std::min(options.levels, BuildOptions::kAllLevels));
}

template <class Real>
DraftLevel base_level(std::span<const Real> xyz, const AdjacencyView& graph) {
  DraftLevel level;
  level.siblings = graph;
  level.vertex_count.assign(graph.size(), 1);
  level.position_sum.reserve(graph.size());
  for (std::size_t v = 0; v < graph.size(); ++v) level.position_sum.push_back(point(xyz, v));
  return level;
}

/// Returns whether each component is a single cluster. Deviation: the paper continues until the whole mesh is one
/// cluster, which never happens on a mesh of several components.
bool is_complete(const DraftLevel& level) { return level.siblings.neighbors.empty(); }

/// Discards the lowest levels (4.1) and computes the spheres of the others. Deviation: spheres are computed last, once
/// for each cluster that is kept, because fusion would change them.
template <class Real>
Hierarchy<Real> keep(std::span<const Real> xyz, const std::vector<DraftLevel>& levels,
                     const std::vector<std::vector<ClusterId>>& parents, int discard, TaskContext& task) {
  std::vector<AdjacencyView> siblings;
  siblings.reserve(levels.size());
  for (const DraftLevel& level : levels) siblings.push_back(level.siblings);
  const std::size_t lowest = std::min(static_cast<std::size_t>(discard), levels.size() - 1);
  Hierarchy<Real> hierarchy = arrange(xyz, parents, siblings, lowest);
  for (Level<Real>& level : hierarchy.levels) {
    task.step();
    enclose<Real>(hierarchy.positions, level);
  }
  return hierarchy;
}

template <class Real>
Hierarchy<Real> compute(std::span<const Real> xyz, const AdjacencyView& graph, const BuildOptions& options,
                        const Run& run) {
  std::vector<DraftLevel> levels;
  levels.push_back(base_level(xyz, graph));
  std::vector<std::vector<ClusterId>> parents;
  double threshold = 1;
  TaskContext task(1, run.progress, max_steps(options));
  while (!is_complete(levels.back()) && static_cast<int>(levels.size()) < options.levels) {
    const DraftLevel& below = levels.back();
    threshold *= options.fusion_growth;

    std::vector<VertexId> candidates = create(below);
    task.step();
    Partition partition = select(below, std::move(candidates));
    task.step();
    fuse(below, threshold, partition);
    task.step();
    DraftLevel level = link(below, partition);
    task.step();

    parents.push_back(std::move(partition.parent));
    levels.push_back(std::move(level));
  }
  Hierarchy<Real> hierarchy = keep(xyz, levels, parents, options.discard, task);
  task.finish();
  return hierarchy;
}

/// Returns whether all radii are surely finite as float.
bool fits_float_spheres(std::span<const float> xyz) {
  return std::all_of(xyz.begin(), xyz.end(), [](float x) { return std::abs(x) <= 0x1p125F; });
}

AnyHierarchy compute_any(std::span<const double> xyz, const AdjacencyView& graph, const BuildOptions& options,
                         const Run& run) {
  return compute(xyz, graph, options, run);
}

AnyHierarchy compute_any(std::span<const float> xyz, const AdjacencyView& graph, const BuildOptions& options,
                         const Run& run) {
  if (fits_float_spheres(xyz)) return compute(xyz, graph, options, run);
  const std::vector<double> wide(xyz.begin(), xyz.end());
  return compute<double>(wide, graph, options, run);
}

/// `graph` and `options` must be valid.
Index make_index(const GraphView& graph, const BuildOptions& options, const Run& run) {
  AnyHierarchy hierarchy = graph.positions.visit([&]<class Real>(const StridedPositions<Real>& xyz) {
    return compute_any(PackedPositions<Real>(xyz).view(), graph.adjacency, options, run);
  });
  return IndexAccess::make(std::move(hierarchy), fingerprint(graph));
}

}  // namespace

Index build(const GraphView& graph, const BuildOptions& options, const Run& run) {
  check_options(options);
  validate(graph);
  return make_index(graph, options, run);
}

Index build(const MeshView& mesh, const BuildOptions& options, const Run& run) {
  check_options(options);
  const Adjacency graph = adjacency(mesh);
  return make_index({mesh.positions, graph.view()}, options, run);
}

}  // namespace meshhood::inline v0_1::paper
