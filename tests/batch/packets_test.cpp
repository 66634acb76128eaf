// SPDX-License-Identifier: MIT
// The packets of a batch hold the neighborhoods of its rows, for any selection of rows.
#include "batch/packets.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <map>
#include <mutex>
#include <numeric>
#include <set>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/meshhood.h"

#include "batch/row_search.h"
#include "exact/index_access.h"
#include "support/exact_answer.h"
#include "support/families.h"
#include "support/indexed.h"
#include "support/random.h"
#include "support/refusal.h"
#include "support/reports.h"

namespace meshhood::test {
namespace {

/// Calls `f(place, queries)` for the vertices of a packet, by their places in index order.
template <class F>
void for_each_vertex(const PacketAnswer& answer, const Index& index, F&& f) {
  for (const auto& [leaves, queries, reached] : answer.pieces) {
    const std::size_t begin = index.leaf_starts()[leaves.begin];
    const std::size_t size = index.leaf_starts()[leaves.end] - begin;
    for (std::size_t i = 0; i < size; ++i) f(begin + i, reached == nullptr ? queries : reached[i]);
    if (reached == nullptr) continue;
    EXPECT_EQ(leaves.begin + 1, leaves.end);
    EXPECT_TRUE(std::all_of(reached + size, reached + kLeafCapacity, [](QueryWord word) { return word == 0; }));
  }
}

/// Adds up `signal`, which is in index order, for each row of a packet.
std::vector<double> sums_of(const PacketAnswer& answer, const Index& index, std::span<const double> signal) {
  std::vector<double> sums(answer.rows.size());
  for_each_vertex(answer, index, [&](std::size_t place, QueryWord queries) {
    for_each_query(queries, [&](std::size_t row) { sums[row] += signal[place]; });
  });
  return sums;
}

/// Visits all packets on this thread.
void visit(const Index& index, const BatchQuery& query, const PacketVisitor& visitor) {
  for_each_packet(index, query, [&](unsigned) { return visitor; }, {.threads = 1});
}

/// One visitor for all threads.
PacketVisitorFactory everyone(const PacketVisitor& visitor) {
  return [visitor](unsigned) { return visitor; };
}

class Packets : public testing::Test {
 protected:
  Packets() {
    for (VertexId v = 0; v < index.vertex_count(); ++v) {
      // Stretches with all, some and hardly any of their vertices, in no order, and some of them twice.
      const std::size_t share = v / 500 % 4;
      if (share == 0 || random.below(4 * share * share) == 0) vertices.push_back(v);
      if (random.below(20) == 0) vertices.push_back(v);
    }
    for (std::size_t i = vertices.size(); i > 1; --i) std::swap(vertices[i - 1], vertices[random.below(i)]);
    for (std::size_t row = 0; row < vertices.size(); ++row) radii.push_back(random.uniform(0, 9));
    for (std::size_t i = 0; i < index.vertex_count(); ++i) signal.push_back(random.uniform(-1, 1));
  }

  /// The sum of the signal for each row.
  [[nodiscard]] std::vector<double> sums(const BatchQuery& query, unsigned threads) const {
    std::vector<double> result(query.vertices.count(index.vertex_count()));
    for_each_packet(index, query, everyone([&](const PacketAnswer& answer) {
                      const std::vector<double> found = sums_of(answer, index, signal);
                      for (std::size_t i = 0; i < found.size(); ++i) result[answer.rows[i]] = found[i];
                    }),
                    {.threads = threads});
    return result;
  }

  Random random{7};
  TestMesh mesh = make_grid(60, 70, false).finish(true);
  Index index = build(mesh.view());
  std::vector<VertexId> vertices;
  std::vector<double> radii;
  std::vector<double> signal;
};

TEST_F(Packets, HaveEachRowOnceWithItsVertexAndRadius) {
  std::vector<int> seen(vertices.size());
  std::map<std::size_t, std::size_t> sizes;
  visit(index, {.vertices = vertices, .radius = radii}, [&](const PacketAnswer& answer) {
    ASSERT_EQ(answer.queries, ~QueryWord{0} >> (kPacketCapacity - answer.rows.size()));
    ++sizes[answer.rows.size()];
    for (std::size_t i = 0; i < answer.rows.size(); ++i) {
      ++seen[answer.rows[i]];
      EXPECT_EQ(answer.vertices[i], vertices[answer.rows[i]]);
      EXPECT_EQ(answer.radii[i], radii[answer.rows[i]]);
    }
  });
  EXPECT_THAT(seen, testing::Each(1));
  EXPECT_GT(sizes[1], 0U) << "no row was answered by itself";
  EXPECT_GT(sizes.rbegin()->first, 20U);
}

TEST_F(Packets, AreWrittenRowByRow) {
  const IndexView& view = IndexAccess::view(index);
  std::vector<PerLane<QueryWord>> words(view.leaf_count());
  std::vector<Piece> pieces;
  for (LeafId leaf = 0; leaf + 1 < view.leaf_count(); leaf += 1 + static_cast<LeafId>(random.below(3))) {
    for (std::size_t lane = 0; lane < view.leaves[leaf].size; ++lane) {
      words[leaf][lane] = static_cast<QueryWord>(random.bits());
    }
    const bool is_run = random.below(2) == 0;
    pieces.push_back({{leaf, leaf + 1}, is_run ? 0xAAAA'5555 : 0, is_run ? nullptr : words[leaf].data()});
  }
  std::vector<std::vector<VertexId>> expected(kPacketCapacity);
  PacketAnswer packet{};
  packet.pieces = pieces;
  for_each_vertex(packet, index, [&](std::size_t place, QueryWord queries) {
    for_each_query(queries, [&](std::size_t row) { expected[row].push_back(index.permutation()[place]); });
  });
  for (const Isa isa : available_isas()) {
    const RowWriter writer(view, isa);
    for (unsigned row = 0; row < kPacketCapacity; ++row) {
      std::vector<VertexId> ids(expected[row].size());
      writer.write_ids(pieces, row, ids);
      ASSERT_EQ(ids, expected[row]);
      std::vector<double> distances(mesh.size(), -1);
      writer.write_distances(pieces, row, 0, std::span(distances).first(ids.size()));
      for (std::size_t i = 0; i < ids.size(); ++i) {
        ASSERT_EQ(distances[i], distance(mesh.positions_view(), view.id(0), ids[i]));
      }
      ASSERT_EQ(std::ranges::count(distances, -1), static_cast<std::ptrdiff_t>(mesh.size() - ids.size()));
    }
  }
}

TEST_F(Packets, SumASignalAsTheReferenceDoes) {
  std::vector<double> by_id(signal.size());
  for (std::size_t i = 0; i < signal.size(); ++i) {
    signal[i] = std::round(1000 * signal[i]);
    by_id[index.permutation()[i]] = signal[i];
  }
  const std::vector<double> found = sums({.vertices = vertices, .radius = radii}, 1);
  ReferenceSearcher reference(mesh.view());
  std::vector<VertexId> ids;
  for (std::size_t row = 0; row < vertices.size(); ++row) {
    reference.neighborhood(vertices[row], radii[row], ids);
    const double expected =
        std::accumulate(ids.begin(), ids.end(), 0.0, [&](double sum, VertexId id) { return sum + by_id[id]; });
    ASSERT_EQ(found[row], expected) << "row " << row;
  }
}

/// Requires that the pieces ascend, without runs that could be one; adds up how many have several leaves, and how many
/// have words.
void check_pieces(const PacketAnswer& answer, const Index& index, std::size_t& long_runs, std::size_t& with_words) {
  const Piece* last = nullptr;
  for (const Piece& piece : answer.pieces) {
    ASSERT_LT(piece.leaves.begin, piece.leaves.end);
    ASSERT_LT(piece.leaves.end, index.leaf_starts().size());
    EXPECT_EQ(piece.queries == 0, !piece.is_run());
    if (last != nullptr) {
      EXPECT_LE(last->leaves.end, piece.leaves.begin);
      const bool can_be_one =
          last->leaves.end == piece.leaves.begin && last->is_run() && last->queries == piece.queries;
      EXPECT_FALSE(can_be_one);
    }
    long_runs += piece.leaves.end - piece.leaves.begin > 1;
    with_words += !piece.is_run();
    last = &piece;
  }
}

TEST_F(Packets, HavePiecesInIndexOrder) {
  std::size_t long_runs = 0;
  std::size_t with_words = 0;
  visit(index, {.vertices = vertices, .radius = 20},
        [&](const PacketAnswer& answer) { check_pieces(answer, index, long_runs, with_words); });
  EXPECT_GT(long_runs, 0U);
  EXPECT_GT(with_words, 0U);
}

// Odd graphs are searched vertex by vertex: their answers do not come by leaves.
TEST(PacketsOfAStar, HavePiecesInIndexOrder) {
  for (const Family& family : families()) {
    if (family.name != "star" && family.name != "random faces") continue;
    const auto [mesh, index] = indexed(make_mesh(family, 2, 700));
    std::size_t long_runs = 0;
    std::size_t with_words = 0;
    visit(index, {.radius = 0.9},
          [&](const PacketAnswer& answer) { check_pieces(answer, index, long_runs, with_words); });
    EXPECT_GT(with_words, 0U) << family.name;
  }
}

TEST_F(Packets, GoToOneVisitorForEachThread) {
  std::mutex mutex;
  std::multiset<unsigned> made;
  std::atomic<std::size_t> rows{0};
  for_each_packet(index, {.radius = 3},
                  [&](unsigned thread) -> PacketVisitor {
                    const std::lock_guard lock(mutex);
                    made.insert(thread);
                    return [&](const PacketAnswer& answer) { rows += answer.rows.size(); };
                  },
                  {.threads = 3});
  EXPECT_EQ(rows, index.vertex_count());
  ASSERT_FALSE(made.empty());
  for (const unsigned thread : made) {
    EXPECT_LT(thread, 3U);
    EXPECT_EQ(made.count(thread), 1U);
  }
}

TEST_F(Packets, OfNoRowsMakeNoVisitor) {
  const std::vector<VertexId> none;
  for_each_packet(index, {.vertices = none, .radius = 3},
                  [](unsigned) -> PacketVisitor { throw std::logic_error(""); });
}

TEST_F(Packets, PassOnExceptionsOfAVisitor) {
  for (const unsigned threads : {1U, 3U}) {
    std::atomic<int> calls{0};
    const auto visitor = everyone([&](const PacketAnswer&) {
      if (++calls == 3) throw std::runtime_error("enough");
    });
    EXPECT_THROW(for_each_packet(index, {.radius = 3}, visitor, {.threads = threads}), std::runtime_error);
  }
}

TEST_F(Packets, ReportTheRowsAndCanBeCancelled) {
  const auto call = [&](const Progress& progress) {
    for_each_packet(index, {.radius = 3}, everyone([](const PacketAnswer&) {}), {.progress = progress});
  };
  const Reports reports = reports_of(call);
  expect_from_nothing_to_all(reports);
  EXPECT_EQ(reports.back().second, index.vertex_count());
  expect_refused(ErrorCode::Cancelled, "cancelled",
                 [&] { call([](std::size_t done, std::size_t total) { return done < total; }); });
}

TEST_F(Packets, AreRefusedBeforeTheFirstVisit) {
  const auto never = [](unsigned) -> PacketVisitor { throw std::logic_error("visited"); };
  const std::vector<VertexId> outside{0, static_cast<VertexId>(index.vertex_count())};
  const std::vector<double> two{1, 1};
  const std::vector<double> negative(index.vertex_count(), -1);
  const auto refused = [&](ErrorCode code, const char* cause, const BatchQuery& query) {
    expect_refused(code, cause, [&] { for_each_packet(index, query, never); });
  };
  refused(ErrorCode::VertexOutOfRange, "row 1", {.vertices = outside, .radius = two});
  refused(ErrorCode::InvalidRadius, "row 0", {.radius = negative});
  refused(ErrorCode::InvalidRadius, "2 radii", {.radius = two});
  refused(ErrorCode::InvalidRadius, "radius", {});
  expect_refused(ErrorCode::InvalidOption, "threads",
                 [&] { for_each_packet(index, {.radius = 1}, never, {.threads = 5000}); });
}

}  // namespace
}  // namespace meshhood::test
