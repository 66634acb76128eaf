// SPDX-License-Identifier: MIT
// The yardsticks, which search without an index.
#include <algorithm>
#include <chrono>
#include <memory>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "meshhood/adjacency.h"
#include "meshhood/error.h"
#include "meshhood/reference.h"

#include "interpreter.h"
#include "methods.h"
#include "pool.h"

namespace meshhood::python {
namespace {

/// Tells `progress` now and then, for loops that the core does not watch.
class Steps {
 public:
  Steps(const Progress& progress, std::size_t total) : progress_(progress), total_(total) { tell(0); }

  void done(std::size_t step) {
    const auto now = Clock::now();
    if (step < total_ && now - told_ < std::chrono::milliseconds(50)) return;
    told_ = now;
    tell(step);
  }

 private:
  using Clock = std::chrono::steady_clock;

  void tell(std::size_t step) const {
    if (progress_ && !progress_(step, total_)) raise(ErrorCode::Cancelled, "cancelled");
  }

  const Progress& progress_;
  std::size_t total_;
  Clock::time_point told_ = Clock::now();
};

class BfsScan {
 public:
  explicit BfsScan(const GraphView& graph) : searcher_(graph) {}
  void find(VertexId v, double radius, std::vector<VertexId>& ids) { searcher_.neighborhood(v, radius, ids); }

 private:
  ReferenceSearcher searcher_;
};

class BallScan {
 public:
  explicit BallScan(const GraphView& graph) : positions_(graph.positions) {}
  void find(VertexId v, double radius, std::vector<VertexId>& ids) const {
    vertices_in_ball(positions_, v, radius, ids);
  }

 private:
  PositionsView positions_;
};

/// A method that finds the ids of one neighborhood at a time.
template <class Scan>
class ScanMethod : public Method {
 public:
  explicit ScanMethod(std::shared_ptr<const GraphData> graph) : graph_(std::move(graph)) {}

  Answer neighborhood(VertexId v, double radius, bool distances) override {
    return with_scan([&](Scan& scan) {
      Answer answer;
      scan.find(v, radius, answer.ids);
      if (distances) append_distances(v, answer.ids, answer.distances);
      return answer;
    });
  }

  std::size_t count(VertexId v, double radius) override { return neighborhood(v, radius, false).ids.size(); }

  std::vector<std::uint64_t> neighborhoods(const BatchQuery& query, const BatchAllocator& allocate,
                                           const BatchOptions& options) override {
    // To find each row twice would take longer than to copy it.
    Neighborhoods result;
    result.offsets = {0};
    for_each_row(query, options, [&](VertexId v, std::vector<VertexId>& ids) {
      if (options.sorted) std::sort(ids.begin(), ids.end());
      if (options.distances) append_distances(v, ids, result.distances);
      result.ids.insert(result.ids.end(), ids.begin(), ids.end());
      result.offsets.push_back(result.ids.size());
    });
    return without_lock([&] {
      const BatchMemory memory = allocate(result.ids.size());
      std::copy(result.ids.begin(), result.ids.end(), memory.ids.begin());
      std::copy(result.distances.begin(), result.distances.end(), memory.distances.begin());
      return std::move(result.offsets);
    });
  }

  std::vector<std::uint64_t> neighborhood_sizes(const BatchQuery& query, const BatchOptions& options) override {
    std::vector<std::uint64_t> result;
    for_each_row(query, options, [&](VertexId, const std::vector<VertexId>& ids) { result.push_back(ids.size()); });
    return result;
  }

 private:
  template <class F>
  auto with_scan(F&& f) {
    return scans_.with([&] { return Scan(graph_->view()); }, std::forward<F>(f));
  }

  void append_distances(VertexId v, const std::vector<VertexId>& ids, std::vector<double>& distances) const {
    const PositionsView positions = graph_->view().positions;
    for (const VertexId w : ids) distances.push_back(distance(positions, v, w));
  }

  template <class F>
  void for_each_row(const BatchQuery& query, const BatchOptions& options, F&& f) {
    const std::size_t rows = query.vertices ? query.vertices->size() : graph_->view().positions.size();
    const auto* const radii = std::get_if<std::span<const double>>(&query.radius);
    with_scan([&](Scan& scan) {
      Steps steps(options.progress, rows);
      std::vector<VertexId> ids;
      for (std::size_t row = 0; row < rows; ++row) {
        const VertexId v = query.vertices ? (*query.vertices)[row] : static_cast<VertexId>(row);
        scan.find(v, radii != nullptr ? (*radii)[row] : std::get<double>(query.radius), ids);
        f(v, ids);
        steps.done(row + 1);
      }
      return rows;
    });
  }

  std::shared_ptr<const GraphData> graph_;
  Pool<Scan> scans_;
};

}  // namespace

std::shared_ptr<Method> bfs_method(std::shared_ptr<const GraphData> graph) {
  return std::make_shared<ScanMethod<BfsScan>>(std::move(graph));
}

std::shared_ptr<Method> ball_method(std::shared_ptr<const GraphData> graph) {
  return std::make_shared<ScanMethod<BallScan>>(std::move(graph));
}

}  // namespace meshhood::python
