// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "meshhood/progress.h"

#include "io/byte_source.h"

namespace meshhood::io {

/// Another source, whose reader may be told how far it is, and to stop. Parts are bytes; without a size beforehand
/// their total is 0.
class WatchedSource final : public ByteSource {
 public:
  /// `source` and `progress` are borrowed. `name` stands for the file in messages.
  WatchedSource(ByteSource& source, const Progress& progress, const std::string& name);

  [[nodiscard]] std::optional<std::uint64_t> size() const override { return source_.size(); }

  /// Tells, then reads as much as takes no time to speak of. Throws Error{Cancelled}.
  [[nodiscard]] std::size_t read(std::span<char> out) override;

  /// Tells again how much has been read so far. Throws Error{Cancelled}.
  void report() const;

  /// Tells that nothing is left, whether or not all of it was wanted. Throws Error{Cancelled}.
  void finish();

 private:
  ByteSource& source_;
  const Progress& progress_;
  std::string file_;
  std::uint64_t done_ = 0;
};

}  // namespace meshhood::io
