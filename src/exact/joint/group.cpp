// SPDX-License-Identifier: MIT
#include "exact/joint/group.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "base/vector.h"

namespace meshhood {
namespace {

/// Around everything: the frame is a cube with half an edge of 1.
constexpr FrameSphere kWholeFrame{0, 0, 0, 2};

FrameSphere node_bounds(const TreeLevel& level, std::size_t node) {
  const Group& group = level.groups[node / kFanOut];
  const std::size_t i = node % kFanOut;
  return {group.x[i], group.y[i], group.z[i], group.radius[i]};
}

/// Some vertices of the index relative to `centre`, in frame units.
template <class Real>
void convert(std::span<const Real> xyz, const Leaf& leaf, const Point& centre, double scale, LeafPoints& out) {
  out = {};
  for (std::size_t i = 0; i < leaf.size; ++i) {
    const Point p = scale * (point(xyz, leaf.first + i) - centre);
    out.x[i] = static_cast<float>(p.x);
    out.y[i] = static_cast<float>(p.y);
    out.z[i] = static_cast<float>(p.z);
    out.square[i] = (out.x[i] * out.x[i] + out.y[i] * out.y[i]) + out.z[i] * out.z[i];
  }
}

}  // namespace

JointGroup::JointGroup(const IndexView& index, const Kernels& kernels)
    : index_(&index),
      kernels_(&kernels),
      ball_({0, 0, 0}, TreeBounds(index.frame, 0)),
      slot_of_(index.leaf_count(), kUnknown) {}

void JointGroup::begin(std::span<const LeafId> leaves, const TreeBounds& low, const TreeBounds& high) {
  clear();
  set_sphere(leaves);
  ball_.outer = next_above(static_cast<double>(high.outer) + radius_);
  ball_.inner = -next_above(radius_ - static_cast<double>(low.inner));
  for (const LeafId leaf : leaves) {
    if (discover(leaf) == kNoSlot) slot_of_[leaf] = add_slot(leaf);  // of an index whose spheres are wrong
  }
  for (GroupSlot slot = 0; slot < leaves_.size(); ++slot) {
    if (is_core(slot)) continue;
    for (const Link& link : index_->links_of(leaves_[slot])) discover(link.leaf);
  }
  if (points_.size() < leaves_.size()) points_.resize(leaves_.size() + leaves_.size() / 2);
  has_points_.assign(leaves_.size(), 0);
}

void JointGroup::clear() {
  for (const LeafId leaf : touched_) slot_of_[leaf] = kUnknown;
  touched_.clear();
  leaves_.clear();
  spheres_.clear();
  cores_.clear();
  core_leaves_.clear();
  rims_.clear();
  core_ids_.clear();
}

void JointGroup::set_sphere(std::span<const LeafId> leaves) {
  const FrameSphere bounds =
      index_->tree.size() > 1 ? node_bounds(index_->tree[1], leaves.front() / kFanOut) : kWholeFrame;
  ball_.x = bounds.x;
  ball_.y = bounds.y;
  ball_.z = bounds.z;
  centre_ = index_->frame.origin + 1 / index_->frame.scale * centre_of(Sphere<float>{bounds.x, bounds.y, bounds.z, 0});
  // Where the coordinates are large for the size of the mesh, the centre is not quite that of the sphere.
  centre_in_frame_ = index_->frame.to_frame(centre_);
  const Point off = centre_in_frame_ - centre_of(Sphere<float>{bounds.x, bounds.y, bounds.z, 0});
  radius_ = static_cast<double>(bounds.radius) + length(off);
}

GroupSlot JointGroup::discover(LeafId leaf) {
  if (slot_of_[leaf] != kUnknown) return slot_of_[leaf];
  touched_.push_back(leaf);
  const Leaf& record = index_->leaves[leaf];
  const Containment side = classify(record.bounds, ball_);
  if (side == Containment::Outside) return slot_of_[leaf] = kNoSlot;
  if (side == Containment::Inside && record.connected) return add_core(leaf);
  return slot_of_[leaf] = add_slot(leaf);
}

GroupSlot JointGroup::add_slot(LeafId leaf) {
  leaves_.push_back(leaf);
  spheres_.push_back(index_->leaves[leaf].bounds);
  return static_cast<GroupSlot>(leaves_.size() - 1);
}

bool JointGroup::is_inside(LeafId leaf) const {
  const Leaf& record = index_->leaves[leaf];
  return record.connected && classify(record.bounds, ball_) == Containment::Inside;
}

GroupSlot JointGroup::add_core(LeafId leaf) {
  const auto core = static_cast<GroupSlot>(leaves_.size());
  const auto first_leaf = static_cast<std::uint32_t>(core_leaves_.size());
  const auto first_rim = static_cast<std::uint32_t>(rims_.size());
  leaves_.push_back(kCore + static_cast<LeafId>(cores_.size()));
  spheres_.push_back({0, 0, 0, 0});
  slot_of_[leaf] = core;
  core_leaves_.push_back(leaf);
  std::size_t vertices = 0;
  for (std::size_t head = first_leaf; head < core_leaves_.size(); ++head) {
    vertices += index_->leaves[core_leaves_[head]].size;
    for (const Link& link : index_->links_of(core_leaves_[head])) {
      GroupSlot slot = slot_of_[link.leaf];
      if (slot == kUnknown && is_inside(link.leaf)) {
        touched_.push_back(link.leaf);
        slot = slot_of_[link.leaf] = core;
        core_leaves_.push_back(link.leaf);
      } else if (slot == kUnknown) {
        slot = discover(link.leaf);
      }
      if (slot == core || slot == kNoSlot) continue;
      rims_.push_back({slot, kernels_->cross_edges(index_->cross_edges_of(link), link.boundary)});
    }
  }
  cores_.push_back({first_leaf, static_cast<std::uint32_t>(core_leaves_.size()), first_rim,
                    static_cast<std::uint32_t>(rims_.size()), vertices, 0, false});
  return core;
}

std::span<const JointGroup::RimLink> JointGroup::rim(GroupSlot core) const {
  const Core& found = cores_[leaves_[core] - kCore];
  return std::span(rims_).subspan(found.first_rim, found.end_rim - found.first_rim);
}

std::span<const LeafId> JointGroup::core_leaves(GroupSlot core) const {
  const Core& found = cores_[leaves_[core] - kCore];
  return std::span(core_leaves_).subspan(found.first_leaf, found.end_leaf - found.first_leaf);
}

std::span<const VertexId> JointGroup::core_ids(GroupSlot core) {
  Core& found = cores_[leaves_[core] - kCore];
  if (!found.has_ids) {
    found.has_ids = true;
    found.first_id = core_ids_.size();
    for (const LeafId leaf : core_leaves(core)) {
      const Leaf& record = index_->leaves[leaf];
      for (std::size_t i = 0; i < record.size; ++i) core_ids_.push_back(index_->id(record.first + i));
    }
  }
  return std::span(core_ids_).subspan(found.first_id, found.vertices);
}

const LeafPoints& JointGroup::points(GroupSlot slot) {
  if (has_points_[slot] == 0) {
    has_points_[slot] = 1;
    std::visit(
        [&](auto xyz) { convert(xyz, index_->leaves[leaves_[slot]], centre_, index_->frame.scale, points_[slot]); },
        index_->positions);
  }
  return points_[slot];
}

}  // namespace meshhood
