// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "meshhood/run.h"

#include "io/byte_source.h"

namespace meshhood::inline v0_1::io {

/// A source that reports progress in bytes and can be cancelled. If the size is unknown, the reported total is 0.
class WatchedSource final : public ByteSource {
 public:
  /// `source` and `progress` are borrowed. `name` is the file in messages.
  WatchedSource(ByteSource& source, const Progress& progress, std::string name);

  [[nodiscard]] std::optional<std::uint64_t> size() const override { return source_.size(); }

  /// Reports, then reads at most 4 MB. Throws Error{Cancelled}.
  [[nodiscard]] std::size_t read(std::span<char> out) override;

  /// Reports the bytes read so far. Throws Error{Cancelled}.
  void report() const;

  /// Reports the total, even if the reader did not need all bytes. Throws Error{Cancelled}.
  void finish();

 private:
  ByteSource& source_;
  const Progress& progress_;
  std::string file_;
  std::uint64_t done_ = 0;
};

}  // namespace meshhood::inline v0_1::io
