// SPDX-License-Identifier: MIT
#include "curvature/visit_moments.h"

#include <array>
#include <memory>
#include <utility>

#include "simd/kernels.h"

namespace meshhood::inline v0_1 {
namespace {

/// The state of a thread that sums the moments of packets.
class PacketSummer {
 public:
  PacketSummer(const MomentSource& source, MomentVisitor visitor)
      : index_(source.index), sums_(source, best_isa()), visitor_(std::move(visitor)) {}

  void visit(const PacketAnswer& packet) {
    const std::size_t size = packet.rows.size();
    for (std::size_t i = 0; i < size; ++i) places_[i] = index_->place(packet.vertices[i]);
    const auto places = std::span(places_).first(size);
    const LeafId leaf = leaf_of(index_->slot[packet.vertices.front()]);
    for (QueryWord left = first_lanes(static_cast<unsigned>(size)); left != 0;) {
      const QueryWord queries = sums_.begin(leaf, places, packet.radii, left, packet.queries);
      for (const Piece& piece : packet.pieces) add(piece);
      visitor_({packet.rows, places, packet.radii, queries}, sums_, sums_.finish());
      left &= ~queries;
    }
  }

 private:
  /// In index order, which does not depend on what else is in the packet.
  void add(const Piece& piece) {
    if (!piece.is_run()) return sums_.add(piece.leaves.begin, piece.reached);
    for (LeafId leaf = piece.leaves.begin; leaf < piece.leaves.end; ++leaf) sums_.add(leaf, piece.queries);
  }

  const IndexView* index_;
  PacketMoments sums_;
  MomentVisitor visitor_;
  std::array<std::uint32_t, kPacketCapacity> places_{};
};

}  // namespace

PacketVisitor moment_visitor(const MomentSource& source, MomentVisitor visit) {
  const auto summer = std::make_shared<PacketSummer>(source, std::move(visit));
  return [summer](const PacketAnswer& packet) { summer->visit(packet); };
}

}  // namespace meshhood::inline v0_1
