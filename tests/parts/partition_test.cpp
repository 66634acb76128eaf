// SPDX-License-Identifier: MIT
// Every part answers for the vertices that it owns as the whole mesh does, for every radius up to the halo.
#include "parts/partition.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <set>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/adjacency.h"

#include "support/families.h"
#include "support/family_name.h"
#include "support/oracle.h"
#include "support/parts_folder.h"
#include "support/refusal.h"
#include "support/scale.h"
#include "support/scratch.h"

namespace meshhood::test {
namespace {

using parts::Manifest;
using parts::PartitionOptions;

using Ids = std::vector<std::uint32_t>;
using Face = std::vector<std::uint32_t>;

Ids to_mesh(const std::vector<VertexId>& numbers, const OpenPart& part) {
  Ids ids;
  for (const VertexId number : numbers) ids.push_back(static_cast<std::uint32_t>(part.ids[number]));
  std::sort(ids.begin(), ids.end());
  return ids;
}

/// The faces of a part in the order of the part, by the ids of the mesh.
std::vector<Face> faces_of(const OpenPart& part) {
  std::vector<Face> faces;
  const bool triangles = part.offsets.empty();
  const std::size_t count = triangles ? part.corners.size() / 3 : part.offsets.size() - 1;
  for (std::size_t f = 0; f < count; ++f) {
    const auto begin = triangles ? 3 * f : static_cast<std::size_t>(part.offsets[f]);
    const auto end = triangles ? 3 * f + 3 : static_cast<std::size_t>(part.offsets[f + 1]);
    Face face;
    for (std::size_t i = begin; i < end; ++i) {
      face.push_back(static_cast<std::uint32_t>(part.ids[static_cast<std::size_t>(part.corners[i])]));
    }
    faces.push_back(std::move(face));
  }
  return faces;
}

std::vector<Face> faces_of(const TestMesh& mesh) {
  std::vector<Face> faces;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) faces.emplace_back(mesh.face(f).begin(), mesh.face(f).end());
  return faces;
}

/// The faces that have one of `vertices`, in the order of `faces`.
std::vector<Face> faces_around(const std::vector<Face>& faces, const std::set<std::uint32_t>& vertices) {
  std::vector<Face> result;
  std::copy_if(faces.begin(), faces.end(), std::back_inserter(result), [&](const Face& face) {
    return std::any_of(face.begin(), face.end(), [&](std::uint32_t v) { return vertices.contains(v); });
  });
  return result;
}

/// Checks all parts of a folder against the oracle, and returns the number of queries.
class Checker {
 public:
  Checker(const TestMesh& mesh, std::filesystem::path folder, const Manifest& manifest)
      : mesh_(mesh), oracle_(mesh), folder_(std::move(folder)), manifest_(manifest), owners_(mesh.size()) {}

  std::size_t check(Random& random, std::size_t vertices_per_part) {
    for (std::size_t number = 0; number < manifest_.parts.size(); ++number) {
      SCOPED_TRACE(parts::part_name(number));
      const OpenPart part(folder_ / parts::part_name(number));
      check_counts(part, manifest_.parts[number]);
      check_answers(part, random, vertices_per_part);
      check_faces(part);
    }
    EXPECT_THAT(owners_, testing::Each(1)) << "every vertex has one owner";
    return queries_;
  }

 private:
  void check_counts(const OpenPart& part, const parts::Part& listed) {
    EXPECT_EQ(part.ids.size(), listed.vertices);
    EXPECT_EQ(part.owned.size(), listed.owned);
    EXPECT_EQ(part.index.vertex_count(), listed.vertices);
    EXPECT_TRUE(std::is_sorted(part.ids.begin(), part.ids.end()));
    EXPECT_EQ(std::adjacent_find(part.ids.begin(), part.ids.end()), part.ids.end()) << "no vertex twice";
    EXPECT_TRUE(std::is_sorted(part.owned.begin(), part.owned.end()));
    for (const auto number : part.owned) ++owners_[static_cast<std::size_t>(id(part, number))];
  }

  static std::uint32_t id(const OpenPart& part, std::int32_t number) {
    return static_cast<std::uint32_t>(part.ids[static_cast<std::size_t>(number)]);
  }

  void check_answers(const OpenPart& part, Random& random, std::size_t vertices) {
    Searcher searcher(part.index);
    std::vector<VertexId> found;
    for (std::size_t i = 0; i < vertices && !part.owned.empty(); ++i) {
      const std::int32_t number = part.owned[random.below(part.owned.size())];
      const std::uint32_t v = id(part, number);
      for (const double radius : radii(v, random)) {
        searcher.neighborhood(static_cast<VertexId>(number), radius, found);
        ASSERT_EQ(to_mesh(found, part), oracle_.exact(v, radius)) << "vertex " << v << ", radius " << radius;
        ++queries_;
      }
    }
  }

  /// Zero, the halo, and the distances of some vertices up to the halo.
  std::vector<double> radii(std::uint32_t v, Random& random) const {
    const double halo = manifest_.plan.halo;
    std::vector<double> result{0, halo, std::nextafter(halo, 0)};
    for (int i = 0; i < 4; ++i) {
      const double distance = oracle_.distance(v, random.below(mesh_.size()));
      if (distance <= halo) result.push_back(distance);
    }
    return result;
  }

  /// Every face around every vertex within the halo of an owned one is there, in the order of the mesh, and every other
  /// face within the halo.
  void check_faces(const OpenPart& part) const {
    std::set<std::uint32_t> near;
    for (const auto number : part.owned) {
      const Ids ball = oracle_.ball(id(part, number), manifest_.plan.halo);
      near.insert(ball.begin(), ball.end());
    }
    const std::vector<Face> faces = faces_of(part);
    EXPECT_EQ(faces_around(faces, near), faces_around(faces_of(mesh_), near));
    const std::set<Face> has(faces.begin(), faces.end());
    for (const Face& face : faces_of(mesh_)) EXPECT_TRUE(has.contains(face) || !has_near_edge(face, part));
  }

  [[nodiscard]] Point position(std::uint32_t v) const { return point(mesh_.positions_view(), v); }

  /// Whether the middle of an edge is within the halo of a vertex that the part owns: all corners may be farther away.
  bool has_near_edge(const Face& face, const OpenPart& part) const {
    for (std::size_t i = 0; i < face.size(); ++i) {
      const Point a = position(face[i]);
      const Point b = position(face[(i + 1) % face.size()]);
      const Point middle{(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2};
      const auto is_near = [&](std::int32_t number) {
        const double squared = squared_distance(position(id(part, number)), middle);
        return squared <= squared_radius(manifest_.plan.halo);
      };
      if (std::any_of(part.owned.begin(), part.owned.end(), is_near)) return true;
    }
    return false;
  }

  const TestMesh& mesh_;
  Oracle oracle_;
  std::filesystem::path folder_;
  const Manifest& manifest_;
  std::vector<int> owners_;  // how many parts own each vertex
  std::size_t queries_ = 0;
};

Manifest make_parts(const TestMesh& mesh, const std::filesystem::path& folder, const PartitionOptions& options,
                    const Run& run = {}) {
  return partition(*chunked(mesh), folder, options, run).manifest;
}

std::size_t check_parts(const TestMesh& mesh, const PartitionOptions& options, Random& random) {
  const Scratch scratch;
  const Manifest manifest = make_parts(mesh, scratch.path() / "parts", options);
  return Checker(mesh, scratch.path() / "parts", manifest).check(random, 4);
}

MESHHOOD_SUITE_OF_FAMILIES(Partition);

TEST_P(Partition, AnswersAreThoseOfTheWholeMesh) {
  std::size_t queries = 0;
  std::size_t folders = 0;
  for (std::uint64_t seed = 0; seed < scaled(2, 1); ++seed) {
    for (const std::size_t vertices : {7U, 300U}) {
      const TestMesh mesh = make_mesh(GetParam(), seed, vertices);
      SCOPED_TRACE(mesh.name);
      const Oracle oracle(mesh);
      Random random(seed);
      for (const std::uint64_t count : {2U, 7U}) {
        // A distance of the mesh, so that vertices lie at exactly the halo.
        const double halo = mesh.size() == 0 ? 1 : oracle.distance(0, random.below(mesh.size()));
        queries += check_parts(mesh, {.parts = count, .halo = halo}, random);
        ++folders;
      }
    }
  }
  std::printf("%s: %zu folders, %zu queries\n", std::string(GetParam().name).c_str(), folders, queries);
}

// Many vertices at one position, and several positions on every cut.
TEST(PartitionOfDuplicates, AreSeparatedByIdAndAnsweredExactly) {
  TestMesh mesh = make_grid(12, 12, true);
  append(mesh, TestMesh(mesh));  // every position twice
  for (int i = 0; i < 50; ++i) mesh.add_vertex(5, 5, 0);
  mesh.finish(true);
  Random random(1);
  for (const double halo : {0.0, 1.0, 3.0, std::numbers::sqrt2}) {
    EXPECT_GT(check_parts(mesh, {.parts = 7, .halo = halo}, random), 0U);
  }
}

TEST(PartitionOfDuplicates, AreBalancedAtOnePosition) {
  TestMesh mesh;
  for (int i = 0; i < 1000; ++i) mesh.add_vertex(1, 2, 3);
  mesh.finish(false);
  const Scratch scratch;
  const Manifest manifest = make_parts(mesh, scratch.path() / "parts", {.parts = 4, .halo = 0});
  for (const parts::Part& part : manifest.parts) {
    EXPECT_EQ(part.owned, 250U);
    EXPECT_EQ(part.vertices, 1000U) << "all lie within the halo";
  }
}

TEST(PartitionOfFewVertices, HasPartsThatOwnNothing) {
  TestMesh mesh;
  const auto a = mesh.add_vertex(0, 0, 0);
  const auto b = mesh.add_vertex(1, 0, 0);
  const auto c = mesh.add_vertex(0, 1, 0);
  mesh.add_face({a, b, c});
  mesh.finish(true);
  const Scratch scratch;
  const Manifest manifest = make_parts(mesh, scratch.path() / "parts", {.parts = 7, .halo = 0.5});
  const auto empty = std::count_if(manifest.parts.begin(), manifest.parts.end(),
                                   [](const parts::Part& part) { return part.owned == 0; });
  EXPECT_EQ(empty, 4);
  Random random(1);
  Checker(mesh, scratch.path() / "parts", manifest).check(random, 4);
}

TEST(PartitionOfLongFaces, HasAFaceThatABallReachesBetweenItsCorners) {
  TestMesh mesh;
  mesh.add_vertex(0, 0, 0);
  mesh.add_vertex(2, -1.5, 0);
  mesh.add_vertex(2, 1.5, 0);
  mesh.add_vertex(10, 0, 0);
  mesh.add_face({0, 1, 2});
  mesh.add_face({2, 1, 3});
  mesh.finish(false);
  for (const double halo : {2.2, 2.0, 1.9}) {  // up to the edge of both faces it is 2, to its ends 2.5
    const Scratch scratch;
    const Manifest manifest = make_parts(mesh, scratch.path() / "parts", {.parts = 4, .halo = halo});
    for (std::size_t number = 0; number < manifest.parts.size(); ++number) {
      const OpenPart part(scratch.path() / "parts" / parts::part_name(number));
      ASSERT_EQ(part.owned.size(), 1U);
      const bool is_first = part.ids[static_cast<std::size_t>(part.owned[0])] == 0;
      if (is_first) {
        EXPECT_EQ(faces_of(part).size(), halo < 2 ? 1U : 2U) << halo;
      }
    }
  }
}

TEST(PartitionOfNothing, HasEmptyParts) {
  TestMesh mesh;
  mesh.finish(true);
  const Scratch scratch;
  EXPECT_EQ(make_parts(mesh, scratch.path() / "parts", {.parts = 3, .halo = 1}).parts.size(), 3U);
}

TEST(PartitionPlan, HasTheMeanEdgeLengthToTheLastBit) {
  for (const Family& family : families()) {
    const TestMesh mesh = make_mesh(family, 3, 300);
    SCOPED_TRACE(mesh.name);
    const Scratch scratch;
    const Manifest manifest = make_parts(mesh, scratch.path() / "parts", {.parts = 1, .halo = 0});
    const Adjacency graph = adjacency(mesh.view());
    EXPECT_EQ(manifest.plan.mean_edge_length, mean_edge_length({mesh.positions_view(), graph.view()}));
  }
}

TEST(PartitionPlan, TakesTheHaloInEdges) {
  const TestMesh mesh = bumpy_grid(20);
  const Scratch scratch;
  const Manifest manifest =
      make_parts(mesh, scratch.path() / "parts", {.parts = 3, .halo = 2.5, .halo_in_edges = true});
  EXPECT_EQ(manifest.plan.halo, 2.5 * manifest.plan.mean_edge_length);
}

// The chunks are so small that edges and faces lead from one to another.
TEST(PartitionBytes, DependOnNeitherMemoryNorThreadsNorNumberOfRuns) {
  const TestMesh mesh = bumpy_grid(400);
  const Scratch scratch;
  const auto a = scratch.path() / "a";
  const auto b = scratch.path() / "b";
  const PartitionOptions options{.parts = 8, .halo = 3, .memory = parts::kLeastMemory};
  make_parts(mesh, a, options);
  make_parts(mesh, b, {.parts = 8, .halo = 3, .memory = std::uint64_t{1} << 32}, {.threads = 1});
  for (const auto& entry : std::filesystem::recursive_directory_iterator(a)) {
    if (!entry.is_regular_file()) continue;
    const auto name = std::filesystem::relative(entry.path(), a);
    EXPECT_TRUE(read_file(entry.path()) == read_file(b / name)) << name;
  }
}

TEST(PartitionBalance, IsWithinTenPercent) {
  const TestMesh mesh = bumpy_grid(600);  // more vertices than the sample
  const Scratch scratch;
  const Manifest manifest = make_parts(mesh, scratch.path() / "parts", {.parts = 32, .halo = 0});
  const double share = static_cast<double>(mesh.size()) / 32;
  for (const parts::Part& part : manifest.parts) EXPECT_NEAR(static_cast<double>(part.owned), share, share / 10);
}

TEST(PartitionWarnings, NameAHaloThatMakesEveryPartTheMesh) {
  const TestMesh mesh = bumpy_grid(10);
  const Scratch scratch;
  const auto result = partition(*chunked(mesh), scratch.path() / "parts", {.parts = 2, .halo = 100});
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_EQ(result.warnings[0],
            "with the halo 100, 2 of 2 parts are as large as the mesh; a smaller halo makes smaller parts");
}

TEST(PartitionWarnings, HaveThoseOfTheReaderOnce) {
  const Scratch scratch;
  const auto file = scratch.write(
      "far.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n5e6 0 0 9\n5e6 1 0\n5e6 0 1 9\n3 0 1 2\n");
  const auto result = partition(*parts::open_mesh(file, 1 << 20), scratch.path() / "parts", {.parts = 1, .halo = 0});
  EXPECT_THAT(result.warnings,
              testing::ElementsAre(
                  file.string() + ": line 10: lines with more numbers than the header declares (2 times)",
                  testing::StartsWith(file.string() + ": the mean edge is 1.14, but floats are 0.5 apart at 5e+06; ")));
}

TEST(PartitionOptionsCheck, RefusesOptionsOutOfRange) {
  const TestMesh mesh = bumpy_grid(10);
  const Scratch scratch;
  const auto refused = [&](ErrorCode code, const std::string& cause, const PartitionOptions& options) {
    expect_refused(code, cause, [&] { make_parts(mesh, scratch.path() / "parts", options); });
  };
  refused(ErrorCode::InvalidOption, "expected either the number of parts or the vertices per part", {.halo = 1});
  refused(ErrorCode::InvalidOption, "expected either the number of parts or the vertices per part",
          {.parts = 1, .vertices_per_part = 5, .halo = 1});
  refused(ErrorCode::InvalidRadius, "halo -1", {.parts = 1, .halo = -1});
  refused(ErrorCode::InvalidRadius, "halo nan", {.parts = 1, .halo = NAN});
  refused(ErrorCode::InvalidRadius, "halo inf", {.parts = 1, .halo = kInfinity});
  refused(ErrorCode::InvalidOption, "a memory of 5 bytes", {.parts = 1, .halo = 1, .memory = 5});
  refused(ErrorCode::TooLarge, "10000000 parts need more memory", {.parts = 10'000'000, .halo = 1});
}

TEST(PartitionMemory, RefusesAPartThatDoesNotFit) {
  const TestMesh mesh = bumpy_grid(700);
  const Scratch scratch;
  expect_refused(ErrorCode::TooLarge, "use more parts, a smaller halo or more memory", [&] {
    make_parts(mesh, scratch.path() / "parts", {.parts = 1, .halo = 1, .memory = parts::kLeastMemory});
  });
  EXPECT_EQ(contents(scratch.path() / "parts"), (std::map<std::string, std::string>{{".partition", ""}}));
}

}  // namespace
}  // namespace meshhood::test
