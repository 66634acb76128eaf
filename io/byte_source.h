// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "io/descriptor.h"

namespace meshhood::io {

/// Where the bytes of a mesh or an index come from.
class ByteSource {
 public:
  ByteSource() = default;
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;
  virtual ~ByteSource() = default;

  /// How many bytes there are in all, where that is known beforehand: not for a pipe or a device.
  [[nodiscard]] virtual std::optional<std::uint64_t> size() const = 0;

  /// Fills the front of `out` and returns how much of it; 0 at the end only.
  [[nodiscard]] virtual std::size_t read(std::span<char> out) = 0;
};

/// Bytes in memory, borrowed.
class MemorySource final : public ByteSource {
 public:
  explicit MemorySource(std::span<const std::byte> bytes) : bytes_(bytes), left_(bytes) {}

  [[nodiscard]] std::optional<std::uint64_t> size() const override { return bytes_.size(); }
  [[nodiscard]] std::size_t read(std::span<char> out) override;

 private:
  std::span<const std::byte> bytes_;
  std::span<const std::byte> left_;
};

/// A file, pipe or device, read in one pass. All errors are Error{IoFailure}, naming the path.
class FileSource final : public ByteSource {
 public:
  explicit FileSource(const std::filesystem::path& path);

  [[nodiscard]] std::optional<std::uint64_t> size() const override { return size_; }
  [[nodiscard]] std::size_t read(std::span<char> out) override;

  /// Whether it is neither pipe nor device.
  [[nodiscard]] bool is_ordinary() const { return is_ordinary_; }

  /// Calls `f` whenever nothing has come for a moment, for whoever would rather stop. What it throws, `read` passes on.
  void while_waiting(std::function<void()> f) { while_waiting_ = std::move(f); }

 private:
  [[nodiscard]] bool wait_for_bytes(std::chrono::steady_clock::duration patience) const;
  [[noreturn]] void fail(const std::string& reason) const;

  std::string name_;
  Descriptor file_;
  std::optional<std::uint64_t> size_;
  bool is_ordinary_ = false;
  bool may_lack_a_writer_ = false;
  std::function<void()> while_waiting_;
};

}  // namespace meshhood::io
