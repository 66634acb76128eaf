// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "meshhood/batch.h"

#include "curvature/packet_moments.h"
#include "simd/moments.h"

namespace meshhood::inline v0_1 {

/// The places in index order of the vertices of the neighborhood of the one at `place`. They ascend.
inline void find_places(Searcher& searcher, const IndexView& index, std::uint32_t place, double radius,
                        std::vector<std::uint32_t>& found) {
  found.clear();
  for (const VertexRange& range : searcher.ranges(index.id(place), radius)) {
    for (VertexId i = range.begin; i < range.end; ++i) found.push_back(i);
  }
}

/// The moments of one neighborhood from the offsets of its vertices from the query vertex. Slower than `PacketMoments`,
/// but accurate where the vertices of a leaf are much farther apart than the radius. One object a thread.
class DirectMoments {
 public:
  /// Borrows what `source` names, which has no filter. `index` is that of `source`.
  DirectMoments(const Index& index, const MomentSource& source) : searched_(&index), source_(source) {}

  /// Sums the neighborhood of the vertex at `place` in index order.
  void sum(std::uint32_t place, double radius);

  /// The moments about the query vertex, those of query 0, in the unit of `scale()`. Valid until the next `sum`.
  [[nodiscard]] const QueryMoments& moments() const { return moments_; }
  [[nodiscard]] double scale() const { return scale_; }
  /// Weights were multiplied by two to this power.
  [[nodiscard]] int weight_exponent() const { return weight_exponent_; }

 private:
  [[nodiscard]] Point offset(std::uint32_t i, const Point& center) const;
  void set_units(const Point& center);

  const Index* searched_;
  MomentSource source_;
  std::optional<Searcher> searcher_;
  std::vector<std::uint32_t> found_;
  double scale_ = 1;
  int weight_exponent_ = 0;
  MomentPoints points_{};
  QueryMoments moments_{};
};

}  // namespace meshhood::inline v0_1
