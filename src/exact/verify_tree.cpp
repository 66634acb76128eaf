// SPDX-License-Identifier: MIT
#include <bit>
#include <cmath>
#include <cstring>
#include <string>

#include "exact/build/tree.h"
#include "exact/verify.h"

namespace meshhood::inline v0_1::file {
namespace {

class TreeCheck {
 public:
  TreeCheck(const IndexView& index, const SectionReader& file) : index_(index), file_(file) {}

  void run() const {
    for (std::size_t group = 0; group < index_.groups.size(); ++group) {
      for (std::size_t i = 0; i < kFanOut; ++i) check_node(group, i);
    }
    for (std::size_t level = 0; level < index_.tree.size(); ++level) check_mean(level);
    for (std::size_t leaf = 0; leaf < index_.leaf_count(); ++leaf) {
      if (index_.leaves[leaf].size == 0) continue;
      check_same_sphere(leaf);
      check_enclosed(leaf);
    }
  }

 private:
  void check_mean(std::size_t level) const {
    const TreeLevel& own = index_.tree[level];
    const double mean = mean_radius(index_.groups.subspan(own.first_group, own.groups),
                                    index_.records.subspan(own.first_group, own.groups));
    if (std::bit_cast<std::uint64_t>(mean) != std::bit_cast<std::uint64_t>(index_.mean_radii[level])) {
      file_.refuse(&index_.mean_radii[level], "level " + std::to_string(level) + ": the mean radius is wrong");
    }
  }

  [[nodiscard]] FrameSphere sphere(std::size_t node) const {
    const Group& g = index_.groups[node / kFanOut];
    const std::size_t i = node % kFanOut;
    return {g.x[i], g.y[i], g.z[i], g.radius[i]};
  }

  void check_node(std::size_t group, std::size_t i) const {
    const Group& g = index_.groups[group];
    if (i >= index_.records[group].nodes) {
      if (!is_absent(g, i)) file_.refuse(&g, name(group * kFanOut + i) + ": expected an absent node");
      return;
    }
    const bool is_finite =
        std::isfinite(g.x[i]) && std::isfinite(g.y[i]) && std::isfinite(g.z[i]) && std::isfinite(g.radius[i]);
    if (is_finite && g.radius[i] > 0) return;
    file_.refuse(&g, name(group * kFanOut + i) + ": the bounding sphere is not valid");
  }

  void check_same_sphere(std::size_t leaf) const {
    const FrameSphere in_tree = sphere(leaf);
    // Both are copies of the same sphere. NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
    if (std::memcmp(&in_tree, &index_.leaves[leaf].bounds, sizeof(FrameSphere)) == 0) return;
    file_.refuse(&index_.leaves[leaf],
                 "leaf " + std::to_string(leaf) + ": the bounding sphere differs from that in the tree");
  }

  void check_enclosed(std::size_t leaf) const {
    for (unsigned lane = 0; lane < index_.leaves[leaf].size; ++lane) {
      const Point p = index_.frame.to_frame(index_.position(static_cast<LeafId>(leaf), lane));
      for (auto node = static_cast<NodeId>(leaf); node != kNoNode; node = index_.parents[node / kFanOut]) {
        const FrameSphere bounds = sphere(node);
        const auto radius = static_cast<double>(bounds.radius);
        if (squared_distance(center_of(bounds), p) <= radius * radius) continue;
        file_.refuse(&index_.groups[node / kFanOut], name(node) + ": the bounding sphere does not enclose lane " +
                                                         std::to_string(lane) + " of leaf " + std::to_string(leaf));
      }
    }
  }

  static std::string name(std::size_t node) { return "node " + std::to_string(node); }

  const IndexView& index_;
  const SectionReader& file_;
};

}  // namespace

void verify_tree(const IndexView& index, const SectionReader& file) { TreeCheck(index, file).run(); }

}  // namespace meshhood::inline v0_1::file
