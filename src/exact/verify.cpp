// SPDX-License-Identifier: MIT
#include "exact/verify.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <variant>

#include "exact/build/links.h"
#include "format/format.h"

namespace meshhood::inline v0_1::file {
namespace {

std::string name(const char* what, std::size_t number) { return what + (" " + std::to_string(number)); }

/// Reads the byte: a file may contain bytes that are not a valid bool.
bool is_bool(const bool& value) { return std::to_integer<unsigned>(*reinterpret_cast<const std::byte*>(&value)) <= 1; }

void verify_leaf(const IndexView& index, std::size_t leaf, const SectionReader& file) {
  const std::size_t begin = index.leaf_begin[leaf];
  const std::size_t end = index.leaf_begin[leaf + 1];
  const bool exists = leaf % kFanOut < index.records[leaf / kFanOut].nodes;
  if (begin > end || end - begin > kLeafCapacity || (begin < end) != exists) {
    file.refuse(&index.leaf_begin[leaf + 1], name("leaf", leaf) + ": vertices " + std::to_string(begin) + " to " +
                                                 std::to_string(end) + ", expected " + (exists ? "1 to 32" : "no") +
                                                 " vertices");
  }
  const Leaf& record = index.leaves[leaf];
  if (record.first != begin || record.size != end - begin) {
    file.refuse(&record, name("leaf", leaf) + ": " + std::to_string(record.size) + " vertices from vertex " +
                             std::to_string(record.first) + ", expected " + std::to_string(end - begin) +
                             " from vertex " + std::to_string(begin));
  }
  if (!is_bool(record.connected) || record.unused != 0) {
    file.refuse(&record.connected,
                name("leaf", leaf) + ": the mark as connected is neither 0 nor 1, or unused bytes are not 0");
  }
}

/// The frame may be larger than the positions need, because vertices may have moved.
void verify_frame(const IndexView& index, const SectionReader& file) {
  const double scale = index.frame.scale;
  int exponent = 0;
  if (std::isfinite(scale) && std::frexp(scale, &exponent) == 0.5) return;
  std::visit([&](auto xyz) { file.refuse(xyz.data(), "the scale of the frame is not a power of two"); },
             index.positions);
}

void verify_last_leaf(const IndexView& index, const SectionReader& file) {
  const Leaf& last = index.leaves.back();
  const Leaf expected{{}, static_cast<std::uint32_t>(index.vertex_count()), last.first_link, 0, false};
  // All bytes are defined. NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
  if (std::memcmp(&last, &expected, sizeof(Leaf)) != 0) {
    file.refuse(&last,
                "the last record does not mark the end of " + std::to_string(index.vertex_count()) + " vertices");
  }
}

void verify_corners(std::span<const VertexId> corners, std::size_t vertices, const SectionReader& file) {
  for (const VertexId& corner : corners) {
    if (corner < vertices) continue;
    file.refuse(&corner,
                "vertex " + std::to_string(corner) + ", but there are " + std::to_string(vertices) + " vertices");
  }
}

void verify_offsets(std::span<const std::uint32_t> offsets, std::size_t corners, const SectionReader& file) {
  if (offsets.front() != 0) file.refuse(&offsets.front(), "face 0 does not begin at corner 0");
  bool are_triangles = true;
  for (std::size_t face = 0; face + 1 < offsets.size(); ++face) {
    const std::uint32_t begin = offsets[face];
    const std::uint32_t end = offsets[face + 1];
    if (begin > end) {
      file.refuse(&offsets[face + 1], "face " + std::to_string(face) + " ends at corner " + std::to_string(end) +
                                          ", before it begins at " + std::to_string(begin));
    }
    are_triangles = are_triangles && end - begin == 3;
  }
  if (offsets.back() != corners) {
    file.refuse(&offsets.back(),
                "the faces have " + std::to_string(offsets.back()) + " corners, expected " + std::to_string(corners));
  }
  if (are_triangles) file.refuse(&offsets.front(), "all faces are triangles, expected no offsets");
}

}  // namespace

void verify(const IndexView& index, const SectionReader& file, TaskContext& task) {
  constexpr std::array kParts{verify_forest,     verify_numbering, verify_edges_within, verify_links,
                              verify_node_links, verify_positions, verify_tree,         verify_faces};
  static_assert(kParts.size() == kVerifyParts);
  for (const auto part : kParts) {
    part(index, file);
    task.step();
  }
}

void verify_numbering(const IndexView& index, const SectionReader& file) {
  const std::size_t vertices = index.vertex_count();
  if (index.leaf_begin.front() != 0) file.refuse(&index.leaf_begin.front(), "leaf 0 does not begin at vertex 0");
  for (std::size_t leaf = 0; leaf < index.leaf_count(); ++leaf) verify_leaf(index, leaf, file);
  if (index.leaf_begin.back() != vertices) {
    file.refuse(&index.leaf_begin.back(), "the leaves hold " + std::to_string(index.leaf_begin.back()) +
                                              " vertices, expected " + std::to_string(vertices));
  }
  verify_last_leaf(index, file);
  for (std::size_t leaf = 0; leaf < index.leaf_count(); ++leaf) {
    for (std::size_t i = index.leaf_begin[leaf]; i < index.leaf_begin[leaf + 1]; ++i) {
      const std::size_t v = index.id(i);
      const std::size_t slot = leaf * kLeafCapacity + (i - index.leaf_begin[leaf]);
      if (v >= vertices) {
        file.refuse(&index.permutation[i],
                    name("vertex", v) + ", but there are " + std::to_string(vertices) + " vertices");
      }
      // The slots of different positions differ, so no id occurs twice.
      if (index.slot[v] != slot) {
        file.refuse(&index.slot[v], name("vertex", v) + " has slot " + std::to_string(index.slot[v]) + ", expected " +
                                        std::to_string(slot));
      }
    }
  }
  if (!index.permutation.empty()) verify_padding(index.permutation.subspan(vertices), file);
}

void verify_edges_within(const IndexView& index, const SectionReader& file) {
  for (std::size_t leaf = 0; leaf < index.leaf_count(); ++leaf) {
    const Leaf& record = index.leaves[leaf];
    const std::span<const LaneMask> rows = index.adjacency.subspan(record.first, record.size);
    for (unsigned lane = 0; lane < record.size; ++lane) {
      if ((rows[lane] & (~first_lanes(record.size) | LaneMask{1} << lane)) != 0) {
        file.refuse(&rows[lane], name("leaf", leaf) + ": lane " + std::to_string(lane) +
                                     " is a neighbor of itself or of a lane that the leaf does not have");
      }
      for (LaneMask left = rows[lane]; left != 0; left &= left - 1) {
        const auto other = static_cast<unsigned>(std::countr_zero(left));
        if ((rows[other] >> lane & 1U) == 0) {
          file.refuse(&rows[lane], name("leaf", leaf) + ": an edge leads from lane " + std::to_string(lane) +
                                       " to lane " + std::to_string(other) + ", but none leads back");
        }
      }
    }
    const bool connected = record.size > 0 && is_connected(rows.data(), record.size);
    if (record.connected != connected) {
      file.refuse(&record.connected, name("leaf", leaf) + ": its mark as connected or not is wrong");
    }
  }
  verify_padding(index.adjacency.subspan(index.vertex_count()), file);
}

void verify_positions(const IndexView& index, const SectionReader& file) {
  std::visit(
      [&](auto xyz) {
        const auto positions = xyz.first(3 * index.vertex_count());
        verify_coordinates(positions, file);
        verify_padding(xyz.subspan(positions.size()), file);
        verify_frame(index, file);
        for (std::size_t i = 0; i < index.vertex_count(); ++i) {
          if (covers(index.frame, point(xyz, i))) continue;
          file.refuse(&xyz[3 * i], name("vertex", index.id(i)) + " lies outside the frame");
        }
      },
      index.positions);
}

void verify_faces(const IndexView& index, const SectionReader& file) {
  if (!index.faces) return;
  verify_corners(index.faces->corners, index.vertex_count(), file);
  if (!index.faces->offsets.empty()) verify_offsets(index.faces->offsets, index.faces->corners.size(), file);
}

}  // namespace meshhood::inline v0_1::file
