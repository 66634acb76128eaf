// SPDX-License-Identifier: MIT
#include "methods.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "meshhood/error.h"
#include "meshhood/paper.h"
#include "meshhood/reference.h"

#include "pool.h"

namespace meshhood::python {
namespace {

/// What `meshhood::Index` and `meshhood::paper::Index` have in common; `Base` is the interface to fill.
template <class Base, class Index, class Searcher>
class IndexMethod : public Base {
 public:
  explicit IndexMethod(Index index) : index_(std::move(index)) {}

  Answer neighborhood(VertexId v, double radius, bool distances) override {
    return ask([&](Searcher& searcher) {
      Answer answer;
      if (distances) {
        searcher.neighborhood(v, radius, answer.ids, answer.distances);
      } else {
        searcher.neighborhood(v, radius, answer.ids);
      }
      return answer;
    });
  }

  std::size_t count(VertexId v, double radius) override {
    return ask([&](Searcher& searcher) { return searcher.count(v, radius); });
  }

  Neighborhoods neighborhoods(const BatchQuery& query, const BatchOptions& options) override {
    // Found by the namespace of `Index`.
    using meshhood::neighborhoods;
    return neighborhoods(index_, query, options);
  }

  std::vector<std::uint64_t> counts(const BatchQuery& query, const BatchOptions& options) override {
    using meshhood::counts;
    return counts(index_, query, options);
  }

 protected:
  template <class F>
  auto ask(F&& f) {
    return searchers_.with([&] { return Searcher(index_); }, std::forward<F>(f));
  }

  [[nodiscard]] const Index& built() const { return index_; }

 private:
  Index index_;
  Pool<Searcher> searchers_;
};

class IndexedExactMethod : public IndexMethod<ExactMethod, Index, Searcher> {
 public:
  using IndexMethod::IndexMethod;

  [[nodiscard]] const Index& index() const override { return built(); }

  std::vector<VertexRange> ranges(VertexId v, double radius) override {
    return ask([&](Searcher& searcher) {
      const auto ranges = searcher.ranges(v, radius);
      return std::vector(ranges.begin(), ranges.end());
    });
  }
};

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

/// A method that only knows how to find the ids of one neighborhood.
class ScanMethod : public Method {
 public:
  explicit ScanMethod(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

  Answer neighborhood(VertexId v, double radius, bool distances) override {
    Answer answer{find(v, radius), {}};
    if (distances) append_distances(v, answer.ids, answer.distances);
    return answer;
  }

  std::size_t count(VertexId v, double radius) override { return find(v, radius).size(); }

  Neighborhoods neighborhoods(const BatchQuery& query, const BatchOptions& options) override {
    Neighborhoods result;
    result.offsets = {0};
    for_each_row(query, options, [&](VertexId v, std::vector<VertexId> ids) {
      if (options.sorted) std::sort(ids.begin(), ids.end());
      if (options.distances) append_distances(v, ids, result.distances);
      result.ids.insert(result.ids.end(), ids.begin(), ids.end());
      result.offsets.push_back(result.ids.size());
    });
    return result;
  }

  std::vector<std::uint64_t> counts(const BatchQuery& query, const BatchOptions& options) override {
    std::vector<std::uint64_t> result;
    for_each_row(query, options, [&](VertexId, const std::vector<VertexId>& ids) { result.push_back(ids.size()); });
    return result;
  }

 protected:
  [[nodiscard]] virtual std::vector<VertexId> find(VertexId v, double radius) = 0;
  [[nodiscard]] const Data& data() const { return *data_; }

 private:
  void append_distances(VertexId v, const std::vector<VertexId>& ids, std::vector<double>& distances) const {
    const PositionsView positions = data_->positions();
    for (const VertexId w : ids) distances.push_back(distance(positions, v, w));
  }

  template <class F>
  void for_each_row(const BatchQuery& query, const BatchOptions& options, F&& f) {
    const std::size_t rows = query.vertices ? query.vertices->size() : data_->positions().size();
    const auto* const radii = std::get_if<std::span<const double>>(&query.radius);
    Steps steps(options.progress, rows);
    for (std::size_t row = 0; row < rows; ++row) {
      const VertexId v = query.vertices ? (*query.vertices)[row] : static_cast<VertexId>(row);
      f(v, find(v, radii != nullptr ? (*radii)[row] : std::get<double>(query.radius)));
      steps.done(row + 1);
    }
  }

  std::shared_ptr<const Data> data_;
};

class BfsMethod : public ScanMethod {
 public:
  using ScanMethod::ScanMethod;

 protected:
  std::vector<VertexId> find(VertexId v, double radius) override {
    return searchers_.with([&] { return ReferenceSearcher(data().view()); },
                           [&](ReferenceSearcher& searcher) {
                             std::vector<VertexId> ids;
                             searcher.neighborhood(v, radius, ids);
                             return ids;
                           });
  }

 private:
  Pool<ReferenceSearcher> searchers_;
};

class BallMethod : public ScanMethod {
 public:
  using ScanMethod::ScanMethod;

 protected:
  std::vector<VertexId> find(VertexId v, double radius) override {
    std::vector<VertexId> ids;
    ball(data().positions(), v, radius, ids);
    return ids;
  }
};

}  // namespace

std::shared_ptr<ExactMethod> exact_method(const Data& data, const BuildOptions& options) {
  return std::make_shared<IndexedExactMethod>(build(data.view(), options));
}

std::shared_ptr<Method> paper_method(const Data& data) {
  return std::make_shared<IndexMethod<Method, paper::Index, paper::Searcher>>(paper::build(data.view()));
}

std::shared_ptr<Method> bfs_method(std::shared_ptr<const Data> data) {
  return std::make_shared<BfsMethod>(std::move(data));
}

std::shared_ptr<Method> ball_method(std::shared_ptr<const Data> data) {
  return std::make_shared<BallMethod>(std::move(data));
}

}  // namespace meshhood::python
