// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "format/format.h"
#include "shared/parallel.h"

namespace meshhood::inline v0_1::file {

/// Collects sections, then writes the index file to a sink. The arrays are borrowed.
class SectionWriter {
 public:
  template <class T>
  void add(std::string_view name, std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    add_bytes(name, std::as_bytes(values));
  }

  /// By how much `write` advances its task.
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
