// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "io/mesh_io.h"

namespace meshhood::inline v0_1::io {
class InputBuffer;
struct ReaderOptions;
}  // namespace meshhood::inline v0_1::io

namespace meshhood::fuzz {

using Reader = io::Mesh (*)(io::InputBuffer& input, const io::ReaderOptions& options);

/// Checks that `reader` returns a valid mesh or throws an error of one line. Meshes that are not large are passed to
/// `judge`.
void read(std::span<const std::byte> bytes, Reader reader);

}  // namespace meshhood::fuzz
