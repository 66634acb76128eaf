// SPDX-License-Identifier: MIT
// Finds rows of nearest vertices: each thread searches row after row, in index order, until the row is full.
#include "meshhood/k_nearest.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "meshhood/error.h"

#include "batch/position_sort.h"
#include "batch/rows.h"
#include "exact/index_access.h"
#include "exact/joint/nearest_packet.h"
#include "exact/query/arguments.h"
#include "exact/query/length_search.h"
#include "exact/query/straight_queries.h"
#include "shared/distance.h"
#include "shared/large_pages.h"
#include "shared/parallel.h"
#include "shared/text.h"

namespace meshhood::inline v0_1 {
namespace {

constexpr std::size_t kRowsAtOnce = 32;

// The most values of a result; fewer where addresses have 32 bits.
constexpr std::size_t kMostValues = static_cast<std::size_t>(
    std::min<std::uint64_t>(std::uint64_t{1} << 40U, std::numeric_limits<std::size_t>::max() / 16));

constexpr std::size_t kItemBytes = sizeof(VertexId) + sizeof(double);

// The areas of a row are added in two orders, each of fewer than 2^31 terms: the sums differ by less than this share.
constexpr double kAreaSlack = 1e-6;

/// Visits the rows of a call in index order.
class NearestRows {
 public:
  NearestRows(const Index& index, const BatchVertices& vertices, const NearestOptions& options, const Run& run)
      : index_(index), options_(options), run_(run), rows_({vertices, options.radius}, index.vertex_count()) {
    check_connects(options.metric);
  }

  [[nodiscard]] const NearestOptions& options() const { return options_; }
  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] VertexId vertex(std::size_t row) const { return rows_.vertex(row); }

  /// Calls `f(search, row)` for all rows, on any thread, with a search of that thread, made by `make()`.
  template <class Make, class F>
  void for_each(Make&& make, F&& f) {
    TaskContext task(run_.threads, run_.progress, size());
    const auto slot_of = [&](std::size_t row) { return index_->slot[vertex(row)]; };
    std::vector<decltype(make())> searches(task.threads());
    for_each_by_position(size(), kRowsAtOnce, slot_of, task, [&](unsigned thread, std::size_t row) {
      if (!searches[thread]) searches[thread] = make();
      f(*searches[thread], row);
      task.advance(thread, 1);
    });
  }

 private:
  BoundIndex index_;
  const NearestOptions& options_;
  const Run& run_;
  Rows rows_;
};

/// Finds the vertices around one vertex by connecting radius. The rows of a leaf share a packet. How far it looks is
/// guessed from the last leaf, and grows where that was not enough; no row depends on it.
class StraightRowSearch {
 public:
  StraightRowSearch(const Index& index, const NearestOptions& options)
      : index_(index),
        queries_(BoundIndex(index), IndexAccess::share_graph(index), best_isa()),
        packet_(*index_, best_isa()),
        most_(options.radius),
        leaf_radius_(index_->tree.empty() ? 0 : index_->tree.front().mean_radius / index_->frame.scale) {}

  /// Calls `take(vertex, distance)` for the nearest vertices in order until it returns false. The areas are not used.
  template <class Take>
  void run(VertexId v, std::size_t /*enough*/, double /*enough_area*/, std::span<const double> /*areas*/, Take&& take) {
    const std::uint32_t slot = index_->slot[v];
    if (index_->is_wall(slot)) return;
    if (leaf_of(slot) != leaf_) begin(leaf_of(slot));
    std::size_t taken = 0;
    const auto is_short = [&](double radius) {
      std::size_t next = 0;
      const auto take_next = [&](VertexId vertex, double distance) {
        if (next++ < taken) return true;
        ++taken;
        row_radius_ = distance;
        return take(vertex, distance);
      };
      if (is_joint_) return packet_.for_each_near(lane_of(slot), radius, take_next) && radius < most_;
      queries_.for_each_nearest(v, most_, take_next);
      return false;
    };
    double growth = kGrowth;
    for (double radius = std::min(kMargin * row_radius_, radius_); is_short(radius); radius = radius_) {
      if (radius < radius_) continue;
      gather(packet_.is_whole() ? most_ : growth * radius_);
      growth *= growth;
    }
    leaf_radius_ = std::max(leaf_radius_, row_radius_);
    most_taken_ = std::max(most_taken_, taken);
  }

 private:
  // Chosen: with less, too many rows are searched twice; with more, too many vertices are compared.
  static constexpr double kMargin = 1.1;
  static constexpr double kGrowth = 1.5;

  void begin(LeafId leaf) {
    leaf_ = leaf;
    row_radius_ = std::exchange(leaf_radius_, 0.0);
    gather(kMargin * row_radius_);
  }

  /// Gathers the vertices in a ball, unless it has too many leaves. On surfaces, a fourth of this limit is enough.
  /// Where it is not, the vertices lie so unevenly that a ball may hold far more of them than a row.
  void gather(double radius) {
    constexpr std::size_t kFewLeaves = 64;
    radius_ = radius > 0 ? std::min(radius, most_) : most_;
    is_joint_ = packet_.gather(leaf_, radius_, kFewLeaves + most_taken_ / 4);
  }

  BoundIndex index_;
  StraightQueries queries_;  // for rows that are searched alone
  NearestPacket packet_;
  double most_;
  LeafId leaf_ = std::numeric_limits<LeafId>::max();
  double radius_ = 0;      // that the packet has gathered
  bool is_joint_ = false;  // else that was too much
  double row_radius_ = 0;  // the distance of the last vertex of the last row
  double leaf_radius_;     // the largest of these in the leaf
  std::size_t most_taken_ = 0;
};

/// Finds vertices by path distance or number of edges.
class LengthRowSearch {
 public:
  LengthRowSearch(const Index& index, const NearestOptions& options)
      : index_(index),
        graph_(IndexAccess::share_graph(index)),
        search_(make_length_search(*index_, *graph_, options.metric, kernels(best_isa()))),
        radius_(options.radius) {}

  /// The search ends when it has `enough` vertices, or more than `enough_area`.
  template <class Take>
  void run(VertexId v, std::size_t enough, double enough_area, std::span<const double> areas, Take&& take) {
    std::size_t count = 0;
    double area = 0;
    const auto on_found = [&](std::span<const Path> found) {
      count += found.size();
      if (!areas.empty()) {
        for (const Path& path : found) area += areas[index_->id(path.end)];
      }
      return count >= enough || area > enough_area * (1 + kAreaSlack);
    };
    const Path start{0, index_->place(v)};
    search_->run(std::span(&start, 1), radius_, std::cref(on_found));
    for (const Path& path : search_->in_order()) {
      if (!take(index_->id(path.end), path.length)) return;
    }
  }

 private:
  BoundIndex index_;
  std::shared_ptr<KeptGraph> graph_;
  std::unique_ptr<LengthSearch> search_;
  double radius_;
};

/// Calls `f(search, row)` for all rows with a search of the metric.
template <class F>
void for_each_row(const Index& index, NearestRows& rows, F&& f) {
  const NearestOptions& options = rows.options();
  prepare_searches(index, options.metric);
  if (options.metric == Metric::Straight) {
    rows.for_each([&] { return std::make_unique<StraightRowSearch>(index, options); }, f);
    return;
  }
  rows.for_each([&] { return std::make_unique<LengthRowSearch>(index, options); }, f);
}

struct Disc {
  std::vector<VertexId> ids;
  std::vector<double> distances;
};

/// Adds up to `enough` vertices to `disc`.
template <class Search>
void find_disc(Search& search, VertexId v, std::size_t enough, double area, std::span<const double> areas, Disc& disc) {
  double sum = 0;
  search.run(v, enough, area, areas, [&](VertexId vertex, double distance) {
    disc.ids.push_back(vertex);
    disc.distances.push_back(distance);
    sum += areas[vertex];
    return sum < area && disc.ids.size() < enough;
  });
}

/// Refuses discs that are far too large, by the sizes of a sample. Its rows end at several times the mean size that
/// fits, so that they take a part of the time of all rows.
void check_sample(const Index& index, const BatchVertices& vertices, double area, std::span<const double> areas,
                  const NearestOptions& options, Run run, const SizeLimit& limit) {
  constexpr std::size_t kWorthwhile = 64;
  constexpr std::uint64_t kTimesTheMean = 8;
  const std::size_t count = vertices.count(index.vertex_count());
  if (count < kWorthwhile * SizeLimit::kSample) return;
  const std::uint64_t most = limit.max_items() / count;
  if (most >= index.vertex_count()) return;
  std::vector<VertexId> some(SizeLimit::kSample);
  for (std::size_t i = 0; i < some.size(); ++i) some[i] = vertices[limit.sampled_row(i)];
  if (run.progress) {
    run.progress = [count, all = run.progress](std::size_t, std::size_t) { return all(0, count); };
  }
  NearestRows rows(index, some, options, run);
  std::vector<double> sizes(some.size());
  for_each_row(index, rows, [&](auto& search, std::size_t row) {
    Disc disc;
    find_disc(search, rows.vertex(row), static_cast<std::size_t>(kTimesTheMean * (most + 1)), area, areas, disc);
    sizes[row] = static_cast<double>(disc.ids.size());
  });
  limit.check_sample(sizes, "at least about ");
}

}  // namespace

KNearest k_nearest(const Index& index, const BatchVertices& vertices, std::size_t k, const NearestOptions& options,
                   const Run& run) {
  KNearest result;
  const auto allocate = [&](std::size_t count) -> BatchMemory {
    result.ids = make_values<VertexId>(count);
    result.distances = make_values<double>(count);
    return {result.ids, result.distances};
  };
  k_nearest(index, vertices, k, allocate, options, run);
  return result;
}

void k_nearest(const Index& index, const BatchVertices& vertices, std::size_t k, const BatchAllocator& allocate,
               const NearestOptions& options, const Run& run) {
  NearestRows rows(index, vertices, options, run);
  check_k(k);
  check_function(allocate, "allocate");
  if (rows.size() != 0 && k > kMostValues / rows.size()) {
    raise(ErrorCode::TooLarge, "k: " + std::to_string(k) + " vertices for each of " + std::to_string(rows.size()) +
                                   " rows, expected at most " + std::to_string(kMostValues) + " in all");
  }
  const SizeLimit limit(run.max_bytes, kItemBytes, rows.size());
  if (rows.size() * k > limit.max_items()) limit.refuse("", rows.size() * k);
  const BatchMemory memory = allocated(allocate, rows.size() * k, true);
  for_each_row(index, rows, [&](auto& search, std::size_t row) {
    const std::span<VertexId> ids = memory.ids.subspan(row * k, k);
    const std::span<double> distances = memory.distances.subspan(row * k, k);
    std::size_t next = 0;
    search.run(rows.vertex(row), k, kInfinity, {}, [&](VertexId vertex, double distance) {
      ids[next] = vertex;
      distances[next++] = distance;
      return next < k;
    });
    std::ranges::fill(ids.subspan(next), kNoVertex);
    std::ranges::fill(distances.subspan(next), kInfinity);
  });
}

Neighborhoods discs(const Index& index, const BatchVertices& vertices, double area, std::span<const double> areas,
                    const NearestOptions& options, const Run& run) {
  const std::vector<double> copy(areas.begin(), areas.end());
  areas = copy;
  if (!(area > 0 && std::isfinite(area))) {
    raise(ErrorCode::InvalidOption, "area: " + to_text(area) + ", expected a finite number > 0");
  }
  check_weights(areas, index.vertex_count(), "areas");
  NearestRows rows(index, vertices, options, run);
  SizeLimit limit(run.max_bytes, kItemBytes, rows.size());
  check_sample(index, vertices, area, areas, options, run, limit);
  std::vector<Disc> found(rows.size());
  for_each_row(index, rows, [&](auto& search, std::size_t row) {
    Disc disc;
    find_disc(search, rows.vertex(row), index.vertex_count() + 1, area, areas, disc);
    limit.add(disc.ids.size());
    found[row] = disc;  // the copy has no spare memory
  });
  Neighborhoods result;
  result.offsets.push_back(0);
  for (const Disc& disc : found) result.offsets.push_back(result.offsets.back() + disc.ids.size());
  result.ids.reserve(result.offsets.back());
  result.distances.reserve(result.offsets.back());
  for (Disc& disc : found) {
    result.ids.insert(result.ids.end(), disc.ids.begin(), disc.ids.end());
    result.distances.insert(result.distances.end(), disc.distances.begin(), disc.distances.end());
    disc = {};
  }
  return result;
}

}  // namespace meshhood::inline v0_1
