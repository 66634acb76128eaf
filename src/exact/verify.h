// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "exact/layout.h"
#include "format/format.h"
#include "shared/parallel.h"

namespace meshhood::inline v0_1::file {

/// Verifies that the arrays of an exact index are consistent, so that every query ends and reads within the arrays,
/// whatever the file contains.
///
/// index   a view of the arrays in `file`, whose sizes are verified already
/// Throws Error{MalformedIndex, Cancelled}. Takes about one pass over each array, and advances `task` by
/// `kVerifyParts`.
void verify(const IndexView& index, const SectionReader& file, TaskContext& task);

inline constexpr std::size_t kVerifyParts = 8;

// These are the parts of the verification, in this order. Each relies on those before it, and throws unless its
// statement holds.

/// Every group is covered by one node of the level above, or by none.
void verify_forest(const IndexView& index, const SectionReader& file);

/// Leaves hold 1 to 32 vertices each and all vertices together; `permutation` and `slot` are inverse to each other.
void verify_numbering(const IndexView& index, const SectionReader& file);

/// Edges within leaves are symmetric, and leaves are marked as connected if and only if they are.
void verify_edges_within(const IndexView& index, const SectionReader& file);

/// Links and cross edges refer to existing leaves and lanes, are in order, and are symmetric.
void verify_links(const IndexView& index, const SectionReader& file);

/// The vertices of groups are those of their leaves, the links between nodes are those that follow from the links
/// between leaves, and every node above the leaves is connected by them.
void verify_node_links(const IndexView& index, const SectionReader& file);

/// Positions are finite and lie in the frame, whose scale is a power of two.
void verify_positions(const IndexView& index, const SectionReader& file);

/// Spheres enclose their vertices, and mean radii are those of their levels.
void verify_tree(const IndexView& index, const SectionReader& file);

/// Corners of faces are vertices, offsets ascend from 0 to the number of corners, and are left out if all faces are
/// triangles, so that the same faces have the same bytes.
void verify_faces(const IndexView& index, const SectionReader& file);

/// The padding after the last element, which kernels may read, is 0.
template <class T>
void verify_padding(std::span<const T> padding, const SectionReader& file) {
  const auto bytes = std::as_bytes(padding);
  for (const std::byte& byte : bytes) {
    if (byte != std::byte{0}) file.refuse(&byte, "the padding is not 0");
  }
}

}  // namespace meshhood::inline v0_1::file
