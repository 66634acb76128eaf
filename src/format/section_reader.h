// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "base/parallel.h"
#include "format/format.h"

namespace meshhood::file {

/// As the public one. Throws Error{MalformedIndex} unless `size` bytes that begin so have a header of this format, and
/// end where it says.
[[nodiscard]] Header read_header(std::span<const std::byte> first_bytes, std::uint64_t size);

/// Throws Error{MalformedIndex} unless an index of `kind` is of the kind that is expected.
void expect_kind(IndexKind kind, IndexKind expected);

/// The sections of a saved index. All errors are Error{MalformedIndex} and name section and byte.
class SectionReader {
 public:
  /// Verifies the header, and that the sections follow one another without a gap, to the end.
  /// `bytes` begin at a multiple of `kIndexAlignment` and outlive the reader.
  explicit SectionReader(std::span<const std::byte> bytes);

  [[nodiscard]] const Header& header() const { return header_; }

  /// The next section, which must be `name`, in place.
  template <class T>
  [[nodiscard]] std::span<const T> take(std::string_view name) {
    static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= kIndexAlignment);
    const std::span<const std::byte> bytes = take_bytes(name, sizeof(T));
    return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
  }

  /// The same, of `count` values.
  template <class T>
  [[nodiscard]] std::span<const T> take(std::string_view name, std::uint64_t count) {
    const std::span<const T> values = take<T>(name);
    if (values.size() != count) refuse_count(values.size(), count);
    return values;
  }

  /// Refuses where a section is left that was not taken.
  void expect_end() const;

  /// Refuses unless the bytes of every section are those that were saved, and those between them are zero. A part of
  /// the work for each section.
  void verify_checksums(TaskContext& task) const;

  /// Refuses where `place` lies: the byte and its section go before the message.
  [[noreturn]] void refuse(const void* place, const std::string& message) const;

  /// Refuses the byte of a section that was taken before, counted from its first.
  [[noreturn]] void refuse_in(std::string_view section, std::uint64_t byte, const std::string& message) const;

  /// Refuses the section taken last as a whole; it may be empty, and so have no place of its own.
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

}  // namespace meshhood::file
