// SPDX-License-Identifier: MIT
#include "curvature/packet_moments.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "base/vector.h"

namespace meshhood {
namespace {

/// A power of two that brings `extent`, in the frame, to between 1/2 and 1.
double scale_of(double extent) { return extent > 0 ? std::ldexp(1.0, -std::ilogb(extent) - 1) : 1; }

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
      normals_{},
      points_{},
      common_{},
      some_{},
      moments_{} {}

void PacketMoments::begin(std::span<const std::uint32_t> places, double reach) {
  size_ = places.size();
  active_ = first_lanes(static_cast<unsigned>(size_));
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
}

void PacketMoments::set_normals(std::span<const std::uint32_t> places) {
  for (std::size_t q = 0; q < size_; ++q) {
    const Point n = source_.filter->normal(places[q]);
    if (std::isnan(n.x)) active_ &= ~(QueryWord{1} << q);
    normals_.x[q] = n.x;
    normals_.y[q] = n.y;
    normals_.z[q] = n.z;
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
  scale_ = scale_of(extent) * source_.index->frame.scale;
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
  const auto normal = [&](std::size_t q) { return Point{normals_.x[q], normals_.y[q], normals_.z[q]}; };
  for_each_lane(active_, [&](unsigned q) { sum = sum + normal(q); });
  axis_ = (1 / length(sum)) * sum;
  double least = 1;
  for_each_lane(active_, [&](unsigned q) { least = std::min(least, dot(axis_, normal(q))); });
  constexpr double kMargin = 1e-12;  // of rounding
  all_face_ = least > 0 ? std::sqrt(std::max(0.0, 1 - least * least)) + kMargin : 2;
  if (!(all_face_ < 2)) all_face_ = 2;
}

void PacketMoments::add(std::size_t first, std::size_t size, QueryWord word) {
  add_blocks(first, size, [word](std::size_t) { return word; });
}

void PacketMoments::add(std::size_t first, std::size_t size, std::span<const QueryWord, kPacketCapacity> words) {
  add_blocks(first, size, [words](std::size_t i) { return words[i]; });
}

template <class WordOf>
void PacketMoments::add_blocks(std::size_t first, std::size_t size, const WordOf& word_of) {
  if (active_ == 0) return;
  std::array<QueryWord, MomentPoints::kCapacity> words;
  for (std::size_t begin = 0; begin < size; begin += words.size()) {
    const std::size_t count = std::min(size - begin, words.size());
    for (std::size_t i = 0; i < count; ++i) words[i] = word_of(begin + i) & active_;
    const auto block = std::span(words).first(count);
    if (source_.filter != nullptr) keep_facing(first + begin, block);
    add_points(first + begin, block);
  }
}

/// Removes from the word of a vertex the queries that it does not face.
void PacketMoments::keep_facing(std::size_t first, std::span<QueryWord> words) {
  alignas(64) std::array<double, MomentPoints::kCapacity> products;
  kernels_->products(&source_.filter->normal_x[first], &source_.filter->normal_y[first],
                     &source_.filter->normal_z[first], words.size(), axis_, products.data());
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (products[i] > all_face_) continue;  // mutant: faces-the-axis-alone
    if (products[i] < -all_face_) {
      words[i] = 0;
    } else if (words[i] != 0) {
      words[i] &= kernels_->facing(source_.filter->normal(first + i), normals_);
    }
  }
}

void PacketMoments::set_points(std::size_t first, std::size_t size) {
  std::visit(
      [&](auto xyz) {
        for (std::size_t i = 0; i < size; ++i) {
          const Point p = point(xyz, first + i);
          points_.x[i] = scale_ * (p.x - center_.x);
          points_.y[i] = scale_ * (p.y - center_.y);
          points_.z[i] = scale_ * (p.z - center_.z);
        }
      },
      source_.index->positions);
  for (std::size_t i = 0; i < size; ++i) {
    points_.weight[i] = source_.weights.empty() ? 1 : source_.weights[first + i];
  }
  for (std::size_t i = size; i % PartialMoments::kParts != 0; ++i) points_.weight[i] = 0;
}

/// Adds the vertices that count for all queries to one sum, and the others by their words.
void PacketMoments::add_points(std::size_t first, std::span<QueryWord> words) {
  set_points(first, words.size());
  const auto common = static_cast<std::size_t>(std::count(words.begin(), words.end(), active_));
  if (common < words.size()) {
    std::array<double, MomentPoints::kCapacity> weights = points_.weight;
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (words[i] == active_) {
        words[i] = 0;
      } else {
        weights[i] = 0;
      }
    }
    kernels_->add_powers_by_word(points_, words, some_);
    points_.weight = weights;
  }
  if (common > 0) kernels_->add_powers(points_, words.size(), common_);
}

const QueryMoments& PacketMoments::finish() {
  kernels_->collect(common_, some_, moments_);
  for (std::size_t q = 0; q < size_; ++q) sizes_[q] = sizes_of(moments_, q);
  kernels_->shift(moments_, offsets_);  // mutant: moments-about-the-packet
  for (std::size_t q = 0; q < size_; ++q) {
    const MomentSizes after = sizes_of(moments_, q);
    sizes_[q] = {std::max(sizes_[q].second, after.second), std::max(sizes_[q].fourth, after.fourth)};
  }
  return moments_;
}

}  // namespace meshhood
