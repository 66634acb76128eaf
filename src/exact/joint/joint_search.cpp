// SPDX-License-Identifier: MIT
#include "exact/joint/joint_search.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>

#include "base/vector.h"

namespace meshhood::inline v0_1 {
namespace {

constexpr float kFloatInfinity = std::numeric_limits<float>::infinity();

// This is longer than any distance in the frame, so that it may replace larger radii.
constexpr double kLargestRadius = 8;

// Let every vertex that is compared, and every query, lie within `a` of the center of the group, and u = 2^-24. The
// coordinates of both are rounded by u, which moves a squared distance by 8 u a^2; `2 p.q - p.p` is computed with an
// error of 12 u a^2, and a threshold is rounded by u a^2: 21 u a^2 in all, less than 2^-19 a^2. A squared distance from
// the center of the leaf is off by 28 u a^2, less than four times as much.
constexpr double kRelativeError = 0x1p-19;

double inner_of(const TreeBounds& bounds) { return std::min(static_cast<double>(bounds.inner), kLargestRadius); }
double outer_of(const TreeBounds& bounds) { return std::min(static_cast<double>(bounds.outer), kLargestRadius); }

}  // namespace

JointRadius::JointRadius(const Frame& frame, double at)
    : radius(at),
      squared(squared_radius(at)),
      bounds(frame, at),
      inner_squared(inner_of(bounds) > 0 ? inner_of(bounds) * inner_of(bounds) : -kInfinity),
      outer_squared(outer_of(bounds) * outer_of(bounds)) {}

Packet::Packet(const IndexView& index, const JointGroup& group, LeafId leaf, std::span<const JointQuery> queries)
    : index_(&index), leaf_(leaf), size_(queries.size()), ball_({0, 0, 0}, queries.front().radius.bounds) {
  assert(size_ <= kPacketCapacity);
  for (std::size_t i = 0; i < size_; ++i) {
    assert(queries[i].lane < index.leaves[leaf].size);
    lanes_[i] = queries[i].lane;
    squared_radii_[i] = queries[i].radius.squared;
    ball_.inner = std::min(ball_.inner, queries[i].radius.bounds.inner);
    ball_.outer = std::max(ball_.outer, queries[i].radius.bounds.outer);
  }
  set_balls(group, queries);
  const FrameSphere& bounds = index.leaves[leaf].bounds;
  ball_.x = bounds.x;
  ball_.y = bounds.y;
  ball_.z = bounds.z;
  ball_.inner = -next_above(static_cast<double>(bounds.radius) - static_cast<double>(ball_.inner));
  ball_.outer = next_above(static_cast<double>(ball_.outer) + static_cast<double>(bounds.radius));
}

void Packet::set_balls(const JointGroup& group, std::span<const JointQuery> queries) {
  const FrameSphere& bounds = index_->leaves[leaf_].bounds;
  const auto leaf_radius = static_cast<double>(bounds.radius);
  const double low = inner_of(ball_) - leaf_radius;
  const double high = outer_of(ball_) + leaf_radius;
  const double reach = high + leaf_radius + group.radius();
  const double error = kRelativeError * reach * reach;
  const Point center = center_of(bounds) - group.center_in_frame();
  for (PerLane<float>* coordinate : {&balls_.x, &balls_.y, &balls_.z}) coordinate->fill(0);
  balls_.center.x = static_cast<float>(center.x);
  balls_.center.y = static_cast<float>(center.y);
  balls_.center.z = static_cast<float>(center.z);
  balls_.inside_all = low > 0 ? static_cast<float>(low * low - 4 * error) : 0;
  balls_.outside_all = static_cast<float>(high * high + 4 * error);
  balls_.queries = 0;
  balls_.surely_inside.fill(kFloatInfinity);
  balls_.maybe_inside.fill(kFloatInfinity);
  LeafPoints points;
  group.read_points(leaf_, points);
  const LaneMask open = index_->open_lanes(leaf_);
  for (std::size_t i = 0; i < size_; ++i) {
    const unsigned lane = lanes_[i];
    if ((open >> lane & 1U) == 0) continue;
    balls_.queries |= QueryWord{1} << i;
    const Point q{static_cast<double>(points.x[lane]), static_cast<double>(points.y[lane]),
                  static_cast<double>(points.z[lane])};
    balls_.set(i, 2 * q);
    balls_.surely_inside[i] = static_cast<float>(dot(q, q) - queries[i].radius.inner_squared + error);
    balls_.maybe_inside[i] = static_cast<float>(dot(q, q) - queries[i].radius.outer_squared - error);
  }
}

void JointSpread::run(JointGroup& group, const Packet& packet) {
  whole_.clear();
  partial_.clear();
  worklist_.reset(group.size());
  if (words_.size() < group.size()) words_.resize(group.size() + group.size() / 2);
  classify(group, packet);
  start(group, packet);
  worklist_.run([&](GroupEntry entry) { take(group, packet, entry); });
  if (!index_->ignored.empty()) leave_out_ignored(group);
}

/// Takes the ignored vertices out of what was reached. A leaf that has some gets words; a core has no ignored vertices.
void JointSpread::leave_out_ignored(const JointGroup& group) {
  for (const LeafOfWords& found : partial_) {
    for_each_lane(index_->ignored[group.leaf(found.words)],
                  [&](unsigned lane) { words_[found.words].reached[lane] = 0; });
  }
  std::erase_if(whole_, [&](GroupEntry entry) {
    if (group.is_core(entry) || index_->ignored[group.leaf(entry)] == 0) return false;
    const LeafId leaf = group.leaf(entry);
    words_[entry].reached = {};
    for_each_lane(first_lanes(index_->leaves[leaf].size) & ~index_->ignored[leaf],
                  [&](unsigned lane) { words_[entry].reached[lane] = states_[entry].word; });
    partial_.push_back({entry, index_->leaves[leaf].first});
    return true;
  });
}

void JointSpread::classify(const JointGroup& group, const Packet& packet) {
  const std::span<const Group> spheres = group.spheres();
  for (auto next = static_cast<std::uint32_t>(numbers_.size()); next < spheres.size(); ++next) numbers_.push_back(next);
  sides_.resize(spheres.size());
  tree_kernels_->classify(spheres.data(), std::span(numbers_).first(spheres.size()), packet.ball(), sides_.data());
  states_.resize(group.size());
  for (GroupEntry entry = 0; entry < states_.size(); ++entry) {
    const JointGroup::Eight eight = group.eights()[entry / kFanOut];
    const GroupContainment& side = sides_[entry / kFanOut];
    const auto has = [&](unsigned bits) { return (bits >> entry % kFanOut & 1U) != 0; };
    const bool is_whole = has((side.inside & eight.connected) | eight.cores);
    const bool is_outside = !has(side.inside | side.intersecting | eight.cores);
    const Kind kind = is_whole ? Kind::Whole : is_outside ? Kind::Outside : Kind::Partial;
    states_[entry] = {kind, is_outside, false, false, 0, 0};
  }
}

/// Each query begins at its own vertex.
void JointSpread::start(const JointGroup& group, const Packet& packet) {
  const GroupEntry entry = group.entry_of(packet.leaf());
  if (states_[entry].kind == Kind::Whole) {
    add_to_whole(packet, entry, packet.queries());
    return;
  }
  states_[entry].kind = Kind::Partial;
  states_[entry].closed = false;
  PerLane<QueryWord>& words = pending(entry);
  for (std::size_t i = 0; i < packet.size(); ++i) words[packet.lane(i)] |= QueryWord{1} << i;
  worklist_.add(entry);
}

void JointSpread::take(JointGroup& group, const Packet& packet, GroupEntry entry) {
  if (states_[entry].kind == Kind::Whole) {
    take_whole(group, packet, entry);
  } else {
    take_partial(group, packet, entry);
  }
}

/// Pushes one word to an entry; `f` puts it into the pending words of a partial one.
template <class F>
void JointSpread::push(const Packet& packet, GroupEntry entry, QueryWord word, F&& f) {
  if (states_[entry].closed) return;
  if (states_[entry].kind == Kind::Whole) {
    add_to_whole(packet, entry, word);
  } else {
    f(pending(entry));
    worklist_.add(entry);
  }
}

void JointSpread::take_whole(JointGroup& group, const Packet& packet, GroupEntry entry) {
  const QueryWord word = states_[entry].word & ~states_[entry].pushed;
  if (states_[entry].pushed == 0) whole_.push_back(entry);
  states_[entry].pushed |= word;
  if (group.is_core(entry)) {
    for (const JointGroup::CoreLink& link : group.core_links(entry)) {
      push(packet, link.entry, word, [&](PerLane<QueryWord>& pending) {
        for_each_lane(link.far_boundary, [&](unsigned lane) { pending[lane] |= word; });
      });
    }
  } else {
    for (const JointGroup::EntryLink& link : group.links(entry)) {
      push(packet, link.entry, word, [&](PerLane<QueryWord>& pending) {
        for (const CrossEdge& edge : link.edges) pending[edge.to] |= word;
      });
    }
  }
}

void JointSpread::take_partial(JointGroup& group, const Packet& packet, GroupEntry entry) {
  State& state = states_[entry];
  const LeafId leaf = group.leaf(entry);
  const Leaf& record = index_->leaves[leaf];
  const bool is_first = !state.has_inside;
  if (is_first) find_inside(group, packet, entry);
  const SpreadWords spread =
      kernels_->spread_words(words_[entry], &index_->adjacency[record.first], record.connected ? state.word : 0);
  state.closed = spread.closed;
  if (spread.gained == 0) return;
  if (state.pushed == 0) partial_.push_back({entry, record.first});
  state.pushed = packet.queries();
  push_leaf(group, packet, entry, spread.gained);
}

/// Finds which queries hold which vertices of the leaf.
void JointSpread::find_inside(JointGroup& group, const Packet& packet, GroupEntry entry) {
  states_[entry].has_inside = true;
  const LeafId leaf = group.leaf(entry);
  PerLane<QueryWord>& inside = words_[entry].inside;
  PerLane<QueryWord> doubts;
  const BallWords found =
      kernels_->ball_words(group.points(entry), index_->open_lanes(leaf), packet.balls(), inside, doubts);
  states_[entry].word = found.all;
  for_each_lane(found.in_doubt, [&](unsigned lane) {
    const Point vertex = index_->position(leaf, lane);
    for_each_query(doubts[lane],
                   [&](std::size_t query) { inside[lane] |= QueryWord{packet.holds(query, vertex)} << query; });
  });
}

/// Pushes the words of a leaf over its links. Which links take them cannot be predicted, so they are chosen first,
/// without branches.
void JointSpread::push_leaf(JointGroup& group, const Packet& packet, GroupEntry entry, LaneMask gained) {
  constexpr std::size_t kAtOnce = 64;
  for (std::span<const JointGroup::EntryLink> links = group.links(entry); !links.empty();) {
    const std::span<const JointGroup::EntryLink> some = links.first(std::min(links.size(), kAtOnce));
    std::uint64_t taken = 0;
    for (std::size_t i = 0; i < some.size(); ++i) {
      const bool has_gained = (some[i].boundary & gained) != 0;
      const bool is_open = !states_[some[i].entry].closed;
      taken |= static_cast<std::uint64_t>(has_gained & is_open) << i;
    }
    for (; taken != 0; taken &= taken - 1) {
      push_over(packet, words_[entry].reached, some[static_cast<std::size_t>(std::countr_zero(taken))]);
    }
    links = links.subspan(some.size());
  }
}

void JointSpread::push_over(const Packet& packet, const PerLane<QueryWord>& reached,
                            const JointGroup::EntryLink& link) {
  if (states_[link.entry].kind == Kind::Whole) {
    QueryWord word = 0;
    for_each_lane(link.boundary, [&](unsigned lane) { word |= reached[lane]; });
    add_to_whole(packet, link.entry, word);
  } else {
    push_words(link.edges, reached, pending(link.entry));
    worklist_.add(link.entry);
  }
}

void JointSpread::add_to_whole(const Packet& packet, GroupEntry entry, QueryWord word) {
  State& state = states_[entry];
  if ((word & ~state.word) == 0) return;
  state.word |= word;
  state.closed = state.word == packet.queries();
  worklist_.add(entry);
}

PerLane<QueryWord>& JointSpread::pending(GroupEntry entry) {
  if (!states_[entry].is_touched) {
    states_[entry].is_touched = true;
    kernels_->clear_words(words_[entry]);
  }
  return words_[entry].pending;
}

JointSearch::JointSearch(const IndexView& index, Isa isa)
    : index_(&index), kernels_(&joint_kernels(isa)), group_(index, isa), spread_(index, isa) {}

void JointSearch::run(LeafId leaf, std::span<const JointQuery> queries) {
  packet_.emplace(*index_, group_, leaf, queries);
  spread_.run(group_, *packet_);
}

const PerLane<std::uint64_t>& JointSearch::counts() {
  assert(packet_);  // of the last `run`
  counts_ = {};
  std::uint64_t common = 0;
  for (const GroupEntry entry : spread_.whole()) {
    const std::size_t size =
        group_.is_core(entry) ? group_.core_vertices(entry) : index_->leaves[group_.leaf(entry)].size;
    const QueryWord word = spread_.whole_word(entry);
    if (word == packet_->queries()) {
      common += size;
    } else {
      for_each_query(word, [&](std::size_t query) { counts_[query] += size; });
    }
  }
  for_each_query(packet_->queries(), [&](std::size_t query) { counts_[query] += common; });
  kernels_->count_words(spread_.words(), spread_.partial(), counts_);
  return counts_;
}

std::span<const Piece> JointSearch::pieces(bool in_order) {
  assert(packet_);
  pieces_.clear();
  for (const GroupEntry entry : spread_.whole()) {
    const QueryWord word = spread_.whole_word(entry);
    if (group_.is_core(entry)) {
      for (const LeafRun& run : group_.core_runs(entry)) pieces_.push_back({run, word, nullptr});
    } else {
      const LeafId leaf = group_.leaf(entry);
      pieces_.push_back({{leaf, leaf + 1}, word, nullptr});
    }
  }
  for (const LeafOfWords& found : spread_.partial()) {
    const LeafId leaf = group_.leaf(found.words);
    pieces_.push_back({{leaf, leaf + 1}, 0, spread_.words()[found.words].reached.data()});
  }
  if (in_order) put_in_order();
  return pieces_;
}

/// Sorts the pieces, and joins runs.
void JointSearch::put_in_order() {
  std::ranges::sort(pieces_, {}, [](const Piece& piece) { return piece.leaves.begin; });
  std::size_t kept = 0;
  for (const Piece& piece : pieces_) {
    Piece* const last = kept == 0 ? nullptr : &pieces_[kept - 1];
    assert(last == nullptr || last->leaves.end <= piece.leaves.begin);  // an answer names each vertex once
    if (last != nullptr && last->is_run() && piece.is_run() && last->queries == piece.queries &&
        last->leaves.end == piece.leaves.begin) {
      last->leaves.end = piece.leaves.end;
    } else {
      pieces_[kept++] = piece;
    }
  }
  pieces_.resize(kept);
}

}  // namespace meshhood::inline v0_1
