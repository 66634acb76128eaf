// SPDX-License-Identifier: MIT
#pragma once

#include "exact/build/node_parts.h"

namespace meshhood {

/// Dissolves small parts: each of their nodes moves to another part that it is linked with, so all parts stay
/// connected. A part whose nodes do not all find room stays as it was. O(links).
///
/// A place that no node takes needs as much memory as a node. On closely folded surfaces, where most cells of a kd
/// order are cut, a fifth of the places would stay empty.
void dissolve_small_parts(NodeParts& parts);

}  // namespace meshhood
