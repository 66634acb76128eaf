// SPDX-License-Identifier: MIT
#include "meshhood/error.h"

#include <array>
#include <functional>
#include <limits>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/meshhood.h"

#include "support/refusal.h"

namespace meshhood::test {
namespace {

constexpr std::array kCodes{ErrorCode::VertexOutOfRange, ErrorCode::InvalidRadius, ErrorCode::InvalidOption,
                            ErrorCode::InvalidMesh,      ErrorCode::MalformedFile, ErrorCode::UnsupportedFormat,
                            ErrorCode::MalformedIndex,   ErrorCode::IoFailure,     ErrorCode::TooLarge,
                            ErrorCode::Cancelled};

TEST(Error, EachCodeHasItsOwnDescription) {
  std::set<std::string_view> words;
  for (const ErrorCode code : kCodes) words.insert(describe(code));
  EXPECT_EQ(words.size(), std::size(kCodes));
  EXPECT_FALSE(words.contains("unknown error"));
  EXPECT_EQ(describe(static_cast<ErrorCode>(1000)), "unknown error");
}

TEST(Error, HasACodeAndAMessage) {
  expect_refused(ErrorCode::TooLarge, "the cause", [] { raise(ErrorCode::TooLarge, "the cause"); });
  const Error error(ErrorCode::IoFailure, "why");
  const std::exception& base = error;
  EXPECT_STREQ(base.what(), "why");
}

/// Every call that takes a mesh refuses a bad one with the same message.
std::vector<std::function<void(const MeshView&)>> mesh_doors() {
  return {[](const MeshView& mesh) { validate(mesh); },
          [](const MeshView& mesh) { static_cast<void>(adjacency(mesh)); },
          [](const MeshView& mesh) { static_cast<void>(build(mesh)); },
          [](const MeshView& mesh) { static_cast<void>(paper::build(mesh)); },
          [](const MeshView& mesh) { const ReferenceSearcher searcher(mesh); },
          [](const MeshView& mesh) { static_cast<void>(exact_neighborhood(mesh, 0, 1)); },
          [](const MeshView& mesh) {
            const std::vector<float> one(3, 0.0F);
            static_cast<void>(build(MeshView{one, {}}).check(mesh));
          },
          [](const MeshView& mesh) {
            const std::vector<float> one(3, 0.0F);
            static_cast<void>(paper::build(MeshView{one, {}}).check(mesh));
          }};
}

TEST(Error, EveryFunctionRefusesANonFiniteVertex) {
  const std::vector<float> positions{0, 0, 0, 0, std::numeric_limits<float>::quiet_NaN(), 0};
  for (const auto& door : mesh_doors()) {
    expect_refused(ErrorCode::InvalidMesh, "vertex 1: y is nan", [&] { door({positions, {}}); });
  }
}

TEST(Error, EveryFunctionRefusesACornerOutOfRange) {
  const std::vector<float> positions(9, 0.0F);
  const std::vector<std::uint32_t> corners{0, 1, 2, 2, 1, 90210};
  for (const auto& door : mesh_doors()) {
    expect_refused(ErrorCode::InvalidMesh, "face 1: corner 2 is vertex 90210, but the mesh has 3 vertices",
                   [&] { door({positions, FacesView::triangles(corners)}); });
  }
}

TEST(Error, EveryFunctionRefusesAnInconsistentGraph) {
  const std::vector<float> positions(6, 0.0F);
  const Adjacency one_way{{0, 1, 1}, {1}};
  const GraphView graph{positions, one_way.view()};
  const auto refuse = [](auto&& door) {
    expect_refused(ErrorCode::InvalidMesh, "neighbors of vertex 0: 1, but", door);
  };
  refuse([&] { validate(graph); });
  refuse([&] { return build(graph); });
  refuse([&] { return paper::build(graph); });
  refuse([&] { const ReferenceSearcher searcher(graph); });
  refuse([&] { return build(MeshView{positions, {}}).check(graph); });
  refuse([&] { return paper::build(MeshView{positions, {}}).check(graph); });
}

}  // namespace
}  // namespace meshhood::test
