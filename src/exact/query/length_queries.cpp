// SPDX-License-Identifier: MIT
// Answers queries by the metrics that sum lengths along edges. A neighborhood has the vertices whose length is at most
// the radius, so all calls are cuts of one list.
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <span>
#include <utility>

#include "exact/query/length_search.h"
#include "exact/query/path_search.h"
#include "exact/query/single_queries.h"
#include "shared/distance.h"

namespace meshhood::inline v0_1 {
namespace {

class PathLengthSearch final : public LengthSearch {
 public:
  PathLengthSearch(const IndexView& index, KeptGraph& graph) : LengthSearch(index), paths_(index, graph) {}

  void run(std::span<const Path> starts, double radius, const OnFound& on_found) override {
    paths_.run(starts, radius,
               [&](std::span<const Path> found) { return on_found && on_found(without_ignored(found)); });
  }

  std::span<const Path> found() override { return without_ignored(paths_.found()); }
  std::span<const Path> in_order() override { return without_ignored(paths_.found_in_order()); }

 private:
  std::span<const Path> without_ignored(std::span<const Path> paths) {
    if (index_->ignored.empty()) return paths;
    some_.clear();
    for (const Path& path : paths) {
      if (!index_->is_ignored_at(path.end)) some_.push_back(path);
    }
    return some_;
  }

  PathSearch paths_;
  std::vector<Path> some_;
};

struct LengthQueries final : SingleQueries {
  using SingleQueries::SingleQueries;

  void rebind(BoundIndex bound, std::shared_ptr<KeptGraph> kept) override {
    if (kept != graph) search_.reset();  // it has lengths of edges
    SingleQueries::rebind(std::move(bound), std::move(kept));
  }

  VertexSet& search(const Start& start, double radius) override {
    subsets_.clear();
    run_checked(start, radius).collect(subsets_);
    answer.assign(subsets_);
    return answer;
  }

  std::size_t count(const Start& start, double radius) override { return run_checked(start, radius).found().size(); }

  void list(const Start& start, double radius, std::vector<VertexId>& out, std::vector<double>* distances) override {
    // Rings are found leaf by leaf; to sort their vertices one by one takes longer than the search.
    if (metric == Metric::Rings && distances == nullptr) {
      return replace_ids(search(start, radius), *index, *kernels, out);
    }
    const std::span<const Path> found = in_order_of_ids(run_checked(start, radius));
    out.reserve(found.size());
    if (distances != nullptr) distances->reserve(found.size());
    out.clear();
    if (distances != nullptr) distances->clear();
    for (const Path& path : found) {
      out.push_back(index->id(path.end));
      if (distances != nullptr) distances->push_back(path.length);
    }
  }

  void collect(const Start& start, double radius, std::vector<LeafSubset>& found) override {
    run(start, radius).collect(found);
  }

  void nested(const Start& start, std::span<const double> radii, std::vector<VertexId>& ids,
              std::vector<std::size_t>& sizes) override {
    const std::span<const Path> found = run(start, radii.back()).in_order();
    sorted_.assign(found.begin(), found.end());
    auto begin = sorted_.begin();
    for (const double radius : radii) {
      const auto end = std::find_if(begin, sorted_.end(), [&](const Path& path) { return path.length > radius; });
      std::sort(begin, end, is_before);
      for (; begin != end; ++begin) ids.push_back(index->id(begin->end));
      sizes.push_back(ids.size());
    }
  }

  bool contains(const Start& start, VertexId w, double radius) override {
    return length_to(w, start, radius) != kNoRadius;
  }

  double connecting_radius(const Start& start, VertexId w) override { return length_to(w, start, kNoRadius); }

  void nearest(const Start& start, std::size_t k, std::vector<VertexId>& ids, std::vector<double>& radii) override {
    std::size_t count = 0;
    const std::span<const Path> found =
        run(start, kNoRadius, [&](std::span<const Path> next) { return (count += next.size()) >= k; }).in_order();
    for (const Path& path : found.first(std::min(k, found.size()))) {
      ids.push_back(index->id(path.end));
      radii.push_back(path.length);
    }
  }

 private:
  static bool is_before(const Path& a, const Path& b) { return a.end < b.end; }

  LengthSearch& run(const Start& start, double radius, const LengthSearch::OnFound& on_found = {}) {
    if (!search_) search_ = make_length_search(*index, *graph, metric, *kernels);
    starts_.clear();
    for (const VertexId seed : start.seeds()) starts_.push_back({length_to_seed(start, seed), index->place(seed)});
    search_->run(starts_, radius, on_found);
    return *search_;
  }

  /// Returns the length of the straight line with which a path begins.
  double length_to_seed(const Start& start, VertexId seed) {
    return start.center() ? std::sqrt(squared_distance(center_of(start), index->position_of(seed))) : 0;
  }

  LengthSearch& run_checked(const Start& start, double radius) {
    check(start);
    check_radius(radius);
    return run(start, radius);
  }

  /// Returns the answer in the order of its ids: by length for paths, in index order for rings.
  std::span<const Path> in_order_of_ids(LengthSearch& search) {
    if (metric == Metric::Path) return search.in_order();
    const std::span<const Path> found = search.found();
    sorted_.assign(found.begin(), found.end());
    std::ranges::sort(sorted_, is_before);
    return sorted_;
  }

  /// Returns infinity if the length is more than `radius`.
  double length_to(VertexId w, const Start& start, double radius) {
    const std::uint32_t place = index->place(w);
    double length = kNoRadius;
    run(start, radius, [&](std::span<const Path> next) {
      for (const Path& path : next) {
        if (path.end == place) length = path.length;
      }
      return length != kNoRadius;
    });
    return length;
  }

  std::unique_ptr<LengthSearch> search_;  // made by the first query: for paths it needs the lengths of all edges
  std::vector<Path> starts_;              // scratch, as the next two
  std::vector<LeafSubset> subsets_;
  std::vector<Path> sorted_;
};

}  // namespace

void LengthSearch::collect(std::vector<LeafSubset>& subsets) {
  for (const Path& path : found()) {
    const std::uint32_t slot = index_->slot_at(path.end);
    subsets.push_back({leaf_of(slot), LaneMask{1} << lane_of(slot)});
  }
}

std::unique_ptr<LengthSearch> make_length_search(const IndexView& index, KeptGraph& graph, Metric metric,
                                                 const Kernels& kernels) {
  if (metric == Metric::Path) return std::make_unique<PathLengthSearch>(index, graph);
  return make_ring_search(index, graph, kernels);
}

std::unique_ptr<SingleQueries> make_length_queries(BoundIndex index, std::shared_ptr<KeptGraph> graph, Metric metric,
                                                   Isa isa) {
  return std::make_unique<LengthQueries>(std::move(index), std::move(graph), metric, isa);
}

}  // namespace meshhood::inline v0_1
