// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "meshhood/mesh.h"

namespace meshhood {

/// Sorts `ids` in ascending order, and `distances`, unless empty, along with them.
void sort_answer(std::span<VertexId> ids, std::span<double> distances);

}  // namespace meshhood
