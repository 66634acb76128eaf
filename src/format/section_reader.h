// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "format/format.h"
#include "shared/distance.h"
#include "shared/parallel.h"

namespace meshhood::inline v0_1::file {

/// The header of an index file of `size` bytes that begins with `first_bytes`. Throws Error{MalformedIndex} if it is
/// not valid, not of this format, or states another size.
[[nodiscard]] Header read_header(std::span<const std::byte> first_bytes, std::uint64_t size);

/// Throws Error{MalformedIndex} if the kinds differ.
void expect_kind(IndexKind kind, IndexKind expected);

/// Reads the sections of an index file in order. All errors are Error{MalformedIndex} and name the section and the
/// byte.
class SectionReader {
 public:
  /// Verifies the header, and that the sections follow one another without a gap to the end of the file.
  /// `bytes` must begin at a multiple of `kIndexAlignment` and outlive the reader.
  explicit SectionReader(std::span<const std::byte> bytes);

  [[nodiscard]] const Header& header() const { return header_; }

  /// Whether there is a next section, and has this name.
  [[nodiscard]] bool is_next(std::string_view name) const;

  /// The next section, which must have this name; a view of the bytes.
  template <class T>
  [[nodiscard]] std::span<const T> take(std::string_view name) {
    static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= kIndexAlignment);
    const std::span<const std::byte> bytes = take_bytes(name, sizeof(T));
    return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
  }

  /// The same, which must have `count` elements.
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

  /// The same for a byte of a section, counted from the first byte of the section.
  [[noreturn]] void refuse_in(std::string_view section, std::uint64_t byte, const std::string& message) const;

  /// The same for the section taken last, which may be empty.
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

}  // namespace meshhood::inline v0_1::file
