// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "meshhood/fingerprint.h"
#include "meshhood/paper.h"
#include "meshhood/serialize.h"

#include "shared/distance.h"
#include "shared/parallel.h"

/// An index file has a header, a table of sections, and the sections, each at a multiple of 64 bytes, with zeros
/// between them. It is little-endian; the structures below have the same bytes in the file as in memory.
namespace meshhood::inline v0_1::file {

/// Like that of PNG: no text begins with it, and a transfer that converts line ends damages it.
inline constexpr std::array<std::uint8_t, 8> kMagic{0x8B, 'M', 'H', 'I', '\r', '\n', 0x1A, '\n'};
inline constexpr std::uint32_t kByteOrderMark = 0x01020304;
inline constexpr std::uint32_t kOtherByteOrder = 0x04030201;

/// Returns the format of files of this kind. Exact indexes of format 1 had a tree without links; those of format 2 had
/// regions of each node, which the search no longer uses.
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

/// Returns the next multiple of the alignment.
[[nodiscard]] constexpr std::uint64_t aligned(std::uint64_t byte) {
  return (byte + kIndexAlignment - 1) / kIndexAlignment * kIndexAlignment;
}

/// Returns the position of the first of `sections` sections.
[[nodiscard]] constexpr std::uint64_t head_bytes(std::uint64_t sections) {
  return aligned(sizeof(Header) + sections * sizeof(Section));
}

/// A paper index with all levels has the most sections: three, and four for each level.
inline constexpr std::uint64_t kMaxSections = 3 + 4 * paper::BuildOptions::kAllLevels;
static_assert(head_bytes(kMaxSections) <= kIndexHeadBytes);

/// Returns the header of an index file of `size` bytes that begins with `first_bytes`. Throws Error{MalformedIndex} if
/// it is not valid, not of this format, or states another size.
[[nodiscard]] Header read_header(std::span<const std::byte> first_bytes, std::uint64_t size);

/// Throws Error{MalformedIndex} if the kinds differ.
void expect_kind(IndexKind kind, IndexKind expected);

/// Reads the sections of an index file in order. All errors are Error{MalformedIndex} and name section and byte.
class SectionReader {
 public:
  /// Verifies the header, and that the sections follow one another without a gap to the end of the file.
  /// `bytes` must begin at a multiple of `kIndexAlignment` and outlive the reader.
  explicit SectionReader(std::span<const std::byte> bytes);

  [[nodiscard]] const Header& header() const { return header_; }

  /// Returns whether there is a next section, and has this name.
  [[nodiscard]] bool is_next(std::string_view name) const;

  /// Returns a view of the next section, which must have this name.
  template <class T>
  [[nodiscard]] std::span<const T> take(std::string_view name) {
    static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= kIndexAlignment);
    const std::span<const std::byte> bytes = take_bytes(name, sizeof(T));
    return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
  }

  /// Does the same for a section that must have `count` elements.
  template <class T>
  [[nodiscard]] std::span<const T> take(std::string_view name, std::uint64_t count) {
    const std::span<const T> values = take<T>(name);
    if (values.size() != count) refuse_count(values.size(), count);
    return values;
  }

  /// Throws if a section has not been taken.
  void expect_end() const;

  /// Throws if the checksum of a section does not match, or if the padding between sections is not 0. Advances `task`
  /// by 1 for each section.
  void verify_checksums(TaskContext& task) const;

  /// Throws an error that begins with the section and the byte at `place`, which points into the bytes.
  [[noreturn]] void refuse(const void* place, const std::string& message) const;

  /// Throws an error about a byte of a section, counted from the first of the section.
  [[noreturn]] void refuse_in(std::string_view section, std::uint64_t byte, const std::string& message) const;

  /// Throws an error about the section taken last, which may be empty.
  [[noreturn]] void refuse_last(const std::string& message) const;

 private:
  void verify_table() const;
  [[nodiscard]] std::span<const std::byte> bytes_of(const Section& section) const;
  [[nodiscard]] std::span<const std::byte> take_bytes(std::string_view name, std::size_t of_each);
  [[noreturn]] void refuse_count(std::uint64_t count, std::uint64_t expected) const;

  std::span<const std::byte> bytes_;
  Header header_;
  std::span<const Section> table_;
  std::size_t taken_ = 0;
};

/// Throws if a coordinate is one that `validate` rejects.
template <class Real>
void verify_coordinates(std::span<const Real> xyz, const SectionReader& file) {
  for (const Real& value : xyz) {
    if (std::abs(static_cast<double>(value)) <= kLargestCoordinate) continue;
    file.refuse(&value, "a coordinate is not finite or exceeds 2^500");
  }
}

/// Collects sections, then writes the index file to a sink. The arrays are borrowed.
class SectionWriter {
 public:
  template <class T>
  void add(std::string_view name, std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    add_bytes(name, std::as_bytes(values));
  }

  /// Returns by how much `write` advances its task.
  [[nodiscard]] std::size_t parts() const;

  /// Completes `header`, of which the caller sets kind, vertices, precision and fingerprint. Throws Error{Cancelled}.
  void write(Header header, const Sink& sink, TaskContext& task) const;

 private:
  void add_bytes(std::string_view name, std::span<const std::byte> bytes);
  [[nodiscard]] std::vector<Section> make_table(TaskContext& task) const;

  struct Part {
    std::string name;
    std::span<const std::byte> bytes;
  };
  std::vector<Part> parts_;
};

}  // namespace meshhood::inline v0_1::file
