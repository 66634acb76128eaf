// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include "meshhood/masks.h"

namespace meshhood::python {

/// A value for each vertex, 0 or 1.
using Mask = std::optional<
    nanobind::ndarray<const std::uint8_t, nanobind::shape<-1>, nanobind::c_contig, nanobind::device::cpu>>;

/// Borrows the array.
[[nodiscard]] inline VertexMask mask_of(const Mask& mask) {
  return mask ? VertexMask(std::span(mask->data(), mask->size())) : VertexMask();
}

[[nodiscard]] inline Masks masks_of(const Mask& walls, const Mask& ignored) {
  return {mask_of(walls), mask_of(ignored)};
}

}  // namespace meshhood::python
