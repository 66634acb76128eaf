// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <utility>

#include "aggregate/node_tree.h"
#include "exact/joint/packet_answer.h"
#include "simd/joint.h"

namespace meshhood {

/// Reduces the neighborhoods of a packet, on one thread.
class PacketReducer {
 public:
  PacketReducer() = default;
  PacketReducer(const PacketReducer&) = delete;
  PacketReducer& operator=(const PacketReducer&) = delete;
  virtual ~PacketReducer() = default;

  /// Begins with the rows of another packet.
  virtual void begin(const PacketAnswer& packet) = 0;

  /// Whether it takes whole nodes. If not, all vertices are passed to `add_leaf`, in index order.
  [[nodiscard]] virtual bool takes_nodes() const { return true; }

  /// Adds all vertices of each of up to eight nodes, which are neighbors, to the rows of its word.
  virtual void add_nodes(const NodeTree::Children& /*nodes*/, const QueryWord* /*queries*/) {}

  /// Adds each vertex of a leaf, of which rows may have all, to the rows of its word.
  virtual void add_leaf(const VertexRange& vertices, const QueryWord* queries) = 0;

  /// Writes the result of a row, a number for each channel, or for each of its reductions. Called after everything has
  /// been added.
  virtual void write(std::size_t row, std::span<double> channels) = 0;
};

/// Makes the reducer of a thread. Any thread may call it.
using Reduction = std::function<std::unique_ptr<PacketReducer>()>;

/// Makes reducers of one kind, which share tables.
template <class Reducer, class Tables>
[[nodiscard]] Reduction reduction_of(Tables tables) {
  return [shared = std::make_shared<const Tables>(std::move(tables))] { return std::make_unique<Reducer>(*shared); };
}

}  // namespace meshhood
