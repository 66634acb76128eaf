// SPDX-License-Identifier: MIT
#include <array>

#include "io/readers.h"
#include "read.h"
#include "target.h"

namespace meshhood::fuzz {
namespace {

/// Detects the format by content, or else by a file extension that is drawn from the content.
io::Mesh read_any(io::InputBuffer& input, const io::ReaderOptions& options) {
  constexpr std::array kNames{"fuzz", "fuzz.ply", "fuzz.obj", "fuzz.off", "fuzz.stl"};
  const auto format = io::detect_format(input, kNames[input.size().value_or(0) % kNames.size()]);
  return io::read_format(format, input, options);
}

}  // namespace

void run(std::span<const std::byte> bytes) { read(bytes, read_any); }

}  // namespace meshhood::fuzz
