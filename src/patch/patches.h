// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>

#include "meshhood/patch.h"

#include "batch/packets.h"
#include "patch/packet_patches.h"
#include "patch/search.h"

namespace meshhood::inline v0_1 {

/// The patch of the last run of `search`, which was given `radius`, as a mesh, without its area.
[[nodiscard]] ClippedMesh clip_patch(const PatchState& state, const PatchSearch& search, double radius,
                                     double tolerance);

/// A patch that was found, by a search of its own or as one of a packet. Borrows all; valid until the next is searched.
class FoundPatch {
 public:
  /// `exists`: whether it has a triangle.
  FoundPatch(const PatchState& state, const PatchSearch& search, double radius, bool exists)
      : state_(&state), search_(&search), radius_(radius), exists_(exists) {}
  FoundPatch(const PatchState& state, PacketPatches& packet, std::size_t query, double radius)
      : state_(&state), packet_(&packet), query_(query), radius_(radius), exists_(packet.exists(query)) {}

  [[nodiscard]] double radius() const { return radius_; }

  /// If it was measured.
  [[nodiscard]] double area() const { return search_ ? search_->area() : packet_->area(query_); }
  [[nodiscard]] double volume() const { return search_ ? search_->volume() : packet_->volume(query_); }

  /// The nearest point of a triangle in the ball that it does not have.
  [[nodiscard]] SurfacePoint gap() const;

 private:
  const PatchState* state_;
  const PatchSearch* search_ = nullptr;  // one of the two
  PacketPatches* packet_ = nullptr;
  std::size_t query_ = 0;
  double radius_;
  bool exists_;
};

using RowPatchVisitor = std::function<void(std::size_t row, const FoundPatch& patch)>;

/// A visitor of packets of `state.searched`, for one thread, that calls `visit` with the patch of each row.
[[nodiscard]] PacketVisitor patch_visitor(const PatchState& state, bool measures, RowPatchVisitor visit);

}  // namespace meshhood::inline v0_1
