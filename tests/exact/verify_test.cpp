// SPDX-License-Identifier: MIT
// Forged index files with valid checksums are rejected: one forgery for each rule. Rows F4 to F6 and F12 of the
// catalogue in docs/reliability.md.
#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/error.h"

#include "exact/build/forest.h"
#include "exact/build/tree.h"
#include "exact/layout.h"
#include "support/families.h"
#include "support/forged_index.h"
#include "support/index_bytes.h"
#include "support/refusal.h"

namespace meshhood::test {
namespace {

using Change = std::function<void(Forgery&)>;

/// `bytes`: of a saved index.
void expect_refused_after(const char* cause, std::vector<std::byte> bytes, const Change& change) {
  expect_refused_after(cause, std::move(bytes), change, [](std::span<const std::byte> all) { return load(all); });
}

void expect_refused_after(const char* cause, const Change& change) {
  expect_refused_after(cause, saved(build(bumpy_grid(20).view())), change);
}

TEST(IndexVerify, RejectsOtherFormatsAndStatesTheirNumbers) {
  expect_refused_after("header, byte 12: format 4, but this version reads format 3: install a newer meshhood",
                       [](Forgery& f) { f.header().format = 4; });
  expect_refused_after("format 0, but this version reads format 3", [](Forgery& f) { f.header().format = 0; });
  expect_refused_after("format 1, but this version reads format 3: build the index again",
                       [](Forgery& f) { f.header().format = 1; });
}

TEST(IndexVerify, RejectsHeadersOfOtherMachinesAndKinds) {
  expect_refused_after("big-endian byte order", [](Forgery& f) { f.header().byte_order = file::kOtherByteOrder; });
  expect_refused_after("the byte order mark is not valid", [](Forgery& f) { f.header().byte_order = 0; });
  expect_refused_after("vertex ids of 64 bits, expected 32", [](Forgery& f) { f.header().id_bytes = 8; });
  expect_refused_after("coordinates of 2 bytes", [](Forgery& f) { f.header().scalar_bytes = 2; });
  expect_refused_after("index kind 3", [](Forgery& f) { f.header().kind = static_cast<IndexKind>(3); });
  expect_refused_after("a paper index, expected an exact index", [](Forgery& f) {
    f.header().kind = IndexKind::Paper;
    f.header().format = file::format_of(IndexKind::Paper);
  });
  expect_refused_after("header, byte 51: 1, expected 0", [](Forgery& f) { f.header().unused = 1; });
}

TEST(IndexVerify, RejectsAnotherMeshAndStatesBothFingerprints) {
  const TestMesh mesh = bumpy_grid(20);
  TestMesh other = mesh;
  other.single_positions[100] += 1;
  const IndexHeader header = read_header(saved(build(mesh.view())));
  check_mesh(header, fingerprint(mesh.view()));
  const Fingerprint given = fingerprint(other.view());
  expect_refused(ErrorCode::MalformedIndex,
                 "built from mesh " + to_text(header.mesh) + ", but the given mesh is " + to_text(given),
                 [&] { check_mesh(header, given); });
}

TEST(IndexVerify, RejectsAWrongSectionTable) {
  expect_refused_after("section links", [](Forgery& f) { f.entry("links").begin -= 64; });
  expect_refused_after("section links", [](Forgery& f) { f.entry("links").begin += 4; });
  expect_refused_after("section links", [](Forgery& f) { f.entry("links").begin = ~std::uint64_t{63}; });
  expect_refused_after("section links", [](Forgery& f) { f.entry("links").bytes = ~std::uint64_t{0}; });
  expect_refused_after("section crossings", [](Forgery& f) { f.entry("links").bytes += 64; });
  expect_refused_after("section link, expected section links", [](Forgery& f) { f.entry("links").name[4] = '\0'; });
  expect_refused_after("a section without a readable name", [](Forgery& f) { f.entry("links").name[0] = '\n'; });
  expect_refused_after("sections do not fit", [](Forgery& f) { f.header().sections = 1U << 30U; });
  expect_refused_after("begins at", [](Forgery& f) { f.header().sections -= 8; });
  expect_refused_after("padding byte 1, expected 0", [](Forgery& f) {
    const file::Section& frame = f.entry("frame");
    f.bytes()[frame.begin + frame.bytes] = std::byte{1};
  });
}

TEST(IndexVerify, RejectsWrongSizesOfArrays) {
  expect_refused_after("section positions", [](Forgery& f) { f.header().vertices += 1; });
  expect_refused_after("but the limit is", [](Forgery& f) { f.header().vertices = ~std::uint64_t{0}; });
  // The sizes agree with the table, but not with each other.
  expect_refused_after("section place", [](Forgery& f) { f.entry("place").bytes -= 4; });
  expect_refused_after("expected a multiple of 28", [](Forgery& f) { f.entry("leaves").bytes -= 1; });
  expect_refused_after("section permutation", [](Forgery& f) { f.entry("permutation").bytes -= 4; });
  // The last elements become padding, and so must be 0.
  expect_refused_after("section leaf_begin", [](Forgery& f) {
    f.section<Leaf>("leaves").back() = {};
    f.entry("leaves").bytes -= sizeof(Leaf);
  });
  expect_refused_after("section groups, byte", [](Forgery& f) {
    f.section<std::byte>("groups").back() = std::byte{0};
    f.entry("groups").bytes -= 1;
  });
  // An empty section begins where the next section does; the error must name the empty one.
  for (const char* name : {"leaves", "links", "crossings"}) {
    expect_refused_after(("section " + std::string(name) + ", byte").c_str(),
                         [name](Forgery& f) { f.remove_content(name); });
  }
  expect_refused_after("section mean_radii", [](Forgery& f) { f.entry("mean_radii").bytes += sizeof(double); });
}

void expect_faces_refused_after(const char* cause, const TestMesh& mesh, const Change& change) {
  expect_refused_after(cause, saved(build(mesh.view()), {.faces = mesh.view().faces}), change);
}

std::span<std::uint32_t> corners_of(Forgery& f) { return f.section<std::uint32_t>("face_corners"); }
std::span<std::uint32_t> offsets_of(Forgery& f) { return f.section<std::uint32_t>("face_offsets"); }

TEST(IndexVerify, RejectsWrongCornersOfFaces) {
  const TestMesh triangles = make_grid(6, 6, false).finish(true);
  const TestMesh quads = make_grid(6, 6, true).finish(true);
  for (const TestMesh* mesh : {&triangles, &quads}) {
    expect_faces_refused_after("vertex 36, but there are 36 vertices", *mesh,
                               [](Forgery& f) { corners_of(f)[5] = 36; });
    expect_faces_refused_after("section face_corners, byte", *mesh, [](Forgery& f) { corners_of(f).back() = ~0U; });
    expect_faces_refused_after("bytes, expected a multiple of 4", *mesh, [](Forgery& f) {
      corners_of(f).back() = 0;  // what becomes padding must be 0
      f.entry("face_corners").bytes -= 1;
    });
  }
  expect_faces_refused_after("149 corners, expected three for each triangle", triangles, [](Forgery& f) {
    corners_of(f).back() = 0;
    f.entry("face_corners").bytes -= sizeof(std::uint32_t);
  });
  expect_faces_refused_after("section face_corner, expected no more sections", triangles,
                             [](Forgery& f) { f.entry("face_corners").name[11] = '\0'; });
}

TEST(IndexVerify, RejectsWrongOffsetsOfFaces) {
  const TestMesh quads = make_grid(6, 6, true).finish(true);
  TestMesh mixed = quads;  // the number of corners is that of two triangles
  mixed.offsets = {0};
  mixed.corners.clear();
  mixed.add_face({0, 1});
  mixed.add_face({0, 1, 7, 6});
  expect_faces_refused_after("section face_offset, expected no more sections", mixed,
                             [](Forgery& f) { f.entry("face_offsets").name[11] = '\0'; });
  expect_faces_refused_after("0 values, expected one more than there are faces", quads,
                             [](Forgery& f) { f.remove_content("face_offsets"); });
  expect_faces_refused_after("does not begin at corner 0", quads, [](Forgery& f) { offsets_of(f)[0] = 1; });
  expect_faces_refused_after("face 3 ends at corner 11, before it begins at 12", quads,
                             [](Forgery& f) { offsets_of(f)[4] = 11; });
  expect_faces_refused_after("face 4 ends at corner 20, before it begins at 4000000000", quads,
                             [](Forgery& f) { offsets_of(f)[4] = 4000000000U; });
  expect_faces_refused_after("the faces have 101 corners, expected 100", quads,
                             [](Forgery& f) { ++offsets_of(f).back(); });
  expect_faces_refused_after("all faces are triangles, expected no offsets", mixed,
                             [](Forgery& f) { offsets_of(f)[1] = 3; });
}

TEST(IndexVerify, RejectsWrongLeaves) {
  expect_refused_after("leaf 0 does not begin", [](Forgery& f) { f.section<VertexId>("leaf_begin")[0] = 1; });
  expect_refused_after("expected 1 to 32", [](Forgery& f) { f.section<VertexId>("leaf_begin")[2] = 0; });
  expect_refused_after("expected 1 to 32", [](Forgery& f) { f.section<VertexId>("leaf_begin")[2] = 4000000000U; });
  expect_refused_after("leaf 3: ", [](Forgery& f) { f.section<Leaf>("leaves")[3].size = 33; });
  expect_refused_after("leaf 3: ", [](Forgery& f) { f.section<Leaf>("leaves")[3].size = 0; });
  expect_refused_after("leaf 3: ", [](Forgery& f) { ++f.section<Leaf>("leaves")[3].first; });
  expect_refused_after("neither 0 nor 1", [](Forgery& f) { f.section<Leaf>("leaves")[3].unused = 1; });
  expect_refused_after("neither 0 nor 1", [](Forgery& f) {
    *reinterpret_cast<std::uint8_t*>(&f.section<Leaf>("leaves")[3].connected) = 2;
  });
  expect_refused_after("its mark as connected", [](Forgery& f) {
    bool& connected = f.section<Leaf>("leaves")[3].connected;
    connected = !connected;
  });
  expect_refused_after("leaf 3: it has links, but is not connected", [](Forgery& f) {
    Leaf& leaf = f.section<Leaf>("leaves")[3];
    const auto rows = f.section<LaneMask>("adjacency").subspan(leaf.first, leaf.size);
    for (LaneMask& row : rows) row &= ~LaneMask{1};
    rows[0] = 0;
    leaf.connected = false;
  });
  expect_refused_after("does not mark the end of 400 vertices",
                       [](Forgery& f) { f.section<Leaf>("leaves").back().size = 1; });
}

TEST(IndexVerify, RejectsAWrongNumbering) {
  expect_refused_after("but there are 400", [](Forgery& f) { f.section<VertexId>("permutation")[5] = 400; });
  expect_refused_after("expected", [](Forgery& f) {
    const auto ids = f.section<VertexId>("permutation");
    ids[5] = ids[6];  // one id twice, another missing
  });
  expect_refused_after("has slot", [](Forgery& f) { f.section<std::uint32_t>("place")[7] = 4000000000U; });
  expect_refused_after("has slot", [](Forgery& f) {
    const auto places = f.section<std::uint32_t>("place");
    places[7] = places[8];
  });
  expect_refused_after("the padding is not 0", [](Forgery& f) { f.section<VertexId>("permutation").back() = 1; });
}

TEST(IndexVerify, RejectsWrongEdgesWithinLeaves) {
  expect_refused_after("is a neighbor of itself", [](Forgery& f) { f.section<LaneMask>("adjacency")[0] |= 1; });
  expect_refused_after("is a neighbor of itself", [](Forgery& f) {
    const Leaf& leaf = f.section<Leaf>("leaves")[1];
    if (leaf.size < kLeafCapacity) f.section<LaneMask>("adjacency")[leaf.first] |= LaneMask{1} << leaf.size;
    if (leaf.size == kLeafCapacity) f.section<LaneMask>("adjacency")[leaf.first] |= 1;
  });
  expect_refused_after("but none leads back", [](Forgery& f) { f.section<LaneMask>("adjacency")[0] = 0; });
  expect_refused_after("the padding is not 0", [](Forgery& f) { f.section<LaneMask>("adjacency").back() = 1; });
}

TEST(IndexVerify, RejectsWrongLinks) {
  expect_refused_after("do not begin at link 0", [](Forgery& f) { f.section<Leaf>("leaves")[0].first_link = 1; });
  expect_refused_after("leaf 0: links 0 to 4000000000",
                       [](Forgery& f) { f.section<Leaf>("leaves")[1].first_link = 4000000000U; });
  expect_refused_after("leaf 1: links ", [](Forgery& f) { f.section<Leaf>("leaves")[2].first_link = 0; });
  expect_refused_after("the links end at", [](Forgery& f) {
    // The record of the end, and those of the leaves after the last that exists.
    const auto leaves = f.section<Leaf>("leaves");
    const std::uint32_t end = leaves.back().first_link;
    for (Leaf& leaf : leaves) leaf.first_link = std::min(leaf.first_link, end - 1);
  });
  expect_refused_after("link from leaf 0 to leaf 4000000000",
                       [](Forgery& f) { f.section<Link>("links")[0].leaf = 4000000000U; });
  expect_refused_after("link from leaf 0 to leaf 0", [](Forgery& f) { f.section<Link>("links")[0].leaf = 0; });
  expect_refused_after("in ascending order", [](Forgery& f) {
    const auto links = f.section<Link>("links");
    std::swap(links[0].leaf, links[1].leaf);
  });
  expect_refused_after("the boundary does not match", [](Forgery& f) {
    LaneMask& boundary = f.section<Link>("links")[0].boundary;
    boundary &= boundary - 1;
  });
  expect_refused_after("the boundary does not match", [](Forgery& f) {
    LaneMask& boundary = f.section<Link>("links")[0].boundary;
    boundary |= boundary + 1;
  });
  expect_refused_after("cross edges ", [](Forgery& f) { f.section<Link>("links")[1].first_cross_edge = 4000000000U; });
  expect_refused_after("cross edges ", [](Forgery& f) {
    const auto links = f.section<Link>("links");
    links[1].first_cross_edge = links[0].first_cross_edge;
  });
  expect_refused_after("does not mark the end of", [](Forgery& f) { f.section<Link>("links").back().boundary = 1; });
  expect_refused_after("does not mark the end of",
                       [](Forgery& f) { ++f.section<Link>("links").back().first_cross_edge; });
}

TEST(IndexVerify, RejectsWrongCrossEdges) {
  expect_refused_after("but a leaf has no such lane",
                       [](Forgery& f) { f.section<CrossEdge>("crossings")[0].from = 32; });
  expect_refused_after("but a leaf has no such lane",
                       [](Forgery& f) { f.section<CrossEdge>("crossings")[0].to = 255; });
  expect_refused_after("the cross edges are not in ascending order", [](Forgery& f) {
    const auto cross_edges = f.section<CrossEdge>("crossings");
    cross_edges[1] = cross_edges[0];
  });
  expect_refused_after("no link back with the same edges", [](Forgery& f) {
    // The last cross edge of a link may have any larger lane and stay in order.
    const Link& next = f.section<Link>("links")[1];
    CrossEdge& last = f.section<CrossEdge>("crossings")[next.first_cross_edge - 1];
    last.to = last.to == 0 ? 1 : static_cast<std::uint8_t>(last.to - 1);
  });
  expect_refused_after("the padding is not 0", [](Forgery& f) { f.section<CrossEdge>("crossings").back().from = 1; });
}

TEST(IndexVerify, RejectsWrongPositions) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kFloatInfinity = std::numeric_limits<float>::infinity();
  expect_refused_after("not finite", [](Forgery& f) { f.section<float>("positions")[10] = kNan; });
  expect_refused_after("not finite", [](Forgery& f) { f.section<float>("positions")[10] = -kFloatInfinity; });
  expect_refused_after("lies outside the frame", [](Forgery& f) { f.section<float>("positions")[10] = 1000; });
  expect_refused_after("the padding is not 0", [](Forgery& f) { f.section<float>("positions").back() = kNan; });
  expect_refused_after("lies outside the frame", [](Forgery& f) { f.section<Frame>("frame")[0].scale *= 2; });
  expect_refused_after("lies outside the frame",
                       [](Forgery& f) { f.section<Frame>("frame")[0].origin.y = static_cast<double>(kNan); });
  for (const double scale : {0.0, -0.25, 0.3, kInfinity, static_cast<double>(kNan)}) {
    expect_refused_after("the scale of the frame is not a power of two",
                         [&](Forgery& f) { f.section<Frame>("frame")[0].scale = scale; });
  }
  expect_refused_after("lies outside the frame", [](Forgery& f) { f.section<Frame>("frame")[0].origin.x = kInfinity; });
}

/// Searches descend recursively: a chain of nodes would use up the stack.
TEST(IndexVerify, RejectsATreeOfTooManyLevels) {
  IndexData chain = arrays_of(build(bumpy_grid(3).view()));
  while (chain.levels.size() <= kMaxLevels + 1) {
    GroupRecord above = chain.records.back();
    above.first_child = static_cast<std::uint32_t>(chain.records.size() - 1);
    chain.parents.back() = static_cast<NodeId>(kFanOut * chain.records.size());
    chain.records.push_back(above);
    chain.parents.push_back(kNoNode);
    chain.groups.push_back(Group(chain.groups.back()));
    chain.mean_radii.push_back(double{chain.mean_radii.back()});
    chain.levels.push_back(static_cast<std::uint32_t>(chain.records.size()));
  }
  const std::vector<std::byte> bytes = saved(IndexAccess::make(std::move(chain)));
  expect_refused(ErrorCode::MalformedIndex, "67 levels, expected at most 66", [&] { return load(bytes); });
}

TEST(IndexVerify, RejectsAWrongForest) {
  const auto levels = [](Forgery& f) { return f.section<std::uint32_t>("levels"); };
  const auto records = [](Forgery& f) { return f.section<GroupRecord>("group_records"); };
  expect_refused_after("the first level does not begin at group 0", [&](Forgery& f) { levels(f)[0] = 1; });
  expect_refused_after("level 0 has no group", [&](Forgery& f) { levels(f)[1] = 0; });
  expect_refused_after("places for leaves", [](Forgery& f) { f.section<std::uint32_t>("levels")[1] = 1; });
  expect_refused_after("section groups", [&](Forgery& f) { ++levels(f).back(); });
  expect_refused_after("0 nodes, expected 1 to 8", [&](Forgery& f) { records(f)[1].nodes = 0; });
  expect_refused_after("9 nodes, expected 1 to 8", [&](Forgery& f) { records(f)[1].nodes = 9; });
  expect_refused_after("its first child is group 4000000000",
                       [&](Forgery& f) { records(f).back().first_child = 4000000000U; });
  expect_refused_after("its first child is group 1, expected 0", [&](Forgery& f) { records(f)[0].first_child = 1; });
  expect_refused_after("group 0: expected a group covered by node",
                       [](Forgery& f) { f.section<NodeId>("parents")[0] = 4000000000U; });
  expect_refused_after("no node covers it, but it has a parent",
                       [](Forgery& f) { f.section<NodeId>("parents").back() = 0; });
  // One node more than there are groups below, in the last group.
  expect_refused_after("expected a group covered by node", [&](Forgery& f) { records(f).back().nodes = 8; });
}

TEST(IndexVerify, RejectsWrongLinksBetweenNodes) {
  const auto records = [](Forgery& f) { return f.section<GroupRecord>("group_records"); };
  const char* const wrong = "its vertices or links are not those of its leaves";
  // Of leaves, and of the highest level.
  expect_refused_after(wrong, [&](Forgery& f) { records(f)[0].linked[0] ^= 2; });
  expect_refused_after(wrong, [&](Forgery& f) { records(f).back().linked[0] ^= 2; });
  expect_refused_after(wrong, [&](Forgery& f) { records(f)[0].first_link = 1; });
  expect_refused_after(wrong, [&](Forgery& f) { records(f)[0].end_link = 4000000000U; });
  expect_refused_after(wrong, [&](Forgery& f) { ++records(f)[0].begin[1]; });
  expect_refused_after(wrong, [&](Forgery& f) { records(f).back().begin[0] = 4000000000U; });
  expect_refused_after("unused bytes are not 0", [&](Forgery& f) { records(f)[0].unused[0] = 1; });
  expect_refused_after("unused bytes are not 0", [&](Forgery& f) { records(f)[0].pierced = 1; });
  expect_refused_after("link 0 between nodes: expected node", [](Forgery& f) {
    NodeLink& link = f.section<NodeLink>("node_links")[0];
    link = NodeLink(4000000000U, link.mine);
  });
  expect_refused_after("link 0 between nodes: expected node",
                       [](Forgery& f) { f.section<NodeLink>("node_links")[0].mine ^= 1; });
}

/// A surface of two levels, and two patches that fill a leaf each.
std::vector<std::byte> surface_and_patches() {
  TestMesh mesh = bumpy_grid(20);
  append(mesh, make_grid(5, 5, false));
  append(mesh, make_grid(5, 5, false));
  return saved(build(mesh.finish(true).view()));
}

/// Gives groups and links what follows from `levels`, `parents` and the numbers of nodes.
void relink(Forgery& f) {
  const auto sections = f.section<GroupRecord>("group_records");
  const auto levels = f.section<std::uint32_t>("levels");
  std::vector<GroupRecord> records(sections.begin(), sections.end());
  std::vector<std::uint32_t> first_link;
  for (const Leaf& leaf : f.section<Leaf>("leaves")) first_link.push_back(leaf.first_link);
  set_vertices(f.section<VertexId>("leaf_begin"), levels, records);
  TaskContext task;
  const std::vector<NodeLink> links =
      make_node_links(first_link, f.section<Link>("links"), levels, f.section<NodeId>("parents"), records, task);
  ASSERT_EQ(links.size(), f.section<NodeLink>("node_links").size());
  std::copy(records.begin(), records.end(), sections.begin());
  std::copy(links.begin(), links.end(), f.section<NodeLink>("node_links").begin());
}

TEST(IndexVerify, RejectsANodeThatIsNotConnected) {
  expect_refused_after("its nodes are not connected by links", surface_and_patches(), [](Forgery& f) {
    const auto levels = f.section<std::uint32_t>("levels");
    ASSERT_EQ(levels.size(), 4U);
    GroupRecord& top = f.section<GroupRecord>("group_records")[levels[1]];
    // The node after its last one would cover the group of the two patches.
    const std::uint32_t patches = top.first_child + top.nodes;
    ASSERT_EQ(f.section<GroupRecord>("group_records")[patches].nodes, 2U);
    f.section<NodeId>("parents")[patches] = static_cast<NodeId>(levels[1] * kFanOut + top.nodes++);
    relink(f);
  });
}

TEST(IndexVerify, RejectsALinkFromAGroupWithAParentToOneWithout) {
  expect_refused_after("a group linked with it has none", surface_and_patches(), [](Forgery& f) {
    const auto levels = f.section<std::uint32_t>("levels");
    GroupRecord& top = f.section<GroupRecord>("group_records")[levels[1]];
    ASSERT_GT(top.nodes, 1U);
    f.section<NodeId>("parents")[top.first_child + --top.nodes] = kNoNode;
    relink(f);
  });
}

TEST(IndexVerify, RejectsAWrongTree) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const char* const none = "the bounding sphere is not valid";
  for (const float value : {kNan, -1.0F, 0.0F, std::numeric_limits<float>::infinity()}) {
    expect_refused_after(none, [&](Forgery& f) { f.section<Group>("groups")[0].radius[1] = value; });
  }
  expect_refused_after(none, [](Forgery& f) { f.section<Group>("groups")[0].z[1] = kNan; });
  expect_refused_after("expected an absent node", [](Forgery& f) { f.section<Group>("groups").back().radius[7] = 1; });
  expect_refused_after("the mean radius is wrong", [](Forgery& f) { f.section<double>("mean_radii")[0] = 1; });
  expect_refused_after("the bounding sphere differs from that in the tree",
                       [](Forgery& f) { f.section<Leaf>("leaves")[2].bounds.x += 0.5F; });
  expect_refused_after(": the bounding sphere does not enclose", [](Forgery& f) {
    // The radius is unchanged, and so is the mean.
    f.section<Group>("groups").back().x[0] += 0.5F;
  });
}

TEST(IndexVerify, EveryByteOfAFileHasADefinedValue) {
  const TestMesh mesh = bumpy_grid(20);
  const std::vector<std::byte> expected = saved(build(mesh.view()));
#if defined(__GLIBC__) && defined(M_PERTURB)
  // Fresh memory is filled with one byte or another, so that bytes without a value differ.
  for (const int filling : {0x55, 0xAA}) {
    mallopt(M_PERTURB, filling);
    const std::vector<std::byte> bytes = saved(build(mesh.view(), {.threads = 2}));
    mallopt(M_PERTURB, 0);
    EXPECT_EQ(bytes, expected) << filling;
  }
#else
  EXPECT_EQ(saved(build(mesh.view())), expected);
#endif
}

}  // namespace
}  // namespace meshhood::test
