// SPDX-License-Identifier: MIT
// `PathKernels` is compiled once for each target; see lanes-inl.h. Sums are rounded one by one, as those of a search
// from one vertex are, and lengths are neither NaN nor negative.
#include <cstddef>
#include <cstdint>
#include <span>

#include "simd/joint.h"
#include "simd/leaf.h"

#define HWY_TARGET_INCLUDE "simd/path_kernels.cpp"
#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace meshhood::inline v0_1::HWY_NAMESPACE {
namespace {

std::uint32_t follow_edges(const PathLengths& from, std::span<const PathEdge> edges, PathLengths* all) {
  const Doubles d;
  std::uint32_t shorter = 0;
  for (std::size_t edge = 0; edge < edges.size(); ++edge) {
    PathLengths& to = all[edges[edge].end];
    const auto length = splat(edges[edge].length);
    auto any = hn::MaskFromVec(hn::Zero(d));
    // Whether a path is shorter cannot be predicted, so there is no branch.
    for (std::size_t i = 0; i < kPacketCapacity; i += kLanes<Doubles>) {
      const auto through = hn::Add(load(from[i]), length);
      const auto before = load(to[i]);
      const auto is_shorter = hn::Lt(through, before);
      store(either(d, is_shorter, through, before), to[i]);
      any = hn::Or(any, is_shorter);
    }
    shorter |= std::uint32_t{bits_of(d, any) != 0} << edge;
  }
  return shorter;
}

QueryWord within_limits(const PathLengths& lengths, const PathLengths& limits) {
  const Doubles d;
  QueryWord within = 0;
  for (std::size_t i = 0; i < kPacketCapacity; i += kLanes<Doubles>) {
    within |= bits_of(d, hn::Le(load(lengths[i]), load(limits[i]))) << i;
  }
  return within;
}

constexpr PathKernels kPathKernels{follow_edges, within_limits};

}  // namespace
}  // namespace meshhood::inline v0_1::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
const meshhood::PathKernels& meshhood::path_kernels(Isa isa) { return MESHHOOD_TABLE(kPathKernels, isa); }
#endif
