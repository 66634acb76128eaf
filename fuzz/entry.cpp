// SPDX-License-Identifier: MIT
// The door through which libFuzzer calls a target.
#include <cstdint>

#include "target.h"

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  meshhood::fuzz::run(std::as_bytes(std::span(data, size)));
  return 0;
}
