// SPDX-License-Identifier: MIT
#include "exact/joint/group.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "base/vector.h"
#include "exact/node_search.h"

namespace meshhood::inline v0_1 {
namespace {

/// This sphere contains every vertex, because the frame is the cube [-1, 1]^3.
constexpr FrameSphere kWholeFrame{0, 0, 0, 2};

/// Returns the positions, or null if they are doubles.
const float* float_positions(const IndexView& index) {
  const auto* xyz = std::get_if<std::span<const float>>(&index.positions);
  return xyz == nullptr ? nullptr : xyz->data();
}

/// Returns the nearest float. It is not inlined, because g++ 12 omits both conversions where it converts two numbers at
/// once.
[[gnu::noinline]] double rounded(double value) { return static_cast<double>(static_cast<float>(value)); }

/// Converts the vertices of a leaf to points relative to `center`, in frame units.
template <class Real>
void convert(std::span<const Real> xyz, const Leaf& leaf, const Point& center, double scale, LeafPoints& out) {
  out = {};
  for (std::size_t i = 0; i < leaf.size; ++i) {
    const Point p = scale * (point(xyz, leaf.first + i) - center);
    out.x[i] = static_cast<float>(p.x);
    out.y[i] = static_cast<float>(p.y);
    out.z[i] = static_cast<float>(p.z);
    out.square[i] = (out.x[i] * out.x[i] + out.y[i] * out.y[i]) + out.z[i] * out.z[i];
  }
}

}  // namespace

JointGroup::JointGroup(const IndexView& index, Isa isa)
    : index_(&index),
      kernels_(&kernels(isa)),
      joint_kernels_(&joint_kernels(isa)),
      in_floats_(float_positions(index) != nullptr && index.frame.scale >= 0x1p-100 && index.frame.scale <= 0x1p100),
      ball_({0, 0, 0}, TreeBounds(index.frame, 0)),
      entry_of_(index.leaf_count(), kUnknown) {}

void JointGroup::begin(std::span<const LeafId> leaves, const TreeBounds& low, const TreeBounds& high) {
  clear();
  set_sphere(leaves);
  group_ = leaves.front() / kFanOut;
  high_ = high.outer;
  ball_.outer = next_above(static_cast<double>(high.outer) + radius_);
  ball_.inner = -next_above(radius_ - static_cast<double>(low.inner));
  for (const LeafId leaf : leaves) {
    if (discover(leaf) == kNoEntry) entry_of_[leaf] = add_entry(leaf);  // then the spheres of the index are wrong
  }
  for (GroupEntry entry = 0; entry < leaves_.size(); ++entry) {
    if (is_core(entry)) continue;
    for (const Link& link : index_->links_of(leaves_[entry])) discover(link.leaf);
  }
  if (points_.size() < size()) points_.resize(size() + size() / 2);
  has_points_.assign(size(), 0);
  link_ranges_.assign(size(), {kUnknown, kUnknown});
}

std::span<const JointGroup::EntryLink> JointGroup::links(GroupEntry entry) {
  LinkRange& range = link_ranges_[entry];
  if (range.begin == kUnknown) {
    range.begin = static_cast<std::uint32_t>(links_.size());
    for (const Link& link : index_->links_of(leaves_[entry])) {
      const GroupEntry other = entry_of_[link.leaf];
      if (other != kNoEntry) links_.push_back({other, link.boundary, index_->cross_edges_of(link)});
    }
    range.end = static_cast<std::uint32_t>(links_.size());
  }
  return std::span(links_).subspan(range.begin, range.end - range.begin);
}

void JointGroup::clear() {
  for (const LeafId leaf : touched_) entry_of_[leaf] = kUnknown;
  touched_.clear();
  leaves_.clear();
  spheres_.clear();
  eights_.clear();
  cores_.clear();
  core_leaves_.clear();
  core_links_.clear();
  last_core_link_.clear();
  links_.clear();
}

void JointGroup::set_sphere(std::span<const LeafId> leaves) {
  const NodeId parent = index_->parents[leaves.front() / kFanOut];
  const FrameSphere bounds = parent != kNoNode ? sphere_of(*index_, parent) : kWholeFrame;
  ball_.x = bounds.x;
  ball_.y = bounds.y;
  ball_.z = bounds.z;
  center_ = index_->frame.from_frame(center_of(bounds));
  if (in_floats_) center_ = {rounded(center_.x), rounded(center_.y), rounded(center_.z)};
  // Where the coordinates are large for the size of the mesh, the center is not quite that of the sphere.
  center_in_frame_ = index_->frame.to_frame(center_);
  const Point off = center_in_frame_ - center_of(bounds);
  radius_ = static_cast<double>(bounds.radius) + length(off);
}

GroupEntry JointGroup::discover(LeafId leaf) {
  if (entry_of_[leaf] != kUnknown) return entry_of_[leaf];
  touched_.push_back(leaf);
  const Leaf& record = index_->leaves[leaf];
  const Containment side = classify(record.bounds, ball_);
  if (side == Containment::Outside || !meets_a_leaf(record.bounds)) return entry_of_[leaf] = kNoEntry;
  if (side == Containment::Inside && fits_into_core(leaf)) return add_core(leaf);
  return entry_of_[leaf] = add_entry(leaf);
}

/// Returns whether a ball around a vertex of the group may meet the sphere. The sphere of the group alone would admit
/// many more leaves where the radius is small.
bool JointGroup::meets_a_leaf(const FrameSphere& sphere) const {
  TreeBall ball = ball_;
  ball.x = sphere.x;
  ball.y = sphere.y;
  ball.z = sphere.z;
  ball.outer = next_above(static_cast<double>(high_) + static_cast<double>(sphere.radius));
  GroupContainment sides;
  kernels_->classify(index_->groups.data(), std::span(&group_, 1), ball, &sides);
  return (sides.inside | sides.intersecting) != 0;
}

GroupEntry JointGroup::add_entry(LeafId leaf) {
  const Leaf& record = index_->leaves[leaf];
  add_to_eights(leaf, record.bounds, record.connected);
  prefetch(record);
  return static_cast<GroupEntry>(leaves_.size() - 1);
}

/// Prefetches the data that a packet reads of a leaf that it reaches. At small radii, few packets reach an entry, so
/// its data is rarely in the cache.
void JointGroup::prefetch(const Leaf& leaf) const {
  constexpr std::size_t kEdgeLines = 2;  // a leaf has some 50 edges to others
  prefetch_positions(*index_, leaf.first, leaf.size);
  fetch_lines(&index_->adjacency[leaf.first], kLeafCapacity * sizeof(LaneMask) / kCacheLine + 1);
  fetch_lines(&index_->cross_edges[index_->links[leaf.first_link].first_cross_edge], kEdgeLines);
}

/// Adds an entry to the arrays that are side by side.
void JointGroup::add_to_eights(LeafId leaf, const FrameSphere& sphere, bool connected) {
  const std::size_t i = leaves_.size() % kFanOut;
  if (i == 0) {
    spheres_.emplace_back();
    eights_.push_back({0, 0});
  }
  leaves_.push_back(leaf);
  Group& spheres = spheres_.back();
  spheres.x[i] = sphere.x;
  spheres.y[i] = sphere.y;
  spheres.z[i] = sphere.z;
  spheres.radius[i] = sphere.radius;
  eights_.back().connected |= static_cast<std::uint8_t>(connected) << i;
}

/// Returns whether a leaf that lies in every ball may be a part of a core, of which a query has all vertices or none.
bool JointGroup::fits_into_core(LeafId leaf) const {
  return index_->leaves[leaf].connected && index_->ignored_lanes(leaf) == 0;
}

GroupEntry JointGroup::add_core(LeafId leaf) {
  const auto entry = static_cast<GroupEntry>(leaves_.size());
  add_to_eights(kCore + static_cast<LeafId>(cores_.size()), {0, 0, 0, 0}, false);
  eights_.back().cores |= node_at(entry % kFanOut);
  Core core{.first_link = core_links_.size(), .first_leaf = core_leaves_.size()};
  entry_of_[leaf] = entry;
  core_leaves_.push_back(leaf);
  for (std::size_t head = core.first_leaf; head < core_leaves_.size(); ++head) {
    core.vertices += index_->leaves[core_leaves_[head]].size;
    for (const Link& link : index_->links_of(core_leaves_[head])) {
      GroupEntry linked = entry_of_[link.leaf];
      if (linked == kUnknown && fits_into_core(link.leaf) &&
          classify(index_->leaves[link.leaf].bounds, ball_) == Containment::Inside) {
        touched_.push_back(link.leaf);
        linked = entry_of_[link.leaf] = entry;
        core_leaves_.push_back(link.leaf);
      } else if (linked == kUnknown) {
        linked = discover(link.leaf);
      }
      if (linked == entry || linked == kNoEntry) continue;
      add_core_link(core, linked, kernels_->cross_edges(index_->cross_edges_of(link), link.boundary));
    }
  }
  core.end_link = core_links_.size();
  core.end_leaf = core_leaves_.size();
  cores_.push_back(std::move(core));
  return entry;
}

/// Adds a link, or extends that to the same entry: several leaves of a core may be linked with it.
void JointGroup::add_core_link(const Core& core, GroupEntry linked, LaneMask far_boundary) {
  last_core_link_.resize(leaves_.size(), kUnknown);
  std::uint32_t& last = last_core_link_[linked];
  if (last != kUnknown && last >= core.first_link) {
    core_links_[last].far_boundary |= far_boundary;
  } else {
    last = static_cast<std::uint32_t>(core_links_.size());
    core_links_.push_back({linked, far_boundary});
  }
}

std::span<const JointGroup::CoreLink> JointGroup::core_links(GroupEntry core) const {
  const Core& found = cores_[core_number(core)];
  return std::span(core_links_).subspan(found.first_link, found.end_link - found.first_link);
}

std::span<const LeafRun> JointGroup::core_runs(GroupEntry core) {
  Core& found = cores_[core_number(core)];
  if (!found.runs.empty()) return found.runs;
  const auto leaves = std::span(core_leaves_).subspan(found.first_leaf, found.end_leaf - found.first_leaf);
  std::sort(leaves.begin(), leaves.end());
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const LeafId leaf = leaves[i];
    if (i == 0 || leaf != leaves[i - 1] + 1) found.runs.push_back({leaf, leaf});
    found.runs.back().end = leaf + 1;
  }
  return found.runs;
}

const LeafPoints& JointGroup::points(GroupEntry entry) {
  if (has_points_[entry] == 0) {
    has_points_[entry] = 1;
    read_points(leaves_[entry], points_[entry]);
  }
  return points_[entry];
}

void JointGroup::read_points(LeafId leaf, LeafPoints& points) const {
  const Leaf& record = index_->leaves[leaf];
  if (in_floats_) {
    const FloatCenter center{static_cast<float>(center_.x), static_cast<float>(center_.y),
                             static_cast<float>(center_.z), static_cast<float>(index_->frame.scale)};
    joint_kernels_->convert_points(float_positions(*index_) + std::size_t{3} * record.first, record.size, center,
                                   points);
  } else {
    std::visit([&](auto xyz) { convert(xyz, record, center_, index_->frame.scale, points); }, index_->positions);
  }
}

}  // namespace meshhood::inline v0_1
