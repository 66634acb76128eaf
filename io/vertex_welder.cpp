// SPDX-License-Identifier: MIT
#include "io/vertex_welder.h"

#include <bit>
#include <limits>

#include <fmt/format.h>

#include "meshhood/error.h"
#include "meshhood/mesh.h"

#include "io/seeded_hash.h"

namespace meshhood::inline v0_1::io {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kFirstSlots = std::size_t{1} << 12;

}  // namespace

template <class Real>
VertexWelder<Real>::VertexWelder(std::vector<Real>& positions, std::vector<std::uint32_t>& corners, std::string file)
    : positions_(positions),
      corners_(corners),
      file_(std::move(file)),
      seed_(new_seed(this)),
      slots_(kFirstSlots, kNone) {}

template <class Real>
void VertexWelder<Real>::expect(std::size_t vertices) {
  const std::size_t slots = std::bit_ceil(vertices + vertices / 2);
  if (slots > slots_.size()) resize(slots);
}

template <class Real>
auto VertexWelder<Real>::vertex(std::uint32_t id) const -> Point {
  const Real* const xyz = &positions_[3 * std::size_t{id}];
  return {xyz[0], xyz[1], xyz[2]};
}

template <class Real>
std::size_t VertexWelder<Real>::first_slot(const Point& point) const {
  std::uint64_t hash = seed_;
  for (const Real coordinate : point) hash = hash_with(hash, coordinate);
  return static_cast<std::size_t>(hash) & (slots_.size() - 1);
}

template <class Real>
std::uint32_t VertexWelder<Real>::vertex_at(const Point& point) {
  std::size_t slot = first_slot(point);
  for (; slots_[slot] != kNone; slot = next_slot(slot)) {
    if (vertex(slots_[slot]) == point) return slots_[slot];
  }
  const std::uint32_t id = new_vertex(point);
  slots_[slot] = id;
  if (3 * vertex_count() > 2 * slots_.size()) resize(2 * slots_.size());
  return id;
}

template <class Real>
std::uint32_t VertexWelder<Real>::new_vertex(const Point& point) {
  if (vertex_count() == kMaxVertices) {
    raise(ErrorCode::TooLarge, fmt::format("{}: more than {} vertices", file_, kMaxVertices));
  }
  const auto id = static_cast<std::uint32_t>(vertex_count());
  positions_.insert(positions_.end(), point.begin(), point.end());
  return id;
}

// The old table is freed before there is a new one, so that both are never in memory.
template <class Real>
void VertexWelder<Real>::resize(std::size_t slots) {
  slots_ = {};
  slots_.resize(slots, kNone);
  for (std::uint32_t id = 0; id < vertex_count(); ++id) {
    std::size_t slot = first_slot(vertex(id));
    while (slots_[slot] != kNone) slot = next_slot(slot);
    slots_[slot] = id;
  }
}

template class VertexWelder<float>;
template class VertexWelder<double>;

}  // namespace meshhood::inline v0_1::io
