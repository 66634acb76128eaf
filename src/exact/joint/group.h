// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "exact/layout.h"
#include "simd/joint.h"
#include "simd/kernels.h"

namespace meshhood {

/// A number of a group's own for a leaf that its balls may meet, or for a core.
using GroupSlot = std::uint32_t;

/// The leaves that the balls around the vertices of a group may hold. A *group* is eight neighboring leaves whose
/// queries are answered one leaf after the other; what their balls have in common is found once, by a breadth-first
/// search over the links from the group's own leaves. So no leaf is looked at that no path from them leads to.
///
/// A leaf that is connected and lies in every ball of the group is reached by all queries or by none that reach its
/// neighbors. Such leaves, where linked, make one *core*, and a core is one slot. The slots that it is linked to are
/// its *rim*. Every other leaf that the balls may meet is a slot by itself.
class JointGroup {
 public:
  JointGroup(const IndexView& index, const Kernels& kernels);

  /// A link from a core: the slot, and the vertices of that leaf which have a neighbor in the core.
  struct RimLink {
    GroupSlot slot;
    LaneMask boundary;
  };

  /// Begins with the group of `leaves`, which are consecutive and belong to one node of the tree. The radii of the
  /// queries lie between `low` and `high`.
  void begin(std::span<const LeafId> leaves, const TreeBounds& low, const TreeBounds& high);

  [[nodiscard]] std::size_t size() const { return leaves_.size(); }
  [[nodiscard]] bool is_core(GroupSlot slot) const { return leaves_[slot] >= kCore; }
  [[nodiscard]] LeafId leaf(GroupSlot slot) const { return leaves_[slot]; }

  /// The spheres of the slots; that of a core is not used.
  [[nodiscard]] std::span<const FrameSphere> spheres() const { return spheres_; }

  /// The slot of a leaf, or `kNoSlot` where no ball meets it. Any leaf that is linked with a slot, or one of the group.
  [[nodiscard]] GroupSlot slot_of(LeafId leaf) const { return slot_of_[leaf]; }
  static constexpr GroupSlot kNoSlot = 0xFFFFFFFE;

  // Of a core.
  [[nodiscard]] std::span<const RimLink> rim(GroupSlot core) const;
  [[nodiscard]] std::span<const LeafId> core_leaves(GroupSlot core) const;
  [[nodiscard]] std::size_t core_vertices(GroupSlot core) const { return cores_[leaves_[core] - kCore].vertices; }
  /// Its vertices, as the caller numbers them. Copied together when first asked for.
  [[nodiscard]] std::span<const VertexId> core_ids(GroupSlot core);

  /// The centre of the group: exactly, and in the frame.
  [[nodiscard]] const Point& centre() const { return centre_; }
  [[nodiscard]] const Point& centre_in_frame() const { return centre_in_frame_; }
  /// No vertex of the group is farther than this from its centre, in the frame.
  [[nodiscard]] double radius() const { return radius_; }

  /// The vertices of a slot that is a leaf, relative to the centre. Converted when first asked for.
  [[nodiscard]] const LeafPoints& points(GroupSlot slot);

 private:
  static constexpr LeafId kCore = 0xF0000000;  // more than any leaf: there are at most 2^27
  static constexpr GroupSlot kUnknown = 0xFFFFFFFF;

  struct Core {
    std::uint32_t first_leaf;  // in core_leaves_
    std::uint32_t end_leaf;
    std::uint32_t first_rim;
    std::uint32_t end_rim;
    std::size_t vertices;
    std::size_t first_id;  // in core_ids_
    bool has_ids;
  };

  void clear();
  void set_sphere(std::span<const LeafId> leaves);
  GroupSlot discover(LeafId leaf);
  GroupSlot add_slot(LeafId leaf);
  GroupSlot add_core(LeafId leaf);
  [[nodiscard]] bool is_inside(LeafId leaf) const;

  const IndexView* index_;
  const Kernels* kernels_;
  TreeBall ball_;  // around the group: what its balls hold together, and what each of them holds
  Point centre_{0, 0, 0};
  Point centre_in_frame_{0, 0, 0};
  double radius_ = 0;
  std::vector<GroupSlot> slot_of_;    // by leaf of the index
  std::vector<LeafId> touched_;       // the leaves whose slot is known
  std::vector<LeafId> leaves_;        // by slot; of a core, kCore and its number
  std::vector<FrameSphere> spheres_;  // by slot
  std::vector<Core> cores_;
  std::vector<LeafId> core_leaves_;
  std::vector<RimLink> rims_;
  std::vector<VertexId> core_ids_;
  std::vector<LeafPoints> points_;  // by slot
  std::vector<std::uint8_t> has_points_;
};

}  // namespace meshhood
