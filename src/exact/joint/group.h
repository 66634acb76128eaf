// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "exact/layout.h"
#include "simd/joint.h"
#include "simd/kernels.h"

namespace meshhood::inline v0_1 {

/// The number of a leaf that the balls of a group may meet, or of a core.
using GroupEntry = std::uint32_t;

/// Finds the leaves that the balls around the vertices of a group may hold. A *group* is eight neighboring leaves whose
/// queries are answered one leaf after the other; what their balls have in common is found once, by a breadth-first
/// search over the links from the group's own leaves. So it visits only leaves to which a path from them leads.
///
/// A leaf that is connected and lies in every ball of the group is reached by all queries or by none that reach its
/// neighbors. Such leaves, where linked, make one *core*, and a core is one entry. The entries that it is linked to are
/// its *core links*. Every other leaf that the balls may meet is an entry by itself.
class JointGroup {
 public:
  JointGroup(const IndexView& index, Isa isa);

  /// A link from a leaf to another entry.
  struct EntryLink {
    GroupEntry entry;
    LaneMask boundary;  // the vertices of this leaf that have a neighbor there
    std::span<const CrossEdge> edges;
  };

  /// The links from a core to a leaf, together.
  struct CoreLink {
    GroupEntry entry;
    LaneMask far_boundary;
  };

  /// Begins with the group of `leaves`, which are consecutive and belong to one node of the tree. The radii of the
  /// queries lie between `low` and `high`.
  void begin(std::span<const LeafId> leaves, const TreeBounds& low, const TreeBounds& high);

  [[nodiscard]] std::size_t size() const { return leaves_.size(); }
  [[nodiscard]] bool is_core(GroupEntry entry) const { return leaves_[entry] >= kCore; }
  [[nodiscard]] LeafId leaf(GroupEntry entry) const {
    assert(!is_core(entry));
    return leaves_[entry];
  }

  /// Returns the spheres of the entries, eight to a node group; that of a core is not used.
  [[nodiscard]] std::span<const Group> spheres() const { return spheres_; }

  /// The entries, of eight, that are connected leaves, and those that are cores.
  struct Eight {
    std::uint8_t connected;
    std::uint8_t cores;
  };
  [[nodiscard]] std::span<const Eight> eights() const { return eights_; }

  /// Returns the entry of a leaf, or `kNoEntry` where no ball meets it. The leaf must be linked with an entry, or be
  /// one of the group.
  [[nodiscard]] GroupEntry entry_of(LeafId leaf) const { return entry_of_[leaf]; }
  static constexpr GroupEntry kNoEntry = 0xFFFFFFFE;

  /// Returns the links of an entry that is a leaf. They are looked up at the first call, and valid until those of
  /// another are.
  [[nodiscard]] std::span<const EntryLink> links(GroupEntry entry);

  // These take the entry of a core.
  [[nodiscard]] std::span<const CoreLink> core_links(GroupEntry core) const;
  [[nodiscard]] std::size_t core_number(GroupEntry core) const {
    assert(is_core(core));
    return leaves_[core] - kCore;
  }
  [[nodiscard]] std::size_t core_vertices(GroupEntry core) const { return cores_[core_number(core)].vertices; }
  /// Returns the leaves of a core, ascending. They are sorted at the first call.
  [[nodiscard]] std::span<const LeafRun> core_runs(GroupEntry core);

  /// Return the center of the group: exactly, and in the frame.
  [[nodiscard]] const Point& center() const { return center_; }
  [[nodiscard]] const Point& center_in_frame() const { return center_in_frame_; }
  /// No vertex of the group is farther than this from its center, in the frame.
  [[nodiscard]] double radius() const { return radius_; }

  /// Returns the vertices of an entry that is a leaf, relative to the center. They are converted at the first call.
  [[nodiscard]] const LeafPoints& points(GroupEntry entry);
  /// Reads the vertices of any leaf, relative to the center.
  void read_points(LeafId leaf, LeafPoints& points) const;

 private:
  static constexpr LeafId kCore = 0xF0000000;  // no leaf has this number: there are at most 2^27
  static constexpr GroupEntry kUnknown = 0xFFFFFFFF;

  struct LinkRange {
    std::uint32_t begin;  // in links_
    std::uint32_t end;
  };

  struct Core {
    std::size_t first_link;  // in core_links_
    std::size_t end_link = 0;
    std::size_t first_leaf;  // in core_leaves_
    std::size_t end_leaf = 0;
    std::size_t vertices = 0;
    std::vector<LeafRun> runs{};  // filled at the first call of `core_runs`
  };

  void clear();
  void set_sphere(std::span<const LeafId> leaves);
  GroupEntry discover(LeafId leaf);
  GroupEntry add_entry(LeafId leaf);
  GroupEntry add_core(LeafId leaf);
  void add_core_link(const Core& core, GroupEntry linked, LaneMask far_boundary);
  void add_to_eights(LeafId leaf, const FrameSphere& sphere, bool connected);
  void prefetch(const Leaf& leaf) const;
  [[nodiscard]] bool fits_into_core(LeafId leaf) const;
  [[nodiscard]] bool meets_a_leaf(const FrameSphere& sphere) const;

  const IndexView* index_;
  const Kernels* kernels_;
  const JointKernels* joint_kernels_;
  bool in_floats_;  // positions and the center are floats, and their differences are neither too large nor too small
  std::uint32_t group_ = 0;  // that the leaves belong to
  float high_ = 0;           // the radius of the largest ball, in the frame
  TreeBall ball_;            // around the group: `outer` encloses its balls, `inner` lies in each of them
  Point center_{0, 0, 0};
  Point center_in_frame_{0, 0, 0};
  double radius_ = 0;
  std::vector<GroupEntry> entry_of_;  // by leaf of the index
  std::vector<LeafId> touched_;       // the leaves whose entry is known
  std::vector<LeafId> leaves_;        // by entry; of a core, kCore and its number
  std::vector<Group> spheres_;
  std::vector<Eight> eights_;
  std::vector<Core> cores_;
  std::vector<LeafId> core_leaves_;
  std::vector<CoreLink> core_links_;
  std::vector<std::uint32_t> last_core_link_;  // by entry: the last core link to it, in core_links_
  std::vector<LinkRange> link_ranges_;         // by entry
  std::vector<EntryLink> links_;
  std::vector<LeafPoints> points_;  // by entry
  std::vector<std::uint8_t> has_points_;
};

}  // namespace meshhood::inline v0_1
