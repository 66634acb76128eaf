// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "meshhood/fingerprint.h"
#include "meshhood/paper.h"
#include "meshhood/serialize.h"

/// The format of an index file: a header, a table of sections, and the sections, each at a multiple of 64 bytes, with
/// zeros between them. Little-endian; the structures below have the same bytes in the file as in memory.
namespace meshhood::inline v0_1::file {

/// Like that of PNG: no text begins with it, and a transfer that converts line ends damages it.
inline constexpr std::array<std::uint8_t, 8> kMagic{0x8B, 'M', 'H', 'I', '\r', '\n', 0x1A, '\n'};
inline constexpr std::uint32_t kByteOrderMark = 0x01020304;
inline constexpr std::uint32_t kOtherByteOrder = 0x04030201;

/// The format of files of this kind. Exact indexes of format 1 had a tree without
/// links; those of format 2 had regions for each node that the search no longer uses.
[[nodiscard]] constexpr std::uint32_t format_of(IndexKind kind) { return kind == IndexKind::Paper ? 1 : 3; }

struct Header {
  std::array<std::uint8_t, 8> magic = kMagic;
  std::uint32_t byte_order = kByteOrderMark;
  std::uint32_t format = format_of(IndexKind::Exact);
  std::uint64_t bytes = 0;  // of the whole file
  std::uint64_t vertices = 0;
  Fingerprint mesh;
  IndexKind kind = IndexKind::Exact;
  std::uint8_t id_bytes = sizeof(VertexId);
  std::uint8_t scalar_bytes = 0;  // of a coordinate: 4 or 8
  std::uint8_t unused = 0;
  std::uint32_t sections = 0;
  std::uint64_t checksum = 0;  // of the bytes before it, and those after it up to the first section
};
static_assert(sizeof(Header) == 64 && offsetof(Header, checksum) == 56);

struct Section {
  std::array<char, 16> name{};  // padded with zeros
  std::uint64_t begin = 0;      // the first byte, counted from the start of the file
  std::uint64_t bytes = 0;
  std::uint64_t checksum = 0;
};
static_assert(sizeof(Section) == 40);

/// The next multiple of the alignment.
[[nodiscard]] constexpr std::uint64_t aligned(std::uint64_t byte) {
  return (byte + kIndexAlignment - 1) / kIndexAlignment * kIndexAlignment;
}

/// The position of the first of `sections` sections.
[[nodiscard]] constexpr std::uint64_t head_bytes(std::uint64_t sections) {
  return aligned(sizeof(Header) + sections * sizeof(Section));
}

/// A paper index with all levels has the most sections: three, and four for each level.
inline constexpr std::uint64_t kMaxSections = 3 + 4 * paper::BuildOptions::kAllLevels;
static_assert(head_bytes(kMaxSections) <= kIndexHeadBytes);

}  // namespace meshhood::inline v0_1::file
