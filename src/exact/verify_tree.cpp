// SPDX-License-Identifier: MIT
#include <bit>
#include <cmath>
#include <cstring>
#include <string>

#include "exact/build/tree.h"
#include "exact/verify.h"

namespace meshhood::file {
namespace {

class TreeCheck {
 public:
  TreeCheck(const IndexView& index, const SectionReader& file) : index_(index), file_(file) {}

  void run() const {
    for (std::size_t level = 0; level < index_.tree.size(); ++level) {
      for (std::size_t node = 0; node < index_.tree[level].nodes; ++node) check_numbers(level, node);
      check_absent(level);
      const double mean = mean_radius(index_.tree[level].groups, index_.tree[level].nodes);
      if (std::bit_cast<std::uint64_t>(mean) != std::bit_cast<std::uint64_t>(index_.mean_radii[level])) {
        file_.refuse(&index_.mean_radii[level], "level " + std::to_string(level) + ": the mean radius is wrong");
      }
    }
    for (std::size_t leaf = 0; leaf < index_.leaf_count(); ++leaf) {
      check_same_sphere(leaf);
      check_enclosed(leaf);
    }
  }

 private:
  [[nodiscard]] const Group& group(std::size_t level, std::size_t node) const {
    return index_.tree[level].groups[node / kFanOut];
  }

  [[nodiscard]] FrameSphere sphere(std::size_t level, std::size_t node) const {
    const Group& g = group(level, node);
    const std::size_t i = node % kFanOut;
    return {g.x[i], g.y[i], g.z[i], g.radius[i]};
  }

  /// The offset may be infinite, which means an unbounded region; the comparison rejects NaN.
  void check_numbers(std::size_t level, std::size_t node) const {
    const Group& g = group(level, node);
    const std::size_t i = node % kFanOut;
    const bool is_finite = std::isfinite(g.x[i]) && std::isfinite(g.y[i]) && std::isfinite(g.z[i]) &&
                           std::isfinite(g.radius[i]) && std::isfinite(g.slope_x[i]) && std::isfinite(g.slope_y[i]) &&
                           std::isfinite(g.slope_z[i]);
    if (is_finite && g.radius[i] > 0 && g.offset[i] > 0) return;  // mutant: empty-sphere-accepted
    file_.refuse(&g, name(level, node) + ": the bounding sphere or minimum region is not valid");
  }

  void check_absent(std::size_t level) const {
    const Group& last = index_.tree[level].groups.back();
    for (std::size_t node = index_.tree[level].nodes; node % kFanOut != 0; ++node) {
      // mutant: unused-node-accepted
      if (!is_absent(last, node % kFanOut)) file_.refuse(&last, name(level, node) + ": expected an absent node");
    }
  }

  void check_same_sphere(std::size_t leaf) const {
    const FrameSphere in_tree = sphere(0, leaf);
    // Both are copies of the same sphere. NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
    if (std::memcmp(&in_tree, &index_.leaves[leaf].bounds, sizeof(FrameSphere)) == 0) return;
    file_.refuse(&index_.leaves[leaf],
                 "leaf " + std::to_string(leaf) + ": the bounding sphere differs from that in the tree");
  }

  void check_enclosed(std::size_t leaf) const {
    for (unsigned lane = 0; lane < index_.leaves[leaf].size; ++lane) {
      const Point p = index_.frame.to_frame(index_.position(static_cast<LeafId>(leaf), lane));
      std::size_t node = leaf;
      for (std::size_t level = 0; level < index_.tree.size(); ++level, node /= kFanOut) {
        const FrameSphere bounds = sphere(level, node);
        const auto radius = static_cast<double>(bounds.radius);
        if (squared_distance(centre_of(bounds), p) <= radius * radius) continue;  // mutant: sphere-need-not-enclose
        file_.refuse(&group(level, node), name(level, node) + ": the bounding sphere does not enclose lane " +
                                              std::to_string(lane) + " of leaf " + std::to_string(leaf));
      }
    }
  }

  static std::string name(std::size_t level, std::size_t node) {
    return "level " + std::to_string(level) + ": node " + std::to_string(node);
  }

  const IndexView& index_;
  const SectionReader& file_;
};

}  // namespace

void verify_tree(const IndexView& index, const SectionReader& file) { TreeCheck(index, file).run(); }

}  // namespace meshhood::file
