// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "meshhood/meshhood.h"

#include "cli/methods.h"
#include "reordered.h"

namespace meshhood::bench {

/// How long an index took to build, time after time, and what it takes in memory.
struct Build {
  std::string name;
  std::vector<double> seconds;  ///< of processor time, one thread
  std::size_t bytes;
};

/// The methods that may run. Each has an index of its own, so that none finds in the cache what another has read.
///
/// bfs              breadth-first search, the vertices as the mesh has them
/// bfs-reordered    the same on the vertices in index order
/// ball             a scan of all vertices
/// ids, count, ranges   the exact index, by what is asked for
/// paper[,f=10][,levels=5][,discard=2]   the index of the paper
class Contestants {
 public:
  explicit Contestants(const MeshView& mesh) : mesh_(mesh), adjacency_(adjacency(mesh)), order_(build(mesh)) {}

  [[nodiscard]] GraphView graph() const { return {mesh_.positions, adjacency_.view()}; }

  /// The vertices, neighbours near each other.
  [[nodiscard]] std::span<const VertexId> order() const { return order_.permutation(); }
  /// Throws Error{InvalidOption} where no method is called so.
  [[nodiscard]] cli::Method method(const std::string& name);

  /// Builds the exact index and the one of the paper in turn, so many times.
  [[nodiscard]] std::vector<Build> time_builds(int times) const;

 private:
  [[nodiscard]] const Index& another_exact();
  /// The exact index asked for less than ids: `ask(searcher, v, radius)`.
  template <class Ask>
  [[nodiscard]] cli::Method unlisted(const std::string& name, Ask ask);
  [[nodiscard]] cli::Method bfs_reordered();
  [[nodiscard]] cli::Method ids_method();
  [[nodiscard]] cli::Method count_method();
  [[nodiscard]] cli::Method ranges_method();
  [[nodiscard]] cli::Method paper(const std::string& name);

  MeshView mesh_;
  Adjacency adjacency_;
  Index order_;
  std::vector<std::unique_ptr<Index>> exacts_;
  std::unique_ptr<Reordered> reordered_;
  std::vector<std::unique_ptr<paper::Index>> papers_;
};

}  // namespace meshhood::bench
