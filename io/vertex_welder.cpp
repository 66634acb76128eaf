// SPDX-License-Identifier: MIT
#include "io/vertex_welder.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <ranges>

#include <fmt/format.h>

#include "meshhood/error.h"
#include "meshhood/mesh.h"

namespace meshhood::io {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

}  // namespace

template <class Real>
void VertexWelder<Real>::flush() {
  sort_batch();
  match_groups();
  number_corners();
  merge_new_vertices();
  batch_.clear();
  batch_limit_ = std::max(batch_limit_, vertex_count() / 8);
}

template <class Real>
auto VertexWelder<Real>::vertex(std::uint32_t id) const -> Point {
  const Real* const xyz = &positions_[3 * std::size_t{id}];
  return {xyz[0], xyz[1], xyz[2]};
}

template <class Real>
void VertexWelder<Real>::sort_batch() {
  sorted_batch_.resize(batch_.size());
  std::iota(sorted_batch_.begin(), sorted_batch_.end(), 0U);
  std::sort(sorted_batch_.begin(), sorted_batch_.end(), [this](std::uint32_t a, std::uint32_t b) {
    return batch_[a] == batch_[b] ? a < b : batch_[a] < batch_[b];
  });
}

// Merges the sorted batch with the sorted vertices: each group of equal corners gets its vertex, or becomes a new one.
template <class Real>
void VertexWelder<Real>::match_groups() {
  first_.resize(batch_.size());
  id_.assign(batch_.size(), kNone);
  new_.clear();
  auto known = sorted_vertices_.begin();
  std::uint32_t group = kNone;
  for (const auto corner : sorted_batch_) {
    if (group != kNone && batch_[group] == batch_[corner]) {
      first_[corner] = group;
      continue;
    }
    group = first_[corner] = corner;
    known =
        std::find_if(known, sorted_vertices_.end(), [&](std::uint32_t id) { return !(vertex(id) < batch_[corner]); });
    const bool is_known = known != sorted_vertices_.end() && vertex(*known) == batch_[corner];
    if (is_known) {
      id_[corner] = *known;
    } else {
      new_.push_back(corner);
    }
  }
}

template <class Real>
void VertexWelder<Real>::number_corners() {
  for (std::uint32_t corner = 0; corner < batch_.size(); ++corner) {
    const auto first = first_[corner];
    if (id_[first] == kNone) {
      if (vertex_count() == kMaxVertices) {
        raise(ErrorCode::TooLarge, fmt::format("{}: more than {} vertices", file_, kMaxVertices));
      }
      id_[first] = static_cast<std::uint32_t>(vertex_count());
      positions_.insert(positions_.end(), batch_[first].begin(), batch_[first].end());
    }
    corners_.push_back(id_[first]);
  }
}

// Merges from the back, in corner.
template <class Real>
void VertexWelder<Real>::merge_new_vertices() {
  std::size_t old_end = sorted_vertices_.size();
  sorted_vertices_.resize(old_end + new_.size());
  std::size_t write = sorted_vertices_.size();
  for (const auto corner : std::views::reverse(new_)) {
    while (old_end > 0 && batch_[corner] < vertex(sorted_vertices_[old_end - 1])) {
      sorted_vertices_[--write] = sorted_vertices_[--old_end];
    }
    sorted_vertices_[--write] = id_[corner];
  }
}

template class VertexWelder<float>;
template class VertexWelder<double>;

}  // namespace meshhood::io
