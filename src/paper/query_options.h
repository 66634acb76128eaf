// SPDX-License-Identifier: MIT
#pragma once

#include "meshhood/paper.h"

namespace meshhood::paper {

/// Throws Error{InvalidOption} unless the options are in their ranges.
void check(const QueryOptions& options);

}  // namespace meshhood::paper
