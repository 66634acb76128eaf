// SPDX-License-Identifier: MIT
#pragma once

#include "meshhood/index.h"

namespace meshhood::fuzz {

/// Asks an index that came from anywhere 64 queries, and for its graph. What it answers may be wrong; ends the program
/// where it lies outside of the index.
void ask(const Index& index);

}  // namespace meshhood::fuzz
