// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <queue>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "support/oracle.h"
#include "support/test_mesh.h"

namespace meshhood::test {

/// A start of a search, with its filter, as the oracle sees it.
struct PlainStart {
  std::array<double, 3> center{};
  std::vector<std::uint32_t> seeds = {};
  std::vector<std::uint8_t> walls = {};    // #V
  std::vector<std::uint8_t> ignored = {};  // #V
};

/// Regions and connecting radii by the simplest means. Shares only the definition of distance with the library.
class RegionOracle {
 public:
  explicit RegionOracle(const TestMesh& mesh) : positions_(&mesh.positions), graph_(mesh) {}

  [[nodiscard]] const Oracle& graph() const { return graph_; }

  [[nodiscard]] double distance(const PlainStart& start, std::size_t w) const {
    const double* const p = positions_->data() + 3 * w;
    const double dx = start.center[0] - p[0];
    const double dy = start.center[1] - p[1];
    const double dz = start.center[2] - p[2];
    return std::sqrt((dx * dx + dy * dy) + dz * dz);
  }

  /// Ascending ids.
  [[nodiscard]] std::vector<std::uint32_t> region(const PlainStart& start, double radius) const {
    std::set<std::uint32_t> reached;
    std::vector<std::uint32_t> todo;
    const auto reach = [&](std::uint32_t v) {
      if (start.walls[v] == 0 && distance(start, v) <= radius && reached.insert(v).second) todo.push_back(v);
    };
    for (const std::uint32_t seed : start.seeds) reach(seed);
    while (!todo.empty()) {
      const std::uint32_t v = todo.back();
      todo.pop_back();
      for (const std::uint32_t w : graph_.neighbors(v)) reach(w);
    }
    std::vector<std::uint32_t> result;
    for (const std::uint32_t v : reached) {
      if (start.ignored[v] == 0) result.push_back(v);
    }
    return result;
  }

  /// By vertex; infinite where there is none up to `limit`.
  [[nodiscard]] std::vector<double> connecting_radii(const PlainStart& start, double limit = kInfinity) const {
    std::vector<double> radii = least(
        start, limit, [&](std::uint32_t seed) { return distance(start, seed); },
        [&](double radius, std::uint32_t, std::uint32_t w) { return std::max(radius, distance(start, w)); });
    for (std::size_t v = 0; v < radii.size(); ++v) {
      if (start.ignored[v] != 0) radii[v] = kInfinity;
    }
    return radii;
  }

  /// The least length of a path by a straight line to a seed and then along edges, by vertex, ignored ones included;
  /// infinite where there is none up to `limit`. `length(v, w)` is that of an edge.
  template <class Length>
  [[nodiscard]] std::vector<double> path_lengths(const PlainStart& start, double limit, Length&& length) const {
    return least(
        start, limit, [&](std::uint32_t seed) { return distance(start, seed); },
        [&](double sum, std::uint32_t v, std::uint32_t w) { return sum + length(v, w); });
  }

  /// The vertices with finite connecting radius by radius, distance and id.
  [[nodiscard]] std::vector<std::uint32_t> in_order(const PlainStart& start, const std::vector<double>& radii) const {
    std::vector<std::uint32_t> ids;
    for (std::uint32_t v = 0; v < radii.size(); ++v) {
      if (radii[v] < kInfinity) ids.push_back(v);
    }
    const auto key = [&](std::uint32_t v) { return std::tuple(radii[v], distance(start, v), v); };
    std::sort(ids.begin(), ids.end(), [&](std::uint32_t v, std::uint32_t w) { return key(v) < key(w); });
    return ids;
  }

 private:
  /// The algorithm of Dijkstra: the least value of a path to each vertex that is at most `limit`. A path has the value
  /// `first(seed)`, and `extend(value, v, w)` if an edge from `v` to `w` is added to one to `v`.
  template <class First, class Extend>
  [[nodiscard]] std::vector<double> least(const PlainStart& start, double limit, First&& first, Extend&& extend) const {
    std::vector<double> values(graph_.size(), kInfinity);
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    const auto offer = [&](std::uint32_t v, double value) {
      if (start.walls[v] != 0 || !(value <= limit) || values[v] <= value) return;
      values[v] = value;
      queue.emplace(value, v);
    };
    for (const std::uint32_t seed : start.seeds) offer(seed, first(seed));
    while (!queue.empty()) {
      const auto [value, v] = queue.top();
      queue.pop();
      if (value > values[v]) continue;
      for (const std::uint32_t w : graph_.neighbors(v)) offer(w, extend(value, v, w));
    }
    return values;
  }

  const std::vector<double>* positions_;
  Oracle graph_;
};

}  // namespace meshhood::test
