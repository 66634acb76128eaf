// SPDX-License-Identifier: MIT
#pragma once

#include "meshhood/mesh.h"

#include "shared/parallel.h"

namespace meshhood {

/// As the public functions, on several threads, with the same errors. Throw also Error{Cancelled}.
void validate(const PositionsView& positions, TaskContext& task);
void validate(const MeshView& mesh, TaskContext& task);

}  // namespace meshhood
