// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "index/layout.h"
#include "parallel.h"
#include "serialize/section_reader.h"

namespace meshhood::file {

/// Verifies that what an exact index says of itself agrees, so that every query ends and stays within the arrays,
/// whoever wrote them. Of columns and spheres it is not shown that they are those of the mesh: answers may be wrong.
///
/// index   borrowed from `file`; its arrays have the lengths that belong together.
/// Throws Error{MalformedIndex}. One pass over each array, `kVerifyParts` parts of the work.
void verify(const IndexStorage& index, const SectionReader& file, Work& work);

inline constexpr std::size_t kVerifyParts = 5;

// Its parts, in this order: each relies on those before.

/// Leaves hold 1 to 32 vertices each and all of them together, and both numberings are inverse to each other.
void verify_numbering(const IndexStorage& index, const SectionReader& file);

/// Edges within leaves go both ways, and leaves are marked as connected if they are.
void verify_edges_within(const IndexStorage& index, const SectionReader& file);

/// Links and their crossings lead where there is something, are in order, and go both ways.
void verify_links(const IndexStorage& index, const SectionReader& file);

/// Positions are finite, in the frame that is theirs.
void verify_positions(const IndexStorage& index, const SectionReader& file);

/// Spheres enclose their vertices, columns are numbers, and means are those of the level.
void verify_tree(const IndexStorage& index, const SectionReader& file);

/// The values behind the last, for kernels to read, are 0.
template <class T>
void verify_padding(std::span<const T> padding, const SectionReader& file) {
  const auto bytes = std::as_bytes(padding);
  for (const std::byte& byte : bytes) {
    if (byte != std::byte{0}) file.refuse(&byte, "not 0 behind the last");
  }
}

}  // namespace meshhood::file
