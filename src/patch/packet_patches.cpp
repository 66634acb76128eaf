// SPDX-License-Identifier: MIT
#include "patch/packet_patches.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/vector.h"
#include "surface/face_triangles.h"

namespace meshhood::inline v0_1 {
PacketPatches::PacketPatches(const PatchState& state)
    : state_(&state),
      kernels_(&patch_kernels(best_isa())),
      words_(state.index->vertex_count()),
      all_(state.meshlets.size()) {
  cut_.corners.fill(corner_rows_[0].data());
  cut_.balls.fill(ball_rows_[0].data());
}

QueryWord PacketPatches::find(const PacketAnswer& packet, bool measures) {
  measures_ = measures;
  clear();
  if (!state_->follows_neighborhoods()) return 0;
  set_balls(packet);
  set_words(packet);
  leave_loose();
  std::ranges::sort(meshlets_);
  for (const MeshletId meshlet : meshlets_) add_meshlet(meshlet);
  measure_cut();
  follow_dips();
  for_each_query(queries_, [&](std::size_t q) { sums_[q].add_whole(whole_.area[q], whole_.moment[q]); });
  return queries_;
}

bool PacketPatches::has(std::size_t query, TriangleId t) const {
  return (having(t) >> query & 1U) != 0 || std::ranges::find(extras_[query], t) != extras_[query].end();
}

void PacketPatches::clear() {
  const IndexView& index = *state_->index;
  for (const LeafId leaf : leaves_) {
    std::fill(&words_[index.leaf_begin[leaf]], words_.data() + index.leaf_begin[leaf + std::size_t{1}], QueryWord{0});
  }
  leaves_.clear();
  meshlets_.clear();
  all_.forget();
  met_ = 0;
  gaps_.clear();
  dips_.clear();
  for (std::vector<TriangleId>& extras : extras_) extras.clear();
}

void PacketPatches::set_balls(const PacketAnswer& packet) {
  const IndexView& index = *state_->index;
  queries_ = packet.queries;
  whole_ = {};
  for_each_query(packet.queries, [&](std::size_t q) {
    const std::uint32_t place = index.place(packet.vertices[q]);
    balls_[q] = patch_ball(index.position(place), packet.radii[q], index.frame.scale);
    if (!std::isfinite(balls_[q].unit)) leave(q);  // an infinite radius is allowed, as no triangle is cut
    centers_.set(q, balls_[q].center);
    sums_[q].clear(state_->triangles.normal_of(index, state_->triangles.fans[place]));
    ball_rows_[q] = {lane_row(balls_[q].center, balls_[q].unit), lane_row(sums_[q].rim().pole())};
  });
}

void PacketPatches::set_words(const PacketAnswer& packet) {
  const IndexView& index = *state_->index;
  for (const Piece& piece : packet.pieces) {
    for (LeafId leaf = piece.leaves.begin; leaf < piece.leaves.end; ++leaf) {
      touch(leaf);
      const std::size_t begin = index.leaf_begin[leaf];
      const std::size_t size = index.leaf_begin[leaf + std::size_t{1}] - begin;
      for (std::size_t i = 0; i < size; ++i) {
        words_[begin + i] = (piece.is_run() ? piece.queries : piece.reached[i]) & queries_;
      }
    }
  }
}

/// Drops the queries at loose edges, which join a neighborhood, but no patch.
void PacketPatches::leave_loose() {
  const std::vector<Triangles::LooseEdge>& loose = state_->triangles.loose;
  for (std::size_t i = 0; i < leaves_.size() && !loose.empty(); ++i) {
    const std::uint32_t end = state_->index->leaf_begin[leaves_[i] + std::size_t{1}];
    auto edge =
        std::ranges::lower_bound(loose, state_->index->leaf_begin[leaves_[i]], {}, &Triangles::LooseEdge::first);
    for (; edge != loose.end() && edge->first < end; ++edge) queries_ &= ~(words_[edge->first] & words_[edge->last]);
  }
}

void PacketPatches::touch(LeafId leaf) {
  leaves_.push_back(leaf);
  for (const MeshletId meshlet : state_->meshlets.of_leaf[leaf]) {
    if (all_.is_known(meshlet)) continue;
    all_.set(meshlet, 0);
    meshlets_.push_back(meshlet);
  }
}

void PacketPatches::add_meshlet(MeshletId meshlet) {
  QueryWord all = queries_;
  QueryWord some = 0;
  for (const std::uint32_t place : state_->meshlets.corners[meshlet]) {
    all &= words_[place];
    some |= words_[place];
  }
  some &= queries_;
  all_[meshlet] = all;
  met_ |= some;
  const Meshlet& sums = state_->meshlets.meshlets[meshlet];
  if (sums.has_border) for_each_query(all, [&](std::size_t q) { sums_[q].meet_border(); });
  inside_.clear();
  if (all != 0) inside_.push_back({sums.area, sums.vector_area, sums.moment, sums.center(), all});
  if (some != all) {
    for (const TriangleId t : state_->triangles.of_meshlet(meshlet)) add_triangle(t, some & ~all);
  }
  if (measures_) kernels_->add_whole(inside_, centers_, state_->index->frame.scale, whole_);
}

/// Adds a triangle. Its moment is about a corner in the balls, since other corners of the meshlet may be far away.
void PacketPatches::add_triangle(TriangleId t, QueryWord queries) {
  auto [a, b, c] = words_of(t);
  a &= queries;
  b &= queries;
  c &= queries;
  const QueryWord whole = a & b & c;
  if ((a | b | c) == 0) return;
  if (state_->triangles.flags[t] != 0) {
    meet_borders(t, {a, b, c});
    leave_at_diagonals(t, {a, b, c});
  }
  const std::array<Point, 3> corners = corners_of(*state_->index, state_->triangles.corners[t]);
  if (whole != 0 && measures_) {
    const double scale = state_->index->frame.scale;
    const Point vector = 0.5 * cross(scale * (corners[1] - corners[0]), scale * (corners[2] - corners[0]));
    inside_.push_back({length_without_underflow(vector), vector, 0, corners[0], whole});
  }
  // If two corners are in a ball, no side dips.
  const QueryWord cut = (measures_ ? a | b | c : a ^ b ^ c) & ~whole;
  if (cut != 0) add_cut(t, corners, {a, b, c}, cut);
}

void PacketPatches::meet_borders(TriangleId t, const std::array<QueryWord, 3>& words) {
  for (unsigned i = 0; i < 3; ++i) {
    if (!state_->triangles.is_border(t, i)) continue;
    for_each_query(words[i] | words[after(i)], [&](std::size_t q) { sums_[q].meet_border(); });
  }
}

/// The ends of a diagonal are joined in a patch, but not by an edge: if both are in a ball, both must be in the
/// neighborhood.
void PacketPatches::leave_at_diagonals(TriangleId t, const std::array<QueryWord, 3>& words) {
  for (unsigned i = 0; i < 3; ++i) {
    if (!state_->triangles.is_diagonal(t, i)) continue;
    for_each_query(words[i] ^ words[after(i)], [&](std::size_t q) {
      const std::size_t other = (words[i] >> q & 1U) != 0 ? after(i) : i;
      if (balls_[q].contains(state_->index->position(state_->triangles.corners[t][other]))) leave(q);
    });
  }
}

namespace {

/// Which corner is alone inside or outside, and 1 if inside, else -1, by the corners inside: corner i is bit i.
struct CutKind {
  std::size_t first;
  double inside;
};
constexpr std::array<CutKind, 8> kCutKinds{{{}, {0, 1}, {1, 1}, {2, -1}, {2, 1}, {1, -1}, {0, -1}, {}}};

}  // namespace

/// Adds a triangle of which the queries have one corner or two. From any corner on, three follow each other in the list
/// of five.
void PacketPatches::add_cut(TriangleId t, const std::array<Point, 3>& corners, const std::array<QueryWord, 3>& words,
                            QueryWord queries) {
  const LaneRow* rows = nullptr;
  for_each_query(queries, [&](std::size_t q) {
    if (cut_count_ == kPacketCapacity) {
      measure_cut();
      rows = nullptr;
    }
    const std::size_t lane = cut_count_++;
    if (rows == nullptr) {
      for (std::size_t i = 0; i < 5; ++i) corner_rows_[lane][i] = lane_row(corners[i % 3]);
      rows = corner_rows_[lane].data();
    }
    const auto has = [q](QueryWord word) { return word >> q & 1U; };
    const CutKind kind = kCutKinds[has(words[0]) | has(words[1]) << 1U | has(words[2]) << 2U];
    cut_triangles_[lane] = t;
    cut_queries_[lane] = q;
    cut_.corners[lane] = rows + kind.first;
    cut_.balls[lane] = ball_rows_[q].data();
    cut_.insides[lane] = kind.inside;
  });
}

void PacketPatches::measure_cut() {
  const auto lanes = static_cast<unsigned>(std::exchange(cut_count_, 0));
  if (lanes == 0) return;
  const LaneMask left =
      measures_ ? first_lanes(lanes) & ~kernels_->measure(cut_, lanes, clipped_) : kernels_->may_dip(cut_, lanes);
  for (unsigned i = 0; i < lanes; ++i) {
    const std::size_t q = cut_queries_[i];
    if ((left >> i & 1U) != 0) {
      add_clipped(cut_triangles_[i], q);
    } else if (measures_) {
      sums_[q].add_cut(clipped_.area[i], clipped_.distance[i]);
      sums_[q].rim().add_measured(clipped_.turn[i], {clipped_.real[i], clipped_.imaginary[i]});
    }
  }
}

void PacketPatches::add_clipped(TriangleId t, std::size_t query) {
  const Triangles& all = state_->triangles;
  const auto [a, b, c] = words_of(t);
  const auto has = [&](QueryWord word) { return (word >> query & 1U) != 0; };
  const PatchTriangle triangle{corners_of(*state_->index, all.corners[t]), all.corners[t], {has(a), has(b), has(c)}};
  ClippedTriangle clipped(balls_[query], triangle);
  for (std::size_t i = 0; i < 3; ++i) {
    if (!clipped.dips(i)) continue;
    dips_.push_back({query, t, i});
    if (all.is_border(t, static_cast<unsigned>(i))) sums_[query].meet_border();
  }
  if (measures_) clipped.add_to(sums_[query]);
}

/// Follows the dips in the order in which they were found. This may find more.
void PacketPatches::follow_dips() {
  // NOLINTNEXTLINE(modernize-loop-convert): the list grows meanwhile
  for (std::size_t next = 0; next < dips_.size(); ++next) follow(Dip(dips_[next]));
}

void PacketPatches::follow(const Dip& dip) {
  constexpr std::size_t kMostExtras = 64;  // a longer list would take long to search
  const Triangles& all = state_->triangles;
  all.for_each_beside(dip.triangle, dip.side, [&](TriangleId t) {
    if (!is_found(dip.query) || has(dip.query, t)) return;
    const std::array<Point, 3> corners = corners_of(*state_->index, all.corners[t]);
    const auto is_inside = [&](const Point& corner) { return balls_[dip.query].contains(corner); };
    if (extras_[dip.query].size() == kMostExtras || std::ranges::any_of(corners, is_inside)) return leave(dip.query);
    extras_[dip.query].push_back(t);
    add_clipped(t, dip.query);
  });
}

}  // namespace meshhood::inline v0_1
