// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "io/mesh_io.h"

namespace meshhood::io {
class Input;
}

namespace meshhood::fuzz {

using Reader = io::Mesh (*)(io::Input& input, const io::ReadOptions& options);

/// Whatever the bytes, `reader` gives a valid mesh or an error of one line. A mesh that it gives, if it is not large,
/// is judged.
void read(std::span<const std::byte> bytes, Reader reader);

}  // namespace meshhood::fuzz
