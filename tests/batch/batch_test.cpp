// SPDX-License-Identifier: MIT
// Batches give the answers of single queries, row by row, for every number of threads. Callers can end them.
#include "meshhood/batch.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <limits>
#include <new>
#include <numeric>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/meshhood.h"

#include "exact/index_access.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/refusal.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::array kThreads{1U, 2U, 3U, 8U};

/// The rows that a sink has received.
struct Streamed {
  std::vector<std::vector<VertexId>> ids;
  std::vector<std::vector<double>> distances;

  friend bool operator==(const Streamed&, const Streamed&) = default;
};

Streamed stream(const SearchMethod& index, const BatchQuery& query, const BatchOptions& options, const Run& run = {}) {
  Streamed result;
  for_each_neighborhood(
      index, query,
      [&](const BatchRow& row) {
        EXPECT_EQ(row.row, result.ids.size());
        result.ids.emplace_back(row.ids.begin(), row.ids.end());
        result.distances.emplace_back(row.distances.begin(), row.distances.end());
      },
      options, run);
  return result;
}

Streamed rows_of(const Neighborhoods& all) {
  Streamed result;
  for (std::size_t row = 0; row + 1 < all.offsets.size(); ++row) {
    const auto begin = static_cast<std::ptrdiff_t>(all.offsets[row]);
    const auto end = static_cast<std::ptrdiff_t>(all.offsets[row + 1]);
    result.ids.emplace_back(all.ids.begin() + begin, all.ids.begin() + end);
    result.distances.emplace_back();
    if (all.distances.empty()) continue;
    result.distances.back().assign(all.distances.begin() + begin, all.distances.begin() + end);
  }
  return result;
}

std::vector<std::uint64_t> sizes_of(const Streamed& rows) {
  std::vector<std::uint64_t> result(rows.ids.size());
  std::transform(rows.ids.begin(), rows.ids.end(), result.begin(), [](const auto& ids) { return ids.size(); });
  return result;
}

/// A row by a searcher of its own, with distances, sorted.
template <class Searcher>
void append_answer(Searcher& searcher, VertexId v, double radius, RowSort sort, Streamed& out) {
  std::vector<VertexId> ids;
  std::vector<double> distances;
  searcher.neighborhood(v, radius, ids, distances);
  std::vector<std::size_t> order(ids.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {},
                    [&](std::size_t i) { return std::pair(sort == RowSort::Distance ? distances[i] : 0.0, ids[i]); });
  out.ids.emplace_back();
  out.distances.emplace_back();
  for (const std::size_t i : order) {
    out.ids.back().push_back(ids[i]);
    out.distances.back().push_back(distances[i]);
  }
}

template <class Searcher, class Index>
Streamed one_by_one(const Index& index, std::span<const VertexId> vertices, std::span<const double> radii,
                    RowSort sort) {
  Streamed result;
  Searcher searcher(index);
  for (std::size_t row = 0; row < vertices.size(); ++row) {
    append_answer(searcher, vertices[row], radii[row], sort, result);
  }
  return result;
}

/// Rows of random vertices, some of them several times, each with a radius of its own.
struct RandomRows {
  std::vector<VertexId> vertices;
  std::vector<double> radii;

  RandomRows(const MeshView& mesh, std::size_t rows, std::uint64_t seed) {
    Random random(seed);
    if (mesh.positions.size() == 0) return;
    for (std::size_t row = 0; row < rows; ++row) {
      vertices.push_back(static_cast<VertexId>(random.below(mesh.positions.size())));
      const auto other = static_cast<VertexId>(random.below(mesh.positions.size()));
      radii.push_back(row % 50 == 0 ? kInfinity : 0.3 * distance(mesh.positions, vertices.back(), other));
    }
  }

  [[nodiscard]] BatchQuery query() const { return {.vertices = vertices, .radius = radii}; }
};

template <class Searcher, class Source>
void expect_right(const SearchMethod& index, const Source& source, const RandomRows& rows) {
  for (const RowSort sort : {RowSort::Id, RowSort::Distance}) {
    const Streamed expected = one_by_one<Searcher>(source, rows.vertices, rows.radii, sort);
    for (const unsigned threads : kThreads) {
      // The smaller buffers hold no row, or few.
      for (const std::size_t buffer : {std::size_t{0}, std::size_t{2000}, std::size_t{1} << 24}) {
        const BatchOptions options{.distances = true, .sort = sort, .buffer_bytes = buffer};
        EXPECT_EQ(stream(index, rows.query(), options, {.threads = threads}), expected)
            << threads << " threads, " << buffer << " bytes";
      }
      EXPECT_EQ(rows_of(neighborhoods(index, rows.query(), {.distances = true, .sort = sort}, {.threads = threads})),
                expected);
      EXPECT_EQ(counts(index, rows.query(), {.threads = threads}), sizes_of(expected));
    }
  }
}

MESHHOOD_SUITE_OF_FAMILIES(Families);

TEST_P(Families, RowsAreTheAnswersToSingleQueries) {
  std::size_t rows = 0;
  for (const std::size_t vertices : {std::size_t{1}, std::size_t{40}, scaled(1500, 400)}) {
    const TestMesh mesh = make_mesh(GetParam(), 5, vertices);
    SCOPED_TRACE(mesh.name);
    const RandomRows random(mesh.view(), 300, vertices);
    const Index exact = build(mesh.view());
    const paper::Index approximate = paper::build(mesh.view());
    const Adjacency edges = adjacency(mesh.view());
    const GraphView graph{mesh.view().positions, edges.view()};
    expect_right<Searcher>(exact, exact, random);
    expect_right<paper::Searcher>(approximate, approximate, random);
    expect_right<ReferenceSearcher>(SearchMethod::breadth_first(graph), graph, random);
    expect_right<BallSearcher>(SearchMethod::ball_scan(graph.positions), graph.positions, random);
    expect_right<BallSearcher>(SearchMethod(exact).by(Metric::Space), graph.positions, random);
    rows += random.vertices.size();
  }
  std::printf("%s: %zu rows, %zu numbers of threads\n", std::string(GetParam().name).c_str(), rows, kThreads.size());
}

/// A grid of 60 by 60 vertices, and its index.
class Batches : public testing::Test {
 protected:
  TestMesh mesh = make_grid(60, 60, false).finish(true);
  Index index = build(mesh.view());
};

TEST_F(Batches, WithoutAListTakeAllVerticesInOrder) {
  std::vector<VertexId> all(index.vertex_count());
  std::iota(all.begin(), all.end(), VertexId{0});
  const BatchOptions options{.sort = RowSort::Id};
  EXPECT_EQ(stream(index, {.radius = 2.5}, options), stream(index, {.vertices = all, .radius = 2.5}, options));
  EXPECT_EQ(counts(index, {.radius = 0.5}), std::vector<std::uint64_t>(all.size(), 1));
}

TEST_F(Batches, InIndexOrderAreTheSameRowsSortedByTheirPlaceInTheIndex) {
  const RandomRows rows(mesh.view(), 3000, 4);
  const Streamed expected = stream(index, rows.query(), {.distances = true, .sort = RowSort::Distance});
  const auto& slot = IndexAccess::view(index).slot;
  std::vector<std::size_t> order_on_one_thread;
  for (const unsigned threads : kThreads) {
    for (const std::size_t buffer : {std::size_t{1000}, std::size_t{100'000}, std::size_t{8} << 20}) {
      std::vector<std::size_t> order;
      const auto sink = [&](const BatchRow& row) {
        ASSERT_THAT(row.ids, testing::ElementsAreArray(expected.ids[row.row])) << "row " << row.row;
        order.push_back(row.row);
      };
      const BatchOptions options{
          .distances = true, .sort = RowSort::Distance, .in_index_order = true, .buffer_bytes = buffer};
      for_each_neighborhood(index, rows.query(), sink, options, {.threads = threads});
      EXPECT_TRUE(std::ranges::is_sorted(order, {}, [&](std::size_t row) { return slot[rows.vertices[row]]; }));
      if (order_on_one_thread.empty()) order_on_one_thread = order;
      EXPECT_EQ(order, order_on_one_thread);
    }
  }
  std::ranges::sort(order_on_one_thread);
  for (std::size_t row = 0; row < rows.vertices.size(); ++row) ASSERT_EQ(order_on_one_thread.at(row), row);
}

TEST_F(Batches, OfAReorderedMeshAreThoseOfTheMesh) {
  const ReorderedMesh reordered = reorder(mesh.view());
  const Streamed before = rows_of(neighborhoods(index, {.radius = 3}));
  Streamed now = rows_of(neighborhoods(reordered.index, {.radius = 3}, {}, {.threads = 2}));
  for (VertexId v = 0; v < index.vertex_count(); ++v) {
    for (VertexId& id : now.ids[v]) id = reordered.permutation[id];
    ASSERT_EQ(now.ids[v], before.ids[reordered.permutation[v]]);
  }
}

TEST_F(Batches, KeptStayInTheOrderOfTheirRows) {
  const RandomRows rows(mesh.view(), 3000, 5);
  for (const SearchMethod& method : {SearchMethod(index), SearchMethod::ball_scan(mesh.positions_view())}) {
    const Neighborhoods kept = neighborhoods(method, rows.query(), {.sort = RowSort::Id, .in_index_order = true});
    EXPECT_EQ(rows_of(kept), rows_of(neighborhoods(method, rows.query(), {.sort = RowSort::Id})));
  }
}

TEST_F(Batches, OfNoRowsAreEmpty) {
  const std::vector<VertexId> none;
  const BatchQuery query{.vertices = none, .radius = 1.0};
  EXPECT_THAT(counts(index, query), IsEmpty());
  EXPECT_THAT(neighborhoods(index, query).offsets, ElementsAre(0));
  EXPECT_THAT(stream(index, query, {}, {.threads = 2}).ids, IsEmpty());
}

TEST_F(Batches, OfAnEmptyMeshAreEmpty) {
  const Index empty = build(MeshView{});
  EXPECT_THAT(counts(empty, {.radius = 1.0}), IsEmpty());
  EXPECT_THAT(neighborhoods(empty, {.radius = 1.0}, {}, {.threads = 2}).offsets, ElementsAre(0));
  const paper::Index empty_paper = paper::build(MeshView{});
  EXPECT_THAT(stream(empty_paper, {.radius = 1.0}, {}).ids, IsEmpty());
  EXPECT_THAT(stream(SearchMethod::breadth_first({}), {.radius = 1.0}, {}).ids, IsEmpty());
  EXPECT_THAT(stream(SearchMethod::ball_scan({}), {.radius = 1.0}, {}).ids, IsEmpty());
}

TEST_F(Batches, GiveDistancesOnlyIfRequested) {
  EXPECT_THAT(neighborhoods(index, {.radius = 3.0}).distances, IsEmpty());
  const Neighborhoods all = neighborhoods(index, {.radius = 3.0}, {.distances = true});
  ASSERT_EQ(all.distances.size(), all.ids.size());
  EXPECT_EQ(*std::max_element(all.distances.begin(), all.distances.end()), 3.0);
}

/// Memory between guards that must not be written to.
template <class T>
class Guarded {
 public:
  std::span<T> take(std::size_t count) {
    values_.assign(count + 2 * kGuards, kUntouched);
    return std::span(values_).subspan(kGuards, count);
  }

  /// The allocated values, if the guards around them are unchanged.
  [[nodiscard]] std::vector<T> values() const {
    const auto is_untouched = [](T value) { return value == kUntouched; };
    EXPECT_TRUE(std::all_of(values_.begin(), values_.begin() + kGuards, is_untouched));
    EXPECT_TRUE(std::all_of(values_.end() - kGuards, values_.end(), is_untouched));
    return {values_.begin() + kGuards, values_.end() - kGuards};
  }

 private:
  static constexpr std::ptrdiff_t kGuards = 64;
  static constexpr T kUntouched = 123456789;
  std::vector<T> values_;
};

void expect_same_in_callers_memory(const SearchMethod& index, const BatchQuery& query, const BatchOptions& options,
                                   const Run& run) {
  const Neighborhoods expected = neighborhoods(index, query, options, run);
  Guarded<VertexId> ids;
  Guarded<double> distances;
  std::vector<std::size_t> calls;
  const auto caller = std::this_thread::get_id();
  const auto allocate = [&](std::size_t count) -> BatchMemory {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    calls.push_back(count);
    return {ids.take(count), distances.take(options.distances ? count : 0)};
  };
  EXPECT_EQ(neighborhoods(index, query, allocate, options, run), expected.offsets);
  EXPECT_THAT(calls, ElementsAre(expected.ids.size()));
  EXPECT_EQ(ids.values(), expected.ids);
  EXPECT_EQ(distances.values(), expected.distances);
}

TEST_F(Batches, FillMemoryThatTheCallerAllocates) {
  const paper::Index approximate = paper::build(mesh.view());
  const RandomRows rows(mesh.view(), 500, 3);
  for (const unsigned threads : kThreads) {
    for (const bool distances : {false, true}) {
      const BatchOptions options{.distances = distances, .sort = distances ? RowSort::Distance : RowSort::None};
      expect_same_in_callers_memory(index, rows.query(), options, {.threads = threads});
      expect_same_in_callers_memory(approximate, rows.query(), options, {.threads = threads});
    }
  }
  const Index empty = build(MeshView{}, {});
  expect_same_in_callers_memory(empty, {.radius = 1.0}, {}, {});
}

TEST_F(Batches, RefuseMemoryOfAnotherSize) {
  std::vector<VertexId> ids(4000);
  std::vector<double> distances(4000);
  const auto refused = [&](const std::string& cause, std::size_t with_ids, std::size_t with_distances) {
    const auto allocate = [&](std::size_t) -> BatchMemory {
      return {std::span(ids).first(with_ids), std::span(distances).first(with_distances)};
    };
    expect_refused(ErrorCode::InvalidOption, cause, [&] {
      return neighborhoods(index, {.radius = 0.5}, allocate, {.distances = true}, {.threads = 2});
    });
  };
  refused("memory for 3599 ids, expected for 3600", 3599, 3600);
  refused("memory for 3601 ids, expected for 3600", 3601, 3600);
  refused("memory for 0 distances, expected for 3600", 3600, 0);
  expect_refused(ErrorCode::InvalidOption, "allocate is empty",
                 [&] { return neighborhoods(index, {.radius = 1.0}, BatchAllocator{}); });
}

TEST_F(Batches, PassOnExceptionsOfTheAllocator) {
  for (const unsigned threads : kThreads) {
    const auto allocate = [](std::size_t) -> BatchMemory { throw std::bad_alloc(); };
    EXPECT_THROW(static_cast<void>(neighborhoods(index, {.radius = 2.0}, allocate, {}, {.threads = threads})),
                 std::bad_alloc);
  }
}

TEST_F(Batches, OfMoreRowsThanAPieceHaveAllRows) {
  const std::vector<VertexId> vertices((std::size_t{1} << 20) + 5, VertexId{7});
  const std::vector<std::uint64_t> all = counts(index, {.vertices = vertices, .radius = 1.0}, {.threads = 2});
  EXPECT_EQ(all.size(), vertices.size());
  EXPECT_EQ(std::count(all.begin(), all.end(), all.front()), static_cast<std::ptrdiff_t>(all.size()));
}

/// Expects each of the calls to refuse before it passes on rows or reports progress.
void expect_all_refused(ErrorCode code, const std::string& cause, const SearchMethod& index, const BatchQuery& query,
                        meshhood::Run run) {
  const auto never = [&](const BatchRow&) { ADD_FAILURE() << "passed on before: " << cause; };
  run.progress = [&](std::size_t, std::size_t) {
    ADD_FAILURE() << "reported before: " << cause;
    return true;
  };
  expect_refused(code, cause, [&] { for_each_neighborhood(index, query, never, {}, run); });
  expect_refused(code, cause, [&] { return neighborhoods(index, query, {}, run); });
  expect_refused(code, cause, [&] { return counts(index, query, run); });
  const auto no_memory = [&](std::size_t) -> BatchMemory {
    ADD_FAILURE() << "allocated before: " << cause;
    return {};
  };
  expect_refused(code, cause, [&] { return neighborhoods(index, query, no_memory, {}, run); });
}

TEST_F(Batches, RefuseInvalidArgumentsBeforeTheFirstRow) {
  const std::vector<VertexId> vertices{0, 1, 3600};
  const std::vector<double> two{1, 1};
  const std::vector<double> radii{1, -1, 1};
  const std::vector<VertexId> three{0, 1, 2};
  const paper::Index approximate = paper::build(mesh.view());
  const auto refused = [&](ErrorCode code, const std::string& cause, const BatchQuery& query,
                           const meshhood::Run& run = {}) {
    expect_all_refused(code, cause, index, query, run);
    expect_all_refused(code, cause, approximate, query, run);
    expect_all_refused(code, cause, SearchMethod::ball_scan(mesh.view().positions), query, run);
  };
  refused(ErrorCode::VertexOutOfRange, "row 2: vertex 3600, but the mesh has 3600 vertices",
          {.vertices = vertices, .radius = 1.0});
  refused(ErrorCode::InvalidRadius, "radius -2, expected", {.radius = -2.0});
  refused(ErrorCode::InvalidRadius, "radius nan, expected", {});
  refused(ErrorCode::InvalidRadius, "row 1: radius -1, expected", {.vertices = three, .radius = radii});
  refused(ErrorCode::InvalidRadius, "2 radii for 3 rows", {.vertices = three, .radius = two});
  refused(ErrorCode::InvalidRadius, "2 radii for 3600 rows", {.radius = two});
  refused(ErrorCode::InvalidOption, "threads is 1025, expected at most 1024", {.radius = 1.0}, {.threads = 1025});
  expect_refused(ErrorCode::InvalidOption, "radius_ratio is 0",
                 [&] { const SearchMethod method(approximate, {.radius_ratio = 0}); });
  for (const SearchMethod& method : {SearchMethod(index), SearchMethod::ball_scan(mesh.positions_view())}) {
    expect_refused(ErrorCode::InvalidOption, "distances is false, expected true to sort by distance",
                   [&] { return neighborhoods(method, {.radius = 1.0}, {.sort = RowSort::Distance}); });
  }
}

TEST_F(Batches, RefuseAnInvalidGraph) {
  const std::vector<EdgeOffset> offsets{0, 1, 1};
  const std::vector<VertexId> neighbors{1};
  const std::vector<float> positions(6);
  expect_refused(ErrorCode::InvalidMesh, "0 is not among the neighbors of 1",
                 [&] { return SearchMethod::breadth_first({positions, {offsets, neighbors}}); });
}

TEST_F(Batches, ReadTheirQueryOnce) {
  const paper::Index approximate = paper::build(mesh.view());
  const Adjacency edges = adjacency(mesh.view());
  const GraphView graph{mesh.view().positions, edges.view()};
  const RandomRows rows(mesh.view(), 500, 8);
  for (const SearchMethod& method : {SearchMethod(index), SearchMethod(approximate), SearchMethod::breadth_first(graph),
                                     SearchMethod::ball_scan(graph.positions)}) {
    const Neighborhoods expected = neighborhoods(method, rows.query());
    RandomRows changed = rows;
    const meshhood::Run run{.progress = [&](std::size_t, std::size_t) {
      std::fill(changed.vertices.begin(), changed.vertices.end(), VertexId{4'000'000'000});
      std::fill(changed.radii.begin(), changed.radii.end(), std::numeric_limits<double>::quiet_NaN());
      return true;
    }};
    EXPECT_EQ(neighborhoods(method, changed.query(), {}, run).ids, expected.ids);
    changed = rows;
    EXPECT_EQ(counts(method, changed.query(), run), sizes_of(rows_of(expected)));
    changed = rows;
    EXPECT_EQ(stream(method, changed.query(), {}, run).ids.size(), rows.vertices.size());
  }
}

TEST_F(Batches, RefuseAResultBeyondTheLimit) {
  const std::uint64_t ids = neighborhoods(index, {.radius = 3}).ids.size();
  for (const unsigned threads : kThreads) {
    for (const bool distances : {false, true}) {
      const std::uint64_t bytes = ids * (sizeof(VertexId) + (distances ? sizeof(double) : 0));
      meshhood::Run run{.threads = threads, .max_bytes = bytes};
      EXPECT_EQ(neighborhoods(index, {.radius = 3}, {.distances = distances}, run).ids.size(), ids);
      --run.max_bytes;
      expect_refused(ErrorCode::TooLarge, " bytes, exceeds max_bytes, " + std::to_string(run.max_bytes),
                     [&] { return neighborhoods(index, {.radius = 3}, {.distances = distances}, run); });
    }
  }
}

TEST_F(Batches, RefuseAResultFarBeyondTheLimitByASample) {
  const std::vector<VertexId> vertices(100'000, VertexId{7});
  std::size_t most = 0;
  const meshhood::Run run{.progress =
                              [&](std::size_t done, std::size_t) {
                                most = std::max(most, done);
                                return true;
                              },
                          .max_bytes = std::uint64_t{1} << 30};
  expect_refused(ErrorCode::TooLarge, "about 1440000000 bytes, exceeds max_bytes, 1073741824",
                 [&] { return neighborhoods(index, {.vertices = vertices, .radius = kInfinity}, {}, run); });
  EXPECT_EQ(most, 0U) << "all rows of the refused batch were counted";
}

TEST_F(Batches, AcceptAResultWithinTheLimitThatTheSampleDoesNotExclude) {
  // Half of the rows are large: their sample does not prove that the result is too large.
  std::vector<VertexId> vertices(20'000, VertexId{7});
  std::vector<double> radii(vertices.size(), 0.0);
  for (std::size_t row = 0; row < radii.size(); row += 2) radii[row] = 3;
  const BatchQuery query{.vertices = vertices, .radius = radii};
  const std::uint64_t ids = neighborhoods(index, query).ids.size();
  EXPECT_EQ(neighborhoods(index, query, {}, {.max_bytes = ids * sizeof(VertexId)}).ids.size(), ids);
}

TEST_F(Batches, AcceptAMaskedResultWithinTheLimitThatTheWholeOneExceeds) {
  const std::vector<VertexId> vertices(20'000, VertexId{7});
  std::vector<std::uint8_t> others(index.vertex_count(), 1);
  others[7] = 0;
  const meshhood::Run run{.max_bytes = vertices.size() * sizeof(VertexId)};
  for (const Masks& masks : {Masks{.walls = others}, Masks{.ignored = others}}) {
    const BatchQuery query{.vertices = vertices, .radius = kInfinity};
    const Index searched = masked(index, masks);
    EXPECT_EQ(neighborhoods(searched, query, {}, run).ids, vertices);
  }
}

TEST_F(Batches, ReportFromZeroToTheTotalOnTheCallingThread) {
  for (const unsigned threads : kThreads) {
    std::vector<std::size_t> reports;
    const auto caller = std::this_thread::get_id();
    const meshhood::Run run{.threads = threads, .progress = [&](std::size_t done, std::size_t total) {
                              EXPECT_EQ(std::this_thread::get_id(), caller);
                              EXPECT_EQ(total, index.vertex_count());
                              reports.push_back(done);
                              return true;
                            }};
    for_each_neighborhood(
        index, {.radius = 2.0},
        [&](const BatchRow& row) {
          EXPECT_EQ(std::this_thread::get_id(), caller);
          if (row.row % 1000 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(60));
        },
        {}, run);
    EXPECT_EQ(reports.front(), 0U);
    EXPECT_EQ(reports.back(), index.vertex_count());
    EXPECT_GE(reports.size(), 5U);
    EXPECT_TRUE(std::is_sorted(reports.begin(), reports.end()));
  }
}

/// Runs a slow batch that is cancelled at its report `last`. Returns the number of rows that were passed on.
std::size_t rows_before_cancel(const Index& index, unsigned threads, std::size_t last) {
  std::size_t reports = 0;
  std::size_t rows = 0;
  const BatchOptions options{.buffer_bytes = 20000};
  const meshhood::Run run{.threads = threads, .progress = [&](std::size_t, std::size_t) { return ++reports < last; }};
  const auto sink = [&](const BatchRow&) {
    if (++rows % 500 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(60));
  };
  expect_refused(ErrorCode::Cancelled, "cancelled",
                 [&] { for_each_neighborhood(index, {.radius = 2.0}, sink, options, run); });
  EXPECT_EQ(reports, last);
  return rows;
}

TEST_F(Batches, CanBeCancelledAtAnyReport) {
  for (const unsigned threads : kThreads) {
    EXPECT_EQ(rows_before_cancel(index, threads, 1), 0U);
    std::size_t rows = 0;
    for (const std::size_t last : {2U, 3U, 5U, 8U}) {
      const std::size_t now = rows_before_cancel(index, threads, last);
      EXPECT_GE(now, rows);  // a slow machine may report twice between two rows
      rows = now;
    }
    EXPECT_LT(rows, index.vertex_count());
    const auto no = [](std::size_t, std::size_t) { return false; };
    expect_refused(ErrorCode::Cancelled, "cancelled",
                   [&] { return counts(index, {.radius = 2.0}, {.threads = threads, .progress = no}); });
  }
}

TEST_F(Batches, PassOnExceptionsOfTheSink) {
  for (const unsigned threads : kThreads) {
    for (const std::size_t last : {0U, 1U, 255U, 256U, 3599U}) {
      std::size_t rows = 0;
      const auto sink = [&](const BatchRow& row) {
        ++rows;
        if (row.row == last) throw std::bad_alloc();
      };
      EXPECT_THROW(for_each_neighborhood(index, {.radius = 2.0}, sink, {}, {.threads = threads}), std::bad_alloc);
      EXPECT_EQ(rows, last + 1);
    }
    EXPECT_EQ(counts(index, {.radius = kInfinity}, {.threads = threads}).back(), index.vertex_count());
  }
}

TEST(BatchQuery, RefusesResultsThatNoArrayCanHave) {
  constexpr std::size_t kMost = std::numeric_limits<std::ptrdiff_t>::max() / sizeof(double);
  const BatchQuery two{.radius = BatchRadius::scales({1, 2})};
  EXPECT_EQ(two.result_rows(kMost / 2), kMost / 2 * 2);
  EXPECT_EQ(two.result_rows(kMost / 20, 10), kMost / 20 * 2);
  EXPECT_EQ(two.result_rows(0), 0U);
  for (const auto& [rows, columns] : {std::pair(kMost / 2 + 1, std::size_t{1}), {kMost / 10, 10}, {kMost, kMost}}) {
    const auto ask = [&two, rows, columns] { return two.result_rows(rows, columns); };
    expect_refused(ErrorCode::TooLarge, "the result of 2 radii by " + std::to_string(rows), ask);
  }
}

TEST_F(Batches, PassOnExceptionsOfTheProgressCallback) {
  for (const unsigned threads : kThreads) {
    const meshhood::Run run{.threads = threads, .progress = [](std::size_t done, std::size_t total) {
                              if (done == total) throw std::bad_alloc();
                              return true;
                            }};
    EXPECT_THROW(static_cast<void>(counts(index, {.radius = 2.0}, run)), std::bad_alloc);
  }
}

}  // namespace
}  // namespace meshhood::test
