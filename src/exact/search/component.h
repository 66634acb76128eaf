// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "exact/layout.h"
#include "exact/node_search.h"
#include "exact/search/home_marks.h"
#include "exact/search/open_elements.h"
#include "exact/search/query.h"
#include "exact/search/reach.h"
#include "exact/vertex_set.h"
#include "simd/kernels.h"

namespace meshhood::inline v0_1 {

/// Finds the component of the query vertex among all that the outward search has reached.
///
/// An edge of the mesh between two vertices reached lies within a whole node, or within a piece of a surface leaf, or
/// is part of a link between two of these. So the component is what links join with the query vertex. Home marks find
/// most of it, and union-find the rest.
class Component {
 public:
  Component(const IndexView& index, const Kernels& kernels)
      : index_(&index), marks_(index, kernels), open_(index, kernels) {}

  /// Marks what is surely connected with the query vertex. This is the first step.
  void mark(const Query& query, Reach& reach) { marks_.spread(query, reach); }

  /// Returns how many surface leaves have vertices in the ball without a mark.
  [[nodiscard]] std::size_t open_leaves() const { return marks_.open_places().size(); }

  /// Completes the marks, and adds the component to `answer`, which is empty. This is the second step.
  void complete(Reach& reach, VertexSet& answer);

 private:
  void add_group(std::uint32_t group, const Reach& reach, std::size_t& place, VertexSet& answer) const;

  const IndexView* index_;
  HomeMarks marks_;
  OpenElements open_;
};

}  // namespace meshhood::inline v0_1
