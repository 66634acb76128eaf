// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "meshhood/mesh.h"

namespace meshhood {

/// Puts `ids` in ascending order, and `distances`, unless empty, along with them.
void sort_answer(std::vector<VertexId>& ids, std::vector<double>& distances);

}  // namespace meshhood
