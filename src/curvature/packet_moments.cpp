// SPDX-License-Identifier: MIT
#include "curvature/packet_moments.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

#include "base/vector.h"

namespace meshhood::inline v0_1 {
namespace {

void measure(const QueryMoments& moments, MomentSizes& sizes) {
  for (std::size_t q = 0; q < kPacketCapacity; ++q) {
    const auto at = [&](std::size_t i, std::size_t j, std::size_t k) { return moments.at[moment_index(i, j, k)][q]; };
    sizes.second[q] = (at(2, 0, 0) + at(0, 2, 0)) + at(0, 0, 2);
    sizes.fourth[q] = (at(4, 0, 0) + at(0, 4, 0)) + at(0, 0, 4) + 2 * ((at(2, 2, 0) + at(0, 2, 2)) + at(2, 0, 2));
  }
}

}  // namespace

PacketMoments::PacketMoments(const MomentSource& source, Isa isa)
    : source_(source),
      kernels_(&moment_kernels(isa)),
      sure_(*source.index),
      offsets_{},
      facing_{},
      terms_{},
      points_{},
      sums_{},
      moments_{},
      before_{},
      after_{} {
  points_.weight.fill(1);
}

QueryWord PacketMoments::begin(LeafId leaf, std::span<const std::uint32_t> places, std::span<const double> radii,
                               QueryWord queries, QueryWord with_vertices) {
  size_ = places.size();
  queries = set_unit(leaf, radii, queries);
  active_ = queries & with_vertices;
  set_offsets(places);
  if (source_.filter != nullptr) set_normals(leaf, places);
  term_count_ = 0;
  add_sure_leaves(leaf, radii);
  return queries;
}

/// Returns about how far a neighborhood reaches, in the frame, for the size of its unit. The mesh is not larger than 4.
/// The leaf of the query has a few vertices side by side, so a ring adds less than its extent.
double PacketMoments::reach_of(double radius, double extent) const {
  const double reach = source_.metric == Metric::Rings ? radius * extent : radius * source_.index->frame.scale;
  return std::min(reach, 4.0);
}

/// Sets the center to that of the box around the leaf. The unit follows from the size of that box and the radius.
QueryWord PacketMoments::set_unit(LeafId leaf, std::span<const double> radii, QueryWord queries) {
  const IndexView& index = *source_.index;
  double extent = 0;
  std::visit(
      [&](auto xyz) {
        const auto box = [&](std::size_t axis) {
          double low = kInfinity;
          double high = -low;
          for (std::size_t i = 0; i < index.leaves[leaf].size; ++i) {
            const auto coordinate = static_cast<double>(xyz[3 * (index.leaves[leaf].first + i) + axis]);
            low = std::min(low, coordinate);
            high = std::max(high, coordinate);
          }
          extent = std::max(extent, (high - low) * index.frame.scale);
          return low + (high - low) / 2;
        };
        center_ = {box(0), box(1), box(2)};
      },
      index.positions);
  const auto unit = [&](std::size_t query) {
    return unit_factor(std::max(extent, reach_of(radii[query], extent)), index.frame);
  };
  const auto first = static_cast<std::size_t>(std::countr_zero(queries));
  scale_ = unit(first);
  QueryWord same = 0;
  for_each_query(queries,
                 [&](std::size_t q) { same |= QueryWord{radii[q] == radii[first] || unit(q) == scale_} << q; });
  return same;
}

void PacketMoments::set_offsets(std::span<const std::uint32_t> places) {
  for (std::size_t q = 0; q < size_; ++q) {
    const Point at = source_.index->position(places[q]);
    offsets_.set(q, scale_ * (center_ - at));
  }
}

void PacketMoments::set_normals(LeafId leaf, std::span<const std::uint32_t> places) {
  for (std::size_t q = 0; q < size_; ++q) {
    const Point n = source_.filter->normal(places[q]);
    if (std::isnan(n.x)) active_ &= ~(QueryWord{1} << q);
    facing_.normals.set(q, n);
  }
  set_axis(leaf);
}

/// If all normals of a leaf make at most the angle t with an axis, a normal that makes less than 90 degrees - t with it
/// faces all of them.
void PacketMoments::set_axis(LeafId leaf) {
  // Products of unit vectors in single precision, each of at most six roundings, are off by less than this.
  constexpr float kMargin = 0x1p-20F;
  const Leaf& of = source_.index->leaves[leaf];
  const auto for_each_normal = [&](const auto& f) {
    for (std::size_t i = of.first; i < of.first + of.size; ++i) {
      const Point n = source_.filter->normal(i);
      if (!std::isnan(n.x)) f(n);
    }
  };
  Point sum{0, 0, 0};
  for_each_normal([&](const Point& n) { sum = sum + n; });
  facing_.axis = sum;
  facing_.all = 2;
  const double size = length(sum);
  if (!(size > 0)) return;
  facing_.axis = (1 / size) * sum;
  double least = 1;
  for_each_normal([&](const Point& n) { least = std::min(least, dot(facing_.axis, n)); });
  if (least > 0) facing_.all = static_cast<float>(std::sqrt(std::max(0.0, 1 - least * least))) + 2 * kMargin;
}

/// Begins the sums with the sure leaves for their radius. With a filter, those are left out that do not face all
/// vertices of this one.
void PacketMoments::add_sure_leaves(LeafId leaf, std::span<const double> radii) {
  std::array<std::size_t, kPacketCapacity> by_radius;
  std::size_t count = 0;
  for_each_query(active_, [&](std::size_t q) {
    std::size_t place = count++;
    for (; place > 0 && radii[by_radius[place - 1]] > radii[q]; --place) by_radius[place] = by_radius[place - 1];
    by_radius[place] = q;
  });
  sure_.begin(leaf);
  const bool has_sure_leaves = source_.metric == Metric::Straight;
  PaddedMoments sum{};
  QueryWord larger = active_;  // the queries of at least this radius
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t q = by_radius[k];
    if (k == 0 || radii[q] != radii[by_radius[k - 1]]) {
      const TreeBounds radius(source_.index->frame, radii[q]);
      while (const std::optional<LeafId> next = has_sure_leaves ? sure_.next(radius) : std::nullopt) {
        const Leaf& of = source_.index->leaves[*next];
        if (source_.filter != nullptr && !faces_all(of)) continue;
        sure_.set_queries(*next, larger);
        set_points(of);
        PaddedMoments term;
        kernels_->sum(points_, of.size, term);
        meshhood::add(sum, term);
      }
    }
    sums_[q] = sum;
    larger &= ~(QueryWord{1} << q);
  }
}

/// Returns whether each vertex of `leaf` surely faces each vertex of the leaf of the queries.
bool PacketMoments::faces_all(const Leaf& leaf) const {
  const OrientedIndex& surface = *source_.filter;
  bool all = true;
  for (std::size_t i = leaf.first; i < leaf.first + leaf.size; ++i) {
    all &= dot(facing_.axis, surface.normal(i)) > double{facing_.all};
  }
  return all;
}

/// Adds the leaves in index order, which does not depend on what else is in the packet.
void PacketMoments::add(const Piece& piece) {
  if (!piece.is_run()) return add_leaf(piece.leaves.begin, piece.reached);
  std::array<QueryWord, kPacketCapacity> words;
  words.fill(piece.queries);
  for (LeafId leaf = piece.leaves.begin; leaf < piece.leaves.end; ++leaf) add_leaf(leaf, words.data());
}

/// Adds the sum of a leaf to a query that has all of its vertices, and single vertices to another one.
void PacketMoments::add_leaf(LeafId leaf, const QueryWord* words) {
  const QueryWord open = active_ & ~sure_.queries(leaf);
  const Leaf& of = source_.index->leaves[leaf];
  if (open == 0 || of.size == 0) return;  // a group with fewer than eight leaves has empty ones
  std::array<QueryWord, kPacketCapacity> open_words;
  const auto rest = std::span(open_words).first(of.size);
  for (std::size_t i = 0; i < rest.size(); ++i) rest[i] = words[i] & open;
  if (source_.filter != nullptr) {
    const OrientedIndex& surface = *source_.filter;
    kernels_->keep_facing({&surface.normals->x[of.first], &surface.normals->y[of.first], &surface.normals->z[of.first]},
                          facing_, rest);
  }
  QueryWord all = open;
  for (const QueryWord word : rest) all &= word;
  for (QueryWord& word : rest) word &= ~all;
  add_terms_of(of, rest, all);
}

void PacketMoments::add_terms_of(const Leaf& leaf, std::span<const QueryWord> words, QueryWord all) {
  LaneMask some = 0;
  for (std::size_t i = 0; i < words.size(); ++i) some |= LaneMask{words[i] != 0} << i;
  if ((some | all) == 0) return;
  if (term_count_ > terms_.size() - (kLeafCapacity + 1)) add_terms();
  set_points(leaf);
  if (some != 0) kernels_->powers(points_, some, &terms_[term_count_]);
  for_each_lane(some, [&](unsigned lane) { words_[term_count_++] = words[lane]; });
  if (all != 0) {
    kernels_->sum(points_, leaf.size, terms_[term_count_]);
    words_[term_count_++] = all;
  }
}

void PacketMoments::add_terms() {
  kernels_->add_terms(terms_.data(), std::span(words_).first(term_count_), sums_);
  term_count_ = 0;
}

void PacketMoments::set_points(const Leaf& leaf) {
  if (!source_.weights.empty()) std::copy_n(&source_.weights[leaf.first], leaf.size, points_.weight.data());
  if (const auto* floats = std::get_if<std::span<const float>>(&source_.index->positions)) {
    kernels_->set_points_float(&(*floats)[3 * std::size_t{leaf.first}], leaf.size, center_, scale_, points_);
  } else {
    const auto& doubles = std::get<std::span<const double>>(source_.index->positions);
    kernels_->set_points_double(&doubles[3 * std::size_t{leaf.first}], leaf.size, center_, scale_, points_);
  }
}

const QueryMoments& PacketMoments::finish() {
  add_terms();
  for_each_query(first_lanes(static_cast<unsigned>(size_)), [&](std::size_t q) {
    const bool has_sums = (active_ >> q & 1U) != 0;
    for (std::size_t m = 0; m < kMomentCount; ++m) moments_.at[m][q] = has_sums ? sums_[q].at[m] : 0;
  });
  measure(moments_, before_);
  kernels_->shift(moments_, offsets_);
  measure(moments_, after_);
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
// divided by W here. Fourth powers underflow where the neighborhood is small in its unit: then A_4 is small, or 0, and
// the test fails. Where digits were lost, the computed A_4 is at most about epsilon B_4, and it fails, too.
bool PacketMoments::is_accurate(std::size_t query) const {
  constexpr double kMostLoss = 400;
  constexpr double kLeastWeight = 0x1p-800;  // products of smaller weights and powers may underflow
  constexpr double kLeastFourth = 0x1p-200;  // of A_4, divided by W, likewise
  const double weight = moments_.at[moment_index(0, 0, 0)][query];
  if (weight == 0) return true;  // the sums are 0
  if (!(weight >= kLeastWeight)) return false;
  const double t2 = (offsets_.x[query] * offsets_.x[query] + offsets_.y[query] * offsets_.y[query]) +
                    offsets_.z[query] * offsets_.z[query];
  const double t = std::sqrt(t2);
  const double per_weight = 1 / weight;
  const double root2 = std::sqrt(per_weight * before_.second[query]) + t;
  const double root4 = std::sqrt(std::sqrt(per_weight * before_.fourth[query])) + t;
  const double b2 = root2 * root2;
  const double b4 = (root4 * root4) * (root4 * root4);
  const double a2 = per_weight * after_.second[query];
  const double a4 = per_weight * after_.fourth[query];
  return a4 >= kLeastFourth && b4 <= kMostLoss * a4 && b2 * b4 <= (kMostLoss * kMostLoss) * ((a2 * a2) * a2);
}

PacketVisitor moment_visitor(const MomentSource& source, MomentVisitor visit) {
  const auto sums = std::make_shared<PacketMoments>(source, best_isa());
  return [sums, &index = *source.index, visit = std::move(visit)](const PacketAnswer& packet) {
    std::array<std::uint32_t, kPacketCapacity> memory;
    const auto places = std::span(memory).first(packet.rows.size());
    std::ranges::transform(packet.vertices, places.begin(), [&](VertexId v) { return index.place(v); });
    const LeafId leaf = leaf_of(index.slot[packet.vertices.front()]);
    for (QueryWord left = first_lanes(static_cast<unsigned>(places.size())); left != 0;) {
      const QueryWord queries = sums->begin(leaf, places, packet.radii, left, packet.queries);
      for (const Piece& piece : packet.pieces) sums->add(piece);
      visit({packet.rows, places, packet.radii, queries}, *sums, sums->finish());
      left &= ~queries;
    }
  };
}

}  // namespace meshhood::inline v0_1
