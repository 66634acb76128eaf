// SPDX-License-Identifier: MIT
// A damaged index file is rejected, wherever the damage is. A forged file with valid checksums is rejected, or its
// answers stay within its arrays. Rows F1 to F3 of the catalogue in docs/reliability.md.
#include <algorithm>
#include <cstdio>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/reorder.h"
#include "meshhood/search.h"

#include "support/families.h"
#include "support/forged_index.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

TestMesh bumpy_sheets(std::size_t side, bool single) {
  Random random(9);
  TestMesh mesh = make_grid(side, side, false);
  for (double& x : mesh.positions) x += random.uniform(-0.3, 0.3);
  TestMesh upper = mesh;
  for (std::size_t i = 2; i < upper.positions.size(); i += 3) upper.positions[i] += 1.5;
  append(mesh, upper);
  return mesh.finish(single);
}

std::string refusal_of_mapping(std::span<const std::byte> bytes) {
  return refusal_by([bytes] { return map(bytes, nullptr); });
}

std::string refusal_of_loading(std::span<const std::byte> bytes) {
  return refusal_by([bytes] { return load(bytes); });
}

/// Changes bytes one at a time, and counts the changes.
class Damage {
 public:
  explicit Damage(std::vector<std::byte> bytes) : original_(std::move(bytes)), copy_(original_) {}

  [[nodiscard]] std::size_t size() const { return original_.size(); }

  void expect_refused(std::size_t byte, unsigned mask) {
    copy_.data()[byte] ^= static_cast<std::byte>(mask);
    const std::string refusal = refusal_of_mapping(copy_.bytes());
    copy_.data()[byte] = original_[byte];
    ++tried_;
    if (refusal.starts_with(beginning_of_error(original_, byte))) return;
    ++missed_;
    if (missed_ < 10) ADD_FAILURE() << "byte " << byte << " changed by " << mask << ": " << refusal;
  }

  [[nodiscard]] std::size_t tried() const { return tried_; }
  [[nodiscard]] std::size_t missed() const { return missed_; }

 private:
  std::vector<std::byte> original_;
  Mappable copy_;
  std::size_t tried_ = 0;
  std::size_t missed_ = 0;
};

/// Flips every `step`-th bit, and replaces every byte in which a bit was flipped.
void expect_every_change_refused(const char* name, const Index& index, const SaveOptions& options = {}) {
  Damage damage(saved(index, options));
  const std::size_t bits = 8 * damage.size();
  const std::size_t step = std::max<std::size_t>(1, bits / scaled(bits));
  for (std::size_t bit = 0; bit < bits; bit += step) {
    damage.expect_refused(bit / 8, 1U << bit % 8);
    if (bit % 8 < step) damage.expect_refused(bit / 8, 0xFF);
  }
  std::printf("F1, %s: %zu bytes, %zu changes, %zu missed\n", name, damage.size(), damage.tried(), damage.missed());
  EXPECT_EQ(damage.missed(), 0U);
}

TEST(IndexDamage, EveryFlippedBitAndEveryReplacedByteIsRejected) {
  expect_every_change_refused("empty", build(MeshView{}));
  expect_every_change_refused("small", build(bumpy_sheets(5, true).view()));
  expect_every_change_refused("double", build(bumpy_sheets(12, false).view()));
  expect_every_change_refused("reordered", reorder(bumpy_sheets(12, true).view()).index);
  for (const bool quads : {false, true}) {
    const TestMesh mesh = make_grid(7, 7, quads).finish(true);
    expect_every_change_refused(quads ? "quads" : "triangles", build(mesh.view()), {.faces = mesh.view().faces});
  }
  expect_every_change_refused("large", build(bumpy_sheets(32, true).view()));
}

/// Queries a forged index that was accepted. Its answers may be wrong, but stay within its arrays.
void expect_harmless(const Index& index, Random& random) {
  Searcher searcher(index);
  std::vector<VertexId> ids;
  std::vector<double> distances;
  const std::size_t vertices = index.vertex_count();
  const auto is_vertex = [&](VertexId v) { return v < vertices; };
  for (std::size_t query = 0; query < 64 && vertices > 0; ++query) {
    const auto v = static_cast<VertexId>(random.below(vertices));
    const double radius = query == 0 ? std::numeric_limits<double>::infinity() : random.uniform(0, 8);
    searcher.neighborhood(v, radius, ids, distances);
    ASSERT_TRUE(ids.size() <= vertices && std::all_of(ids.begin(), ids.end(), is_vertex));
    for (const VertexRange& range : searcher.ranges(v, radius)) {
      ASSERT_TRUE(range.begin < range.end && range.end <= vertices);
    }
  }
  static_cast<void>(extract_graph(index));
  if (index.faces()) validate(MeshView{index.positions(), *index.faces()});
}

bool is_accepted_and_harmless(std::span<const std::byte> bytes, Random& random) {
  if (!refusal_of_mapping(bytes).empty()) return false;
  expect_harmless(map(bytes, nullptr), random);
  return true;
}

TEST(IndexDamage, AForgedBitIsRejectedOrHarmless) {
  std::size_t tried = 0;
  std::size_t accepted = 0;
  Random random(3);
  for (const bool single : {true, false}) {
    const TestMesh mesh = bumpy_sheets(9, single);
    const std::vector<std::byte> original = saved(build(mesh.view()), {.faces = mesh.view().faces});
    Mappable copy(original);
    const std::size_t step = std::max<std::size_t>(1, 8 * original.size() / scaled(8 * original.size()));
    for (std::size_t bit = 0; bit < 8 * original.size(); bit += step) {
      copy.data()[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
      seal(copy.bytes());
      accepted += is_accepted_and_harmless(copy.bytes(), random) ? 1 : 0;
      std::ranges::copy(original, copy.data());
      ++tried;
    }
  }
  std::printf("F2: %zu forgeries, %zu accepted and queried\n", tried, accepted);
  EXPECT_GT(accepted, 0U) << "nothing was queried";
  EXPECT_LT(accepted, tried / 2);
}

TEST(IndexDamage, ManyForgedBytesAreRejectedOrHarmless) {
  TestMesh mesh = bumpy_sheets(9, true);
  mesh.add_face({0, 1, 10, 9});
  const std::vector<std::byte> original = saved(build(mesh.view()), {.faces = mesh.view().faces});
  Mappable copy(original);
  Random random(4);
  std::size_t accepted = 0;
  const std::size_t tries = scaled(100000);
  for (std::size_t i = 0; i < tries; ++i) {
    // In the arrays, which have more fields than the header.
    for (std::size_t k = 0; k < 1 + i % 3; ++k) {
      const std::size_t head = file::head_bytes(header_of(original).sections);
      copy.data()[head + random.below(original.size() - head)] = static_cast<std::byte>(random.below(256));
    }
    seal(copy.bytes());
    accepted += is_accepted_and_harmless(copy.bytes(), random) ? 1 : 0;
    std::ranges::copy(original, copy.data());
  }
  std::printf("F2: %zu forgeries, %zu accepted and queried\n", tries, accepted);
  EXPECT_GT(accepted, 0U);
}

TEST(IndexDamage, EveryTruncationIsRejected) {
  std::size_t lengths = 0;
  for (const std::size_t side : {1U, 5U, 32U}) {
    const std::vector<std::byte> whole = saved(build(bumpy_sheets(side, true).view()));
    const std::size_t step = std::max<std::size_t>(1, whole.size() / scaled(whole.size()));
    for (std::size_t length = 0; length < whole.size(); length += step) {
      // An allocation of the exact size, so that a sanitizer finds a read past the end.
      const std::vector<std::byte> cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
      EXPECT_THAT(refusal_of_loading(cut), testing::StartsWith("header, byte ")) << length;
      ++lengths;
    }
  }
  std::printf("F3: %zu lengths refused\n", lengths);
}

TEST(IndexDamage, AForgedTruncationIsRejectedOrHarmless) {
  const TestMesh mesh = bumpy_sheets(9, true);
  const std::vector<std::byte> whole = saved(build(mesh.view()), {.faces = mesh.view().faces});
  for (std::size_t length = sizeof(file::Header); length < whole.size(); ++length) {
    Forgery cut(std::vector<std::byte>(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)));
    cut.header().bytes = length;
    seal(cut.bytes());
    EXPECT_FALSE(refusal_of_loading(cut.bytes()).empty()) << length;
  }
}

TEST(IndexDamage, AppendedBytesAreRejected) {
  const std::vector<std::byte> whole = saved(build(bumpy_sheets(5, true).view()));
  for (const std::size_t more : {1U, 64U, 4096U, 1U << 20U}) {
    Forgery longer(whole);
    longer.bytes().resize(whole.size() + more);
    EXPECT_THAT(refusal_of_loading(longer.bytes()), testing::StartsWith("header, byte ")) << more;
    longer.header().bytes = longer.bytes().size();
    seal(longer.bytes());
    EXPECT_THAT(refusal_of_loading(longer.bytes()), testing::StartsWith("header, byte ")) << more << ", forged";
  }
}

}  // namespace
}  // namespace meshhood::test
