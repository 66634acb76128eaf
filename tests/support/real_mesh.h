// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/meshhood.h"

#include "support/paper_bounds.h"
#include "support/random.h"

namespace meshhood::test {

/// The component of every vertex, named by its first vertex.
inline std::vector<VertexId> components(ReferenceSearcher& reference) {
  const std::size_t vertices = reference.adjacency().size();
  std::vector<VertexId> label(vertices, static_cast<VertexId>(-1));
  std::vector<VertexId> component;
  for (std::size_t v = 0; v < vertices; ++v) {
    if (label[v] != static_cast<VertexId>(-1)) continue;
    reference.neighborhood(static_cast<VertexId>(v), std::numeric_limits<double>::infinity(), component);
    for (const VertexId w : component) label[w] = static_cast<VertexId>(v);
  }
  return label;
}

/// A mesh too large for the oracle: compares the paper's answers with the reference, which other tests compare with it.
class RealMesh {
 public:
  explicit RealMesh(const MeshView& mesh, const paper::BuildOptions& options = {})
      : mesh_(mesh),
        reference_(mesh),
        index_(paper::build(mesh, options)),
        searcher_(index_),
        component_(components(reference_)),
        bounds_(component_.size()),
        mean_edge_(mean_edge_length({mesh.positions, reference_.adjacency()})) {
    EXPECT_THAT(index_.check(GraphView{mesh.positions, reference_.adjacency()}), testing::IsEmpty());
  }

  struct Tally {
    std::size_t queries = 0;
    std::size_t exact = 0;  ///< vertices in all answers
    std::size_t extra = 0;  ///< in the paper's answers but not in the exact ones
    std::size_t mismatches = 0;
  };

  /// Queries of `queries` random vertices at a radius of `edges` mean edge lengths.
  void query(double edges, std::size_t queries, Random& random) {
    for (std::size_t i = 0; i < queries && !component_.empty(); ++i) {
      query(static_cast<VertexId>(random.below(component_.size())), edges * mean_edge_);
    }
  }

  void query(VertexId v, double radius) {
    reference_.neighborhood(v, radius, exact_);
    searcher_.neighborhood(v, radius, answer_);
    const auto inside = [&](VertexId w) {
      return component_[w] == component_[v] && distance(mesh_.positions, v, w) <= radius;
    };
    const bool right = bounds_.holds(exact_, answer_, inside) && searcher_.count(v, radius) == answer_.size();
    EXPECT_TRUE(right) << "vertex " << v << ", radius " << radius;
    ++tally_.queries;
    tally_.exact += exact_.size();
    tally_.extra += answer_.size() - exact_.size();
    tally_.mismatches += static_cast<std::size_t>(!right);
  }

  [[nodiscard]] const Tally& tally() const { return tally_; }
  [[nodiscard]] const paper::Index& index() const { return index_; }

 private:
  MeshView mesh_;
  ReferenceSearcher reference_;
  paper::Index index_;
  paper::Searcher searcher_;
  std::vector<VertexId> component_;
  PaperBounds bounds_;
  double mean_edge_;
  std::vector<VertexId> exact_;
  std::vector<VertexId> answer_;
  Tally tally_;
};

}  // namespace meshhood::test
