// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "shapes.h"

/// Each function generates a shape of `n` vertices; `n` is at least the minimum of the kind (see `kinds`).
namespace meshhood::shapes {

// flat.cpp
[[nodiscard]] Shape grid(std::size_t n);
[[nodiscard]] Shape quads(std::size_t n);
[[nodiscard]] Shape ngons(std::size_t n);
[[nodiscard]] Shape noise(std::size_t n);

// folded.cpp
[[nodiscard]] Shape book(std::size_t n);
[[nodiscard]] Shape comb(std::size_t n);
[[nodiscard]] Shape folds(std::size_t n);
[[nodiscard]] Shape plates(std::size_t n);
[[nodiscard]] Shape scroll(std::size_t n);
[[nodiscard]] Shape strip(std::size_t n);

// gyroid.cpp
[[nodiscard]] Shape gyroid(std::size_t n);

// closed.cpp
[[nodiscard]] Shape knot(std::size_t n);
[[nodiscard]] Shape soup(std::size_t n);
[[nodiscard]] Shape sphere(std::size_t n);

// graphs.cpp
[[nodiscard]] Shape isolated(std::size_t n);
[[nodiscard]] Shape path(std::size_t n);
[[nodiscard]] Shape star(std::size_t n);

}  // namespace meshhood::shapes
