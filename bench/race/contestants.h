// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "meshhood/meshhood.h"

#include "radius_table.h"
#include "reordered.h"

namespace meshhood::bench {

/// The times of several builds of an index, and its memory.
struct Build {
  std::string name;
  std::vector<double> seconds;  ///< processor time, one thread
  std::size_t bytes;
};

/// The methods to compare. Each has an index of its own, so that no method finds data in the cache that another has
/// read.
///
/// bfs                  breadth-first search, with the vertex numbering of the mesh
/// bfs-reordered        the same with the vertices in index order
/// ball                 a scan of all vertices
/// ids, count, ranges   the exact index, with this kind of answer
/// before, before-count   the exact index of another commit, if there is one (bench/before/build)
/// paper[,f=10][,levels=5][,discard=2]   the index of the paper
class Contestants {
 public:
  explicit Contestants(const MeshView& mesh) : mesh_(mesh), adjacency_(adjacency(mesh)), order_(build(mesh)) {}

  [[nodiscard]] GraphView graph() const { return {mesh_.positions, adjacency_.view()}; }

  /// The vertices in an order that keeps neighbors close.
  [[nodiscard]] std::span<const VertexId> order() const { return order_.permutation(); }

  /// Throws Error{InvalidOption} if there is no method `name`.
  [[nodiscard]] Contestant method(const std::string& name);

  /// Builds both indexes alternately, `times` times.
  [[nodiscard]] std::vector<Build> time_builds(int times) const;

 private:
  [[nodiscard]] const Index& another_exact();
  /// The exact index with an answer other than ids: `query(searcher, v, radius)`.
  template <class Query>
  [[nodiscard]] Contestant unlisted(const std::string& name, Query query);
  [[nodiscard]] Contestant ball() const;
  [[nodiscard]] Contestant bfs_reordered();
  [[nodiscard]] Contestant before_method(const std::string& name);
  [[nodiscard]] Contestant ids_method();
  [[nodiscard]] Contestant count_method();
  [[nodiscard]] Contestant ranges_method();
  [[nodiscard]] Contestant paper(const std::string& name);

  MeshView mesh_;
  Adjacency adjacency_;
  Index order_;
  std::vector<std::unique_ptr<Index>> exacts_;
  std::unique_ptr<Reordered> reordered_;
  std::vector<std::unique_ptr<paper::Index>> papers_;
};

}  // namespace meshhood::bench
