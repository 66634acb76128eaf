// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "base/parallel.h"
#include "exact/layout.h"
#include "format/section_reader.h"

namespace meshhood::file {

/// Verifies that what an exact index says of itself agrees, so that every query ends and stays within the arrays,
/// whoever wrote them. Of regions and spheres it is not shown that they are those of the mesh: answers may be wrong.
///
/// index   borrowed from `file`; its arrays have the lengths that belong together.
/// Throws Error{MalformedIndex}. One pass over each array, `kVerifyParts` parts of the work.
void verify(const IndexView& index, const SectionReader& file, TaskContext& task);

inline constexpr std::size_t kVerifyParts = 5;

// Its parts, in this order: each relies on those before.

/// Leaves hold 1 to 32 vertices each and all of them together, and both numberings are inverse to each other.
void verify_numbering(const IndexView& index, const SectionReader& file);

/// Edges within leaves go both ways, and leaves are marked as connected if they are.
void verify_edges_within(const IndexView& index, const SectionReader& file);

/// Links and their cross_edges lead where there is something, are in order, and go both ways.
void verify_links(const IndexView& index, const SectionReader& file);

/// Positions are finite, in the frame that is theirs.
void verify_positions(const IndexView& index, const SectionReader& file);

/// Spheres enclose their vertices, regions are numbers, and means are those of the level.
void verify_tree(const IndexView& index, const SectionReader& file);

/// The values behind the last, for kernels to read, are 0.
template <class T>
void verify_padding(std::span<const T> padding, const SectionReader& file) {
  const auto bytes = std::as_bytes(padding);
  for (const std::byte& byte : bytes) {
    if (byte != std::byte{0}) file.refuse(&byte, "not 0 behind the last");
  }
}

}  // namespace meshhood::file
