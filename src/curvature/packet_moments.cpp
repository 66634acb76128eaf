// SPDX-License-Identifier: MIT
#include "curvature/packet_moments.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "base/vector.h"

namespace meshhood {
namespace {

MomentSizes sizes_of(const QueryMoments& moments, std::size_t query) {
  const auto at = [&](std::size_t i, std::size_t j, std::size_t k) { return moments.at[moment_index(i, j, k)][query]; };
  return {(at(2, 0, 0) + at(0, 2, 0)) + at(0, 0, 2),
          (at(4, 0, 0) + at(0, 4, 0)) + at(0, 0, 4) + 2 * ((at(2, 2, 0) + at(0, 2, 2)) + at(2, 0, 2))};
}

}  // namespace

PacketMoments::PacketMoments(const MomentSource& source, Isa isa)
    : source_(source),
      kernels_(&moment_kernels(isa)),
      offsets_{},
      facing_{},
      waiting_common_{},
      waiting_some_{},
      points_{},
      common_{},
      some_{},
      moments_{} {}

void PacketMoments::begin(std::span<const std::uint32_t> places, double reach, QueryWord queries) {
  size_ = places.size();
  active_ = first_lanes(static_cast<unsigned>(size_)) & queries;
  if (source_.filter != nullptr) set_normals(places);
  for (std::size_t q = 0; q < size_; ++q) {
    const Point p = std::visit([&](auto xyz) { return point(xyz, places[q]); }, source_.index->positions);
    offsets_.x[q] = p.x;
    offsets_.y[q] = p.y;
    offsets_.z[q] = p.z;
  }
  set_center(reach);
  common_ = {};
  some_ = {};
  waiting_common_.size = 0;
  waiting_some_.size = 0;
}

void PacketMoments::set_normals(std::span<const std::uint32_t> places) {
  for (std::size_t q = 0; q < size_; ++q) {
    const Point n = source_.filter->normal(places[q]);
    if (std::isnan(n.x)) active_ &= ~(QueryWord{1} << q);
    facing_.set(q, n);
  }
  set_axis();
}

/// The center is that of the box around the query vertices.
void PacketMoments::set_center(double reach) {
  double extent = std::min(reach * source_.index->frame.scale, 4.0);  // the mesh has no larger one
  const auto middle = [&](QueryRow& row) {
    const auto [low, high] = std::minmax_element(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(size_));
    extent = std::max(extent, (*high - *low) * source_.index->frame.scale);
    return *low + (*high - *low) / 2;
  };
  center_ = {middle(offsets_.x), middle(offsets_.y), middle(offsets_.z)};
  scale_ = unit_factor(extent, source_.index->frame);
  for (std::size_t q = 0; q < size_; ++q) {
    offsets_.x[q] = (center_.x - offsets_.x[q]) * scale_;
    offsets_.y[q] = (center_.y - offsets_.y[q]) * scale_;
    offsets_.z[q] = (center_.z - offsets_.z[q]) * scale_;
  }
}

/// If all normals of the queries make at most the angle t with an axis, a normal that makes less than 90 degrees - t
/// with it faces all of them.
void PacketMoments::set_axis() {
  Point sum{0, 0, 0};
  const auto normal = [&](std::size_t q) {
    return Point{facing_.normals.x[q], facing_.normals.y[q], facing_.normals.z[q]};
  };
  for_each_lane(active_, [&](unsigned q) { sum = sum + normal(q); });
  facing_.axis = sum;
  facing_.all = 2;
  const double size = length(sum);
  if (!(size > 0)) return;
  facing_.axis = (1 / size) * sum;
  double least = 1;
  for_each_lane(active_, [&](unsigned q) { least = std::min(least, dot(facing_.axis, normal(q))); });
  if (least > 0) facing_.all = static_cast<float>(std::sqrt(std::max(0.0, 1 - least * least))) + 2 * kFacingMargin;
}

void PacketMoments::add(std::size_t first, std::size_t size, QueryWord word) {
  add_leaves(first, size, [word](std::size_t) { return word; });
}

void PacketMoments::add(std::size_t first, std::size_t size, std::span<const QueryWord, kPacketCapacity> words) {
  add_leaves(first, size, [words](std::size_t i) { return words[i]; });
}

template <class WordOf>
void PacketMoments::add_leaves(std::size_t first, std::size_t size, const WordOf& word_of) {
  if (active_ == 0) return;
  std::array<QueryWord, kLeafCapacity> words;
  for (std::size_t begin = 0; begin < size; begin += words.size()) {
    const auto leaf = std::span(words).first(std::min(size - begin, words.size()));
    for (std::size_t i = 0; i < leaf.size(); ++i) leaf[i] = word_of(begin + i) & active_;
    if (source_.filter != nullptr) {
      const SurfaceState& surface = *source_.filter;
      const std::size_t at = first + begin;
      kernels_->keep_facing({&surface.normal_x[at], &surface.normal_y[at], &surface.normal_z[at]}, facing_, leaf);
    }
    if (waiting_common_.size + leaf.size() > VertexList::kCapacity) add_common();
    if (waiting_some_.size + leaf.size() > VertexList::kCapacity) add_some();
    kernels_->append(static_cast<std::uint32_t>(first + begin), leaf, active_, waiting_common_, waiting_some_);
  }
}

/// Vertices that count for all queries are added once, about the center of the packet.
void PacketMoments::add_common() {
  const auto places = std::span(waiting_common_.places).first(waiting_common_.size);
  set_points(places);
  // Not the weights alone: what an earlier packet left there may be infinite.
  for (std::size_t i = places.size(); i % PartialMoments::kParts != 0; ++i) points_.set(i, {0, 0, 0}, 0);
  kernels_->add_powers(points_, places.size(), common_);
  waiting_common_.size = 0;
}

void PacketMoments::add_some() {
  const std::size_t size = waiting_some_.size;
  set_points(std::span(waiting_some_.places).first(size));
  kernels_->add_powers_by_word(points_, std::span(waiting_some_.words).first(size), some_);
  waiting_some_.size = 0;
}

void PacketMoments::set_points(std::span<const std::uint32_t> places) {
  std::visit(
      [&](auto xyz) {
        for (std::size_t i = 0; i < places.size(); ++i) {
          const double weight = source_.weights.empty() ? 1 : source_.weights[places[i]];
          points_.set(i, scale_ * (point(xyz, places[i]) - center_), weight);
        }
      },
      source_.index->positions);
}

const QueryMoments& PacketMoments::finish() {
  add_common();
  add_some();
  kernels_->collect(common_, some_, moments_);
  // What is common to the active queries is not of the others: those of walls and, with a filter, without a normal.
  for_each_lane(first_lanes(static_cast<unsigned>(size_)) & ~active_, [&](unsigned q) {
    for (auto& sums : moments_.at) sums[q] = 0;
  });
  for (std::size_t q = 0; q < size_; ++q) sizes_[q] = sizes_of(moments_, q);
  kernels_->shift(moments_, offsets_);
  for (std::size_t q = 0; q < size_; ++q) {
    const MomentSizes after = sizes_of(moments_, q);
    is_accurate_[q] = is_accurate(q, sizes_[q], after);
    sizes_[q] = {std::max(sizes_[q].second, after.second), std::max(sizes_[q].fourth, after.fourth)};
  }
  return moments_;
}

// With p the offset of a vertex from the query vertex, and t that of the center, the moments of degree d are sums about
// the center whose terms, and those of the shift, are at most B_d = sum of w (|p - t| + |t|)^d in all. Their errors are
// epsilon B_d times a number that was measured to be at most 4, and less than 1 where B_d is large; so the result is
// accurate to 1e-13 of A_d = sum of w |p|^d if B_d <= K A_d with K = 400. By the inequality of Minkowski,
//   B_2 <= (S_2^(1/2) + |t| W^(1/2))^2 and B_4 <= (S_4^(1/4) + |t| W^(1/4))^4, where S_d = sum of w |p - t|^d,
// and log A_d and log B_d are convex in d (Lyapunov), so A_1 >= A_2 (A_2 / A_4)^(1/2), A_3 >= A_2 (A_2 / W)^(1/2),
// B_1 <= (W B_2)^(1/2) and B_3 <= (B_2 B_4)^(1/2). So B_4 <= K A_4 and W B_2 B_4 <= K^2 A_2^3 are enough: the latter is
// the condition for d = 3, from which those for d = 1 and d = 2 follow, since B_4 >= A_4 and W B_4 >= B_2^2. All is
// divided by W here, so that nothing underflows. Where digits were lost, the computed A_4 is at most about
// epsilon B_4, and the test fails, too.
bool PacketMoments::is_accurate(std::size_t query, const MomentSizes& before, const MomentSizes& after) const {
  constexpr double kMostLoss = 400;
  constexpr double kLeastWeight = 0x1p-800;  // products of smaller weights and powers may underflow
  const double weight = moments_.at[moment_index(0, 0, 0)][query];
  if (weight == 0) return true;  // of no vertex
  if (!(weight >= kLeastWeight)) return false;
  const double t2 = (offsets_.x[query] * offsets_.x[query] + offsets_.y[query] * offsets_.y[query]) +
                    offsets_.z[query] * offsets_.z[query];
  const double t = std::sqrt(t2);
  const double root2 = std::sqrt(before.second / weight) + t;
  const double root4 = std::sqrt(std::sqrt(before.fourth / weight)) + t;
  const double b2 = root2 * root2;
  const double b4 = (root4 * root4) * (root4 * root4);
  const double a2 = after.second / weight;
  const double a4 = after.fourth / weight;
  return b4 <= kMostLoss * a4 && b2 * b4 <= (kMostLoss * kMostLoss) * ((a2 * a2) * a2);
}

}  // namespace meshhood
