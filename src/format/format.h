// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "meshhood/fingerprint.h"
#include "meshhood/paper.h"
#include "meshhood/serialize.h"

/// The bytes of a saved index: a header, a table of sections, and the sections, each at a multiple of 64, with zeros
/// between them. Little-endian; the structures below lie in the file as they lie in memory.
namespace meshhood::file {

/// As that of PNG: no text begins so, and a transfer that changes the ends of lines destroys it.
inline constexpr std::array<std::uint8_t, 8> kMagic{0x8B, 'M', 'H', 'I', '\r', '\n', 0x1A, '\n'};
inline constexpr std::uint32_t kByteOrderMark = 0x01020304;
inline constexpr std::uint32_t kOtherByteOrder = 0x04030201;
inline constexpr std::uint32_t kFormat = 1;

struct Header {
  std::array<std::uint8_t, 8> magic = kMagic;
  std::uint32_t byte_order = kByteOrderMark;
  std::uint32_t format = kFormat;
  std::uint64_t bytes = 0;  // of all
  std::uint64_t vertices = 0;
  Fingerprint mesh;
  IndexKind kind = IndexKind::Exact;
  std::uint8_t id_bytes = sizeof(VertexId);
  std::uint8_t scalar_bytes = 0;  // of a coordinate: 4 or 8
  std::uint8_t unused = 0;
  std::uint32_t sections = 0;
  std::uint64_t checksum = 0;  // of what stands before it, and of what follows it up to the first section
};
static_assert(sizeof(Header) == 64 && offsetof(Header, checksum) == 56);

struct Section {
  std::array<char, 16> name{};  // zeros at the end
  std::uint64_t begin = 0;      // counted from the first byte of all
  std::uint64_t bytes = 0;
  std::uint64_t checksum = 0;
};
static_assert(sizeof(Section) == 40);

/// The next multiple of the alignment.
[[nodiscard]] constexpr std::uint64_t aligned(std::uint64_t byte) {
  return (byte + kIndexAlignment - 1) / kIndexAlignment * kIndexAlignment;
}

/// Where the first of so many sections begins.
[[nodiscard]] constexpr std::uint64_t head_bytes(std::uint64_t sections) {
  return aligned(sizeof(Header) + sections * sizeof(Section));
}

/// The most that an index has: one of the paper with all levels, three sections and four a level.
inline constexpr std::uint64_t kMostSections = 3 + 4 * paper::BuildOptions::kAllLevels;
static_assert(head_bytes(kMostSections) <= kIndexHeadBytes);

}  // namespace meshhood::file
