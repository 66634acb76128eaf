// SPDX-License-Identifier: MIT
#include "io/readers.h"
#include "read.h"
#include "target.h"

void meshhood::fuzz::run(std::span<const std::byte> bytes) { read(bytes, io::read_vtk); }
