// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "meshhood/index.h"

#include "parts/cut_tree.h"
#include "parts/manifest.h"
#include "parts/spill.h"

namespace meshhood::parts {

/// The vertices and faces of each part, in the order in which they were read.
struct PartContents {
  Spill vertices;  ///< each a `Site`, in any order, with repeats
  Spill faces;     ///< 64-bit numbers: of each face the number of corners and their ids
};

/// An upper bound of the memory that `write_part_files` takes.
[[nodiscard]] std::uint64_t part_memory(const PartContents& contents, std::size_t part);

/// Builds the index of a part and writes its files to `folder`, which must exist and be empty.
///
/// tree   determines which vertices the part owns.
/// Throws Error{IoFailure, TooLarge, Cancelled}.
[[nodiscard]] Part write_part_files(const std::filesystem::path& folder, const PartContents& contents,
                                    std::size_t number, const CutTree& tree, bool is_double, const Run& run);

}  // namespace meshhood::parts
