// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

/// The exact index of another commit, in the same process. That commit is compiled with `meshhood` renamed to
/// `meshhood_before`, so this interface has no type of the library.
namespace before {

/// A mesh as the other commit reads it: packed positions of one of the two precisions, and the rows of the graph.
struct Graph {
  std::span<const float> floats;
  std::span<const double> doubles;
  std::span<const std::uint32_t> offsets;
  std::span<const std::uint32_t> neighbors;
};

class Engine {
 public:
  virtual ~Engine() = default;
  virtual void neighborhood(std::uint32_t v, double radius, std::vector<std::uint32_t>& out) = 0;
  [[nodiscard]] virtual std::size_t count(std::uint32_t v, double radius) = 0;
  [[nodiscard]] virtual std::size_t bytes() const = 0;
};

/// Builds the index. `graph` may be destroyed afterwards.
[[nodiscard]] std::unique_ptr<Engine> build(const Graph& graph);

}  // namespace before
