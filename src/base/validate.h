// SPDX-License-Identifier: MIT
#pragma once

#include "meshhood/mesh.h"

#include "shared/parallel.h"

namespace meshhood::inline v0_1 {

/// Validate as the public functions do, with the same errors, but on several threads. They also throw Error{Cancelled}.
void validate(const PositionsView& positions, TaskContext& task);
void validate(const MeshView& mesh, TaskContext& task);

}  // namespace meshhood::inline v0_1
