// SPDX-License-Identifier: MIT
#include "support/oracle.h"

#include <cmath>

namespace meshhood::test {

Oracle::Oracle(const TestMesh& mesh) : positions_(&mesh.positions), neighbors_(mesh.size()) {
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto corners = mesh.face(f);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::uint32_t v = corners[i];
      const std::uint32_t w = corners[(i + 1) % corners.size()];
      if (v == w) continue;
      neighbors_[v].insert(w);
      neighbors_[w].insert(v);
    }
  }
  component_.assign(size(), size());
  for (std::size_t v = 0; v < size(); ++v) {
    if (component_[v] != size()) continue;
    const auto everywhere = [](std::uint32_t) { return true; };
    for (const auto w : connected(neighbors_, static_cast<std::uint32_t>(v), everywhere)) component_[w] = v;
  }
}

double Oracle::distance(std::size_t v, std::size_t w) const {
  const double* const p = positions_->data() + 3 * v;
  const double* const q = positions_->data() + 3 * w;
  const double dx = p[0] - q[0];
  const double dy = p[1] - q[1];
  const double dz = p[2] - q[2];
  return std::sqrt((dx * dx + dy * dy) + dz * dz);
}

double Oracle::mean_edge() const {
  double sum = 0;
  std::size_t ends = 0;
  for (std::size_t v = 0; v < size(); ++v) {
    for (const std::uint32_t w : neighbors_[v]) sum += distance(v, w);
    ends += neighbors_[v].size();
  }
  return ends == 0 ? 0 : sum / static_cast<double>(ends);
}

std::vector<std::uint32_t> Oracle::exact(std::uint32_t v, double radius) const {
  return connected(neighbors_, v, [&](std::uint32_t w) { return distance(v, w) <= radius; });
}

std::vector<std::uint32_t> Oracle::ball(std::uint32_t v, double radius) const {
  std::vector<std::uint32_t> result;
  for (std::uint32_t w = 0; w < size(); ++w) {
    if (distance(v, w) <= radius) result.push_back(w);
  }
  return result;
}

}  // namespace meshhood::test
