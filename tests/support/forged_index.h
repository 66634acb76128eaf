// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstring>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <gmock/gmock.h>

#include "meshhood/error.h"
#include "meshhood/index.h"

#include "exact/index_access.h"
#include "exact/layout.h"
#include "format/format.h"
#include "shared/checksum.h"
#include "support/index_bytes.h"

namespace meshhood::test {

template <class T, class Allocator>
void copy_array(std::vector<T, Allocator>& to, std::span<const T> from) {
  to.assign(from.begin(), from.end());
}

inline void copy_array(OrderedPositions& to, const PositionsInOrder& from) {
  std::visit([&]<class Real>(std::span<const Real> xyz) { to = RawVector<Real>(xyz.begin(), xyz.end()); }, from);
}

/// A copy of the arrays of `index`, for tests that damage them.
[[nodiscard]] inline IndexData arrays_of(const Index& index) {
  const IndexView& from = IndexAccess::view(index);
  IndexData to;
  to.frame = from.frame;
  for_each_array([](ArrayInfo, auto& copy, const auto& array) { copy_array(copy, array); }, to, from);
  return to;
}

/// The header of a saved index.
[[nodiscard]] inline file::Header header_of(std::span<const std::byte> bytes) {
  file::Header header;
  std::memcpy(&header, bytes.data(), sizeof(header));
  return header;
}

/// The section table of a saved index, as far as the bytes reach.
[[nodiscard]] inline std::vector<file::Section> table_of(std::span<const std::byte> bytes) {
  std::vector<file::Section> table;
  const file::Header header = header_of(bytes);
  if (file::head_bytes(header.sections) > bytes.size()) return table;
  table.resize(header.sections);
  if (!table.empty()) std::memcpy(table.data(), bytes.data() + sizeof(header), std::as_bytes(std::span(table)).size());
  return table;
}

/// The beginning of the error message for a changed byte `byte`.
[[nodiscard]] inline std::string beginning_of_error(std::span<const std::byte> bytes, std::size_t byte) {
  std::string name = "header";
  for (const file::Section& section : table_of(bytes)) {
    if (section.begin <= byte) name = "section " + std::string(section.name.data());
  }
  return name + ", byte ";
}

/// Whether the error message begins with the location of the fault.
[[nodiscard]] inline bool names_a_place(std::string_view message) {
  const std::string_view where = message.substr(0, message.find(": "));
  return (where.starts_with("header, ") || where.starts_with("section ")) && where.find("byte ") != where.npos;
}

/// The error for bytes that `load` refuses; empty if they are accepted.
template <class Load>
[[nodiscard]] std::string refusal_by(Load&& load) {
  try {
    static_cast<void>(load());
    return {};
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::MalformedIndex) << error.what();
    EXPECT_TRUE(names_a_place(error.what())) << error.what();
    return error.what();
  }
}

/// Corrects the checksum of the header and the table.
inline void seal_header(std::span<std::byte> bytes) {
  file::Header header = header_of(bytes);
  const std::uint64_t head = file::head_bytes(header.sections);
  if (head > bytes.size()) return;
  const std::span<const std::byte> all = bytes;
  header.checksum = checksum(
      {all.first(offsetof(file::Header, checksum)), all.first(static_cast<std::size_t>(head)).subspan(sizeof(header))});
  std::memcpy(bytes.data(), &header, sizeof(header));
}

/// Corrects all checksums, as an attacker can.
inline void seal(std::span<std::byte> bytes) {
  if (bytes.size() < sizeof(file::Header)) return;
  std::vector<file::Section> table = table_of(bytes);
  for (file::Section& section : table) {
    if (section.begin > bytes.size() || section.bytes > bytes.size() - section.begin) continue;
    section.checksum =
        checksum({bytes.subspan(static_cast<std::size_t>(section.begin), static_cast<std::size_t>(section.bytes))});
  }
  if (!table.empty()) std::memcpy(bytes.data() + sizeof(file::Header), table.data(), table.size() * sizeof(table[0]));
  seal_header(bytes);
}

/// A saved index whose bytes a test changes.
class Forgery {
 public:
  explicit Forgery(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}

  /// A section, to be changed in place.
  [[nodiscard]] file::Header& header() { return *reinterpret_cast<file::Header*>(bytes_.data()); }

  [[nodiscard]] std::span<file::Section> table() {
    return {reinterpret_cast<file::Section*>(bytes_.data() + sizeof(file::Header)), header().sections};
  }

  [[nodiscard]] file::Section& entry(std::string_view name) {
    for (file::Section& section : table()) {
      if (name_of(section) == name) return section;
    }
    throw std::out_of_range("no such section");
  }

  template <class T>
  [[nodiscard]] std::span<T> section(std::string_view name) {
    const file::Section& found = entry(name);
    return {reinterpret_cast<T*>(bytes_.data() + found.begin), static_cast<std::size_t>(found.bytes) / sizeof(T)};
  }

  /// Makes a section empty and moves the later ones forward.
  void remove_content(std::string_view name) {
    const file::Section& removed = entry(name);
    const std::uint64_t bytes = file::aligned(removed.bytes);
    const auto begin = bytes_.begin() + static_cast<std::ptrdiff_t>(removed.begin);
    bytes_.erase(begin, begin + static_cast<std::ptrdiff_t>(bytes));
    header().bytes -= bytes;
    bool is_behind = false;
    for (file::Section& section : table()) {
      if (is_behind) section.begin -= bytes;
      is_behind = is_behind || name_of(section) == name;
    }
    entry(name).bytes = 0;
  }

  [[nodiscard]] std::vector<std::byte>& bytes() { return bytes_; }

 private:
  static std::string_view name_of(const file::Section& section) {
    const std::string_view all(section.name.data(), section.name.size());
    return all.substr(0, all.find('\0'));
  }

  std::vector<std::byte> bytes_;
};

/// Expects that `load` refuses the bytes of a saved index after `change`, although their checksums are right.
template <class Load>
void expect_refused_after(const char* cause, std::vector<std::byte> bytes, const std::function<void(Forgery&)>& change,
                          Load&& load) {
  Forgery forgery(std::move(bytes));
  change(forgery);
  seal(forgery.bytes());
  EXPECT_THAT(refusal_by([&] { return load(forgery.bytes()); }), testing::HasSubstr(cause));
}

}  // namespace meshhood::test
