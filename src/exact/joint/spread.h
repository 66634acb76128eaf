// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "exact/joint/group.h"
#include "exact/joint/packet.h"
#include "exact/joint/worklist.h"
#include "exact/layout.h"
#include "simd/joint.h"

namespace meshhood {

/// How the slots of a group lie to a packet, and what its queries reach there: breadth-first search for all queries at
/// once. A query reaches a vertex if its ball holds the vertex, and it reaches a neighbor of it. Words only grow, and a
/// slot that has gained pushes its words over its links, so the search ends, and with exactly the components.
class JointSpread {
 public:
  JointSpread(const IndexView& index, const JointKernels& kernels) : index_(&index), kernels_(&kernels) {}

  /// Finds what the queries of `packet` reach.
  void run(JointGroup& group, const Packet& packet);

  /// The slots that lie in all balls, and were reached.
  [[nodiscard]] std::span<const GroupSlot> whole() const { return whole_; }
  /// The queries that reach such a slot, and so all of its vertices.
  [[nodiscard]] QueryWord whole_word(GroupSlot slot) const { return slots_[slot].word; }

  /// The other leaves that were reached: their words are those of `words()` at the slot.
  [[nodiscard]] std::span<const LeafOfWords> partial() const { return partial_; }
  [[nodiscard]] const LeafWords* words() const { return words_.data(); }

 private:
  enum class Kind : std::uint8_t { Outside, Whole, Partial };

  struct Slot {
    Kind kind;
    bool closed;       // nothing can be added
    bool is_touched;   // words_ are those of this packet
    bool has_inside;   // and so are the words `inside`
    QueryWord word;    // whole: the queries that reach it; partial: those whose ball holds all of the leaf
    QueryWord pushed;  // whole: the queries that were pushed on
  };

  void classify(const JointGroup& group, const Packet& packet);
  void start(const JointGroup& group, const Packet& packet);
  void take(JointGroup& group, const Packet& packet, GroupSlot slot);
  void take_whole(const JointGroup& group, const Packet& packet, GroupSlot slot);
  void take_partial(JointGroup& group, const Packet& packet, GroupSlot slot);
  void find_inside(JointGroup& group, const Packet& packet, GroupSlot slot);
  void push_leaf(const JointGroup& group, const Packet& packet, LeafId leaf, const PerLane<QueryWord>& reached,
                 LaneMask gained);
  void push_rim(const JointGroup& group, const Packet& packet, GroupSlot core, QueryWord word);
  void add_to_whole(const Packet& packet, GroupSlot slot, QueryWord word);
  PerLane<QueryWord>& pending(GroupSlot slot);

  const IndexView* index_;
  const JointKernels* kernels_;
  std::vector<Slot> slots_;
  std::vector<LeafWords> words_;  // by slot
  Worklist worklist_;
  std::vector<GroupSlot> whole_;
  std::vector<LeafOfWords> partial_;
};

}  // namespace meshhood
