// SPDX-License-Identifier: MIT
// The reader of one format: MESHHOOD_READER is its name.
#include "io/readers.h"
#include "read.h"
#include "target.h"

void meshhood::fuzz::run(std::span<const std::byte> bytes) { read(bytes, io::MESHHOOD_READER); }
