// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

#include "support/random.h"
#include "support/test_mesh.h"

namespace meshhood::fuzz {

/// Ends the program, so that the fuzzer keeps the input.
[[noreturn]] void fail(const std::string& what);

/// Builds the exact index and the paper's for a valid mesh, checks both, and compares `queries` answers of each with
/// the oracle. Options, vertices and radii are drawn from `random`.
void judge(const test::TestMesh& mesh, test::Random& random, std::size_t queries);

}  // namespace meshhood::fuzz
