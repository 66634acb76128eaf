// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

#include "support/test_mesh.h"

namespace meshhood::test {

/// Correct answers by the simplest means. Shares only the definition of distance with the library.
class Oracle {
 public:
  explicit Oracle(const TestMesh& mesh);

  [[nodiscard]] std::size_t size() const { return neighbors_.size(); }
  [[nodiscard]] const std::set<std::uint32_t>& neighbors(std::size_t v) const { return neighbors_[v]; }

  /// The number of the component of a vertex.
  [[nodiscard]] std::size_t component(std::size_t v) const { return component_[v]; }

  [[nodiscard]] double distance(std::size_t v, std::size_t w) const;

  /// The mean length of the distinct edges; 0 if there is none.
  [[nodiscard]] double mean_edge() const;

  /// Ascending ids.
  [[nodiscard]] std::vector<std::uint32_t> exact(std::uint32_t v, double radius) const;
  [[nodiscard]] std::vector<std::uint32_t> ball(std::uint32_t v, double radius) const;

 private:
  const std::vector<double>* positions_;
  std::vector<std::set<std::uint32_t>> neighbors_;
  std::vector<std::size_t> component_;
};

/// A breadth-first search from `v` over the vertices for which `inside(w)` holds; ascending ids.
template <class Inside>
std::vector<std::uint32_t> connected(const std::vector<std::set<std::uint32_t>>& neighbors, std::uint32_t v,
                                     Inside&& inside) {
  std::vector<bool> seen(neighbors.size());
  std::vector<std::uint32_t> reached{v};
  seen[v] = true;
  for (std::size_t head = 0; head < reached.size(); ++head) {
    for (const std::uint32_t w : neighbors[reached[head]]) {
      if (seen[w]) continue;
      seen[w] = true;
      if (inside(w)) reached.push_back(w);
    }
  }
  std::sort(reached.begin(), reached.end());
  return reached;
}

}  // namespace meshhood::test
