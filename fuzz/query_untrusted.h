// SPDX-License-Identifier: MIT
#pragma once

#include "meshhood/index.h"

namespace meshhood::fuzz {

/// Extracts the graph of an untrusted index and runs 64 queries and two batches. The answers may be wrong; the program
/// ends if one has ids outside the index.
void query_untrusted(const Index& index);

}  // namespace meshhood::fuzz
