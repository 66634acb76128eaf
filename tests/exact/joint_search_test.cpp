// SPDX-License-Identifier: MIT
// The joint search gives the neighborhoods of the reference, for any selection of queries.
#include "exact/joint/joint_search.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "exact/joint/packet_answer.h"
#include "exact/joint/row_writer.h"
#include "support/exact_answer.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

/// A query of the test: a vertex of the index by its leaf and lane, and a radius.
struct TestQuery {
  LeafId leaf;
  unsigned lane;
  double radius;
};

/// An index, the reference, and a joint search for every instruction set.
class JointAnswer {
 public:
  explicit JointAnswer(const MeshView& mesh)
      : mesh_(mesh), reference_(mesh), index_(build(mesh)), view_(IndexAccess::view(index_)) {
    for (const Isa isa : available_isas()) {
      searches_.emplace_back(view_, isa);
      writers_.emplace_back(view_, isa);
    }
  }

  [[nodiscard]] const IndexView& view() const { return view_; }
  [[nodiscard]] std::size_t rows() const { return rows_; }
  [[nodiscard]] std::size_t mismatches() const { return mismatches_; }

  /// Answers `queries`, sorted by leaf, group by group and leaf by leaf, with the searches in turn.
  void query(std::span<const TestQuery> queries) {
    while (!queries.empty()) {
      const LeafId group = queries.front().leaf / kFanOut;
      const auto end = std::find_if(queries.begin(), queries.end(),
                                    [&](const TestQuery& item) { return item.leaf / kFanOut != group; });
      const auto count = static_cast<std::size_t>(end - queries.begin());
      query_group(queries.first(count));
      queries = queries.subspan(count);
    }
  }

 private:
  void query_group(std::span<const TestQuery> queries) {
    JointSearch& search = searches_[groups_++ % searches_.size()];
    writer_ = &writers_[static_cast<std::size_t>(&search - searches_.data())];
    double low = kInfinity;
    double high = 0;
    std::vector<LeafId> leaves;
    for (const TestQuery& item : queries) {
      low = std::min(low, item.radius);
      high = std::max(high, item.radius);
      if (leaves.empty() || leaves.back() != item.leaf) leaves.push_back(item.leaf);
    }
    search.begin_group(leaves, TreeBounds(view_.frame, low), TreeBounds(view_.frame, high));
    while (!queries.empty()) {
      std::size_t count = 0;
      while (count < std::min<std::size_t>(queries.size(), kPacketCapacity) &&
             queries[count].leaf == queries.front().leaf) {
        ++count;
      }
      query_packet(search, queries.first(count));
      queries = queries.subspan(count);
    }
  }

  void query_packet(JointSearch& search, std::span<const TestQuery> queries) {
    std::vector<JointQuery> packet;
    for (const TestQuery& item : queries) packet.push_back({item.lane, JointRadius(view_.frame, item.radius)});
    search.run(queries.front().leaf, packet);
    const PerLane<std::uint64_t> counts = search.counts();
    writer_->begin(search.pieces());
    for (unsigned i = 0; i < queries.size(); ++i) {
      const VertexId v = view_.id(view_.leaf_begin[queries[i].leaf] + queries[i].lane);
      reference_.neighborhood(v, queries[i].radius, expected_);
      const bool right = counts[i] == expected_.size() && right_ids(i, counts[i]) && right_distances(i, v);
      EXPECT_TRUE(right) << "vertex " << v << ", radius " << queries[i].radius << ": " << counts[i]
                         << " vertices instead of " << expected_.size();
      mismatches_ += static_cast<std::size_t>(!right);
      ++rows_;
    }
  }

  bool right_ids(unsigned query, std::size_t count) {
    ids_.assign(count, 0);
    writer_->write_ids(query, ids_);
    for (std::size_t i = 1; i < count; ++i) {
      if (view_.slot[ids_[i - 1]] >= view_.slot[ids_[i]]) return false;  // in index order
    }
    std::vector<VertexId> sorted = ids_;
    std::sort(sorted.begin(), sorted.end());
    std::sort(expected_.begin(), expected_.end());
    return sorted == expected_;
  }

  bool right_distances(unsigned query, VertexId v) {
    std::vector<double> distances(ids_.size());
    writer_->write_distances(query, view_.position(leaf_of(view_.slot[v]), lane_of(view_.slot[v])), distances);
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      if (distances[i] != distance(mesh_.positions, v, ids_[i])) return false;
    }
    return true;
  }

  MeshView mesh_;
  ReferenceSearcher reference_;
  Index index_;
  const IndexView& view_;
  std::vector<JointSearch> searches_;  // by instruction set
  std::vector<RowWriter> writers_;
  RowWriter* writer_ = nullptr;
  std::size_t groups_ = 0;
  std::vector<VertexId> expected_;
  std::vector<VertexId> ids_;
  std::size_t rows_ = 0;
  std::size_t mismatches_ = 0;
};

/// Every vertex of the index with the radius that `radius(vertex)` gives; a part of them where `part` is less than 1.
template <class F>
std::vector<TestQuery> all_vertices(const IndexView& index, Random& random, double part, F&& radius) {
  std::vector<TestQuery> result;
  for (LeafId leaf = 0; leaf < index.leaf_count(); ++leaf) {
    for (unsigned lane = 0; lane < index.leaves[leaf].size; ++lane) {
      if (random.uniform(0, 1) < part) result.push_back({leaf, lane, radius(index.id(index.leaf_begin[leaf] + lane))});
    }
  }
  return result;
}

/// Zero, everything, the smallest number, six distances between vertices with their neighboring numbers, and others.
std::vector<double> radii_of(const TestMesh& mesh, Random& random) {
  std::vector<double> radii{0, std::numeric_limits<double>::denorm_min(), kInfinity};
  for (int i = 0; i < 3; ++i) {
    const auto v = static_cast<VertexId>(random.below(mesh.size()));
    const double tie = distance(mesh.positions_view(), v, static_cast<VertexId>(random.below(mesh.size())));
    for (const double radius : around(tie)) radii.push_back(radius);
    radii.push_back(tie * random.uniform(0, 2));
  }
  return radii;
}

class JointFamilies : public testing::TestWithParam<Family> {};

TEST_P(JointFamilies, AnswersAreThoseOfTheReference) {
  std::size_t rows = 0;
  for (const std::size_t vertices : {1U, 2U, 3U, 7U, 33U, 100U, 300U, 1000U}) {
    for (std::uint64_t seed = 0; seed < scaled(2, 1); ++seed) {
      const TestMesh mesh = make_mesh(GetParam(), seed, vertices);
      if (mesh.size() == 0) continue;
      SCOPED_TRACE(mesh.name);
      JointAnswer joint(mesh.view());
      Random random(seed);
      const std::vector<double> radii = radii_of(mesh, random);
      // Large meshes: the vertices of a few leaves at each radius.
      const double part = std::min(1.0, static_cast<double>(scaled(150, 30)) / static_cast<double>(mesh.size()));
      for (const double radius : radii) {
        joint.query(all_vertices(joint.view(), random, part, [&](VertexId) { return radius; }));
      }
      joint.query(
          all_vertices(joint.view(), random, part, [&](VertexId) { return radii[random.below(radii.size())]; }));
      ASSERT_EQ(joint.mismatches(), 0U);
      rows += joint.rows();
    }
  }
  std::printf("%s: %zu rows, 0 mismatches\n", std::string(GetParam().name).c_str(), rows);
}

INSTANTIATE_TEST_SUITE_P(All, JointFamilies, testing::ValuesIn(families()), family_name);

}  // namespace
}  // namespace meshhood::test
