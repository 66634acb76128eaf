// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "aggregate/node_tree.h"
#include "aggregate/packet_reducer.h"
#include "aggregate/sums.h"
#include "simd/aggregate.h"

namespace meshhood {

/// Sum and mean with weights that fall with the distance. These are polynomials of its square, so the sum over a node
/// follows from moments of the values over the node (see `AggregateKernels::add_moments`).
class KernelSumReduction final : public Reduction {
 public:
  /// `squared`: the biweight, else Epanechnikov. Borrows index and tree.
  KernelSumReduction(const IndexView& index, const NodeTree& tree, const AggregateKernels& kernels, SumColumns columns,
                     bool squared);

  [[nodiscard]] std::unique_ptr<PacketReducer> make_reducer() const override;

  [[nodiscard]] const IndexView& index() const { return *index_; }
  [[nodiscard]] const NodeTree& tree() const { return *tree_; }
  [[nodiscard]] const AggregateKernels& kernels() const { return *kernels_; }
  [[nodiscard]] const SumColumns& columns() const { return columns_; }
  [[nodiscard]] const Moments& moments(std::size_t column, NodeTree::Node node) const { return moments_[column][node]; }
  [[nodiscard]] bool squared() const { return squared_; }

  /// Whether few values of the node are much larger than the others, in one of the columns.
  [[nodiscard]] bool is_uneven(NodeTree::Node node) const { return uneven_[node]; }

 private:
  void mark_uneven(const Column& column);

  const IndexView* index_;
  const NodeTree* tree_;
  const AggregateKernels* kernels_;
  SumColumns columns_;
  bool squared_;
  std::vector<std::vector<Moments>> moments_;  // by column, then by node
  std::vector<bool> uneven_;                   // by node
};

}  // namespace meshhood
