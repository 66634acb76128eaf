// SPDX-License-Identifier: MIT
#include "curvature/visit_moments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "simd/kernels.h"

namespace meshhood {
namespace {

/// The largest double below `radius`: its closed ball has the vertices nearer than `radius`. Returns NaN and negative
/// radii unchanged; the batch rejects them.
double open_radius(double radius) { return radius > 0 ? std::nextafter(radius, 0.0) : radius; }

bool has_one_radius(const BatchQuery& query) {
  const auto& list = query.radius.list();
  return !list || std::ranges::all_of(*list, [&](double radius) { return radius == list->front(); });
}

/// The state of a thread that sums the moments of packets.
class PacketSummer {
 public:
  PacketSummer(const MomentSource& source, MomentVisitor visitor)
      : index_(source.index), sums_(source, best_isa()), visitor_(std::move(visitor)) {}

  void visit(const PacketAnswer& packet) {
    const std::size_t size = packet.vertices.size();
    for (std::size_t i = 0; i < size; ++i) places_[i] = place_of(*index_, packet.vertices[i]);
    const auto places = std::span(places_).first(size);
    sums_.begin(places, *std::max_element(packet.radii.begin(), packet.radii.end()), packet.queries);
    for (const CoreLeaves& core : packet.cores) {
      for (const LeafRun& run : core.runs) sums_.add(run.vertices.begin, run.vertices.size(), core.queries);
    }
    for (const WholeLeaves& whole : packet.whole) {
      sums_.add(whole.run.vertices.begin, whole.run.vertices.size(), whole.queries);
    }
    for (const PartialLeaf& leaf : packet.partial) {
      sums_.add(leaf.vertices.begin, leaf.vertices.size(), leaf.queries);
    }
    visitor_({packet.rows, packet.queries_of_rows, places, packet.radii}, sums_, sums_.finish());
  }

 private:
  const IndexView* index_;
  PacketMoments sums_;
  MomentVisitor visitor_;
  std::array<std::uint32_t, kPacketCapacity> places_{};
};

}  // namespace

void visit_moments(const Index& index, const BatchQuery& query, bool open_ball, const MomentSource& source,
                   const PacketOptions& options, const std::function<MomentVisitor()>& make_visitor) {
  BatchQuery closed = query;
  std::vector<double> radii;
  if (open_ball && query.radius.list()) {
    for (const double radius : *query.radius.list()) radii.push_back(open_radius(radius));
    closed.radius = radii;
  } else if (open_ball) {
    closed.radius = open_radius(query.radius.common());
  }
  PacketOptions packets = options;
  packets.rows = has_one_radius(closed) ? PacketRows::WholeLeaves : PacketRows::Asked;
  for_each_packet(
      index, closed,
      [&](unsigned) -> PacketVisitor {
        auto summer = std::make_shared<PacketSummer>(source, make_visitor());
        return [summer](const PacketAnswer& packet) { summer->visit(packet); };
      },
      packets);
}

}  // namespace meshhood
