// SPDX-License-Identifier: MIT
// The sections of the exact index: its arrays as they lie in memory, which is what can be mapped.
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "meshhood/error.h"
#include "meshhood/serialize.h"

#include "base/parallel.h"
#include "exact/extract_graph.h"
#include "exact/index_access.h"
#include "exact/layout.h"
#include "exact/verify.h"
#include "format/aligned_copy.h"
#include "format/section_reader.h"
#include "format/section_writer.h"

namespace meshhood {
namespace {

// Without a byte between or behind the fields: all of them have a value.
static_assert(sizeof(Frame) == 32 && sizeof(Leaf) == 28 && sizeof(Link) == 12 && sizeof(CrossEdge) == 2 &&
              sizeof(Group) == 256);

PositionsInOrder take_positions(file::SectionReader& file) {
  const std::uint64_t scalars = 3 * (file.header().vertices + kLeafCapacity);
  if (file.header().scalar_bytes == sizeof(float)) return file.take<float>("positions", scalars);
  return file.take<double>("positions", scalars);
}

/// One of the vertices and the padding, or none where the caller's order is that of the index.
std::span<const VertexId> take_permutation(file::SectionReader& file) {
  const auto ids = file.take<VertexId>("permutation");
  const std::uint64_t expected = file.header().vertices + kLeafCapacity;
  if (!ids.empty() && ids.size() != expected) {
    file.refuse_last(std::to_string(ids.size()) + " vertices, expected none or " + std::to_string(expected));
  }
  return ids;
}

/// The arrays in place, as many of each as belong together; what stands in them is not looked at.
std::unique_ptr<IndexView> take_arrays(file::SectionReader& file) {
  const std::uint64_t vertices = file.header().vertices;
  auto view = std::make_unique<IndexView>();
  view->frame = file.take<Frame>("frame", 1).front();
  view->positions = take_positions(file);
  view->permutation = take_permutation(file);
  view->slot = file.take<std::uint32_t>("place", vertices);
  view->leaves = file.take<Leaf>("leaves");
  // No leaf is empty, so there are no more of them than vertices, and none without vertices.
  const std::size_t leaves = view->leaves.empty() ? 0 : view->leaves.size() - 1;
  if (view->leaves.empty() || leaves > vertices || (leaves == 0) != (vertices == 0)) {
    file.refuse_last(std::to_string(view->leaves.size()) + " records of leaves for " + std::to_string(vertices) +
                     " vertices");
  }
  view->leaf_begin = file.take<VertexId>("leaf_begin", leaves + 1);
  view->links = file.take<Link>("links");
  if (view->links.empty()) file.refuse_last("no link, expected one at the end at least");
  view->cross_edges = file.take<CrossEdge>("crossings");
  if (view->cross_edges.size() < kLeafCapacity) {
    file.refuse_last(std::to_string(view->cross_edges.size()) + " crossings, expected " +
                     std::to_string(kLeafCapacity) + " at the end at least");
  }
  view->adjacency = file.take<LaneMask>("adjacency", vertices + kLeafCapacity);
  view->groups = file.take<Group>("groups", tree_groups(leaves));
  view->mean_radii = file.take<double>("mean_radii", tree_nodes(leaves).size());
  view->tree = make_levels(leaves, view->groups, view->mean_radii);
  return view;
}

void verify_alignment(std::span<const std::byte> bytes) {
  const auto address = reinterpret_cast<std::uintptr_t>(bytes.data());
  if (address % kIndexAlignment == 0) return;
  raise(ErrorCode::InvalidOption, "bytes to be mapped begin " + std::to_string(address % kIndexAlignment) +
                                      " after a multiple of " + std::to_string(kIndexAlignment));
}

/// As `fingerprint(index)`, which would not be watched.
Fingerprint fingerprint_of(const Index& index, TaskContext& task) {
  const GraphData mesh = extract_graph(index, task);
  return fingerprint(mesh.view());
}

}  // namespace

void save(const Index& index, const Sink& sink, const SaveOptions& options) {
  const IndexView& view = IndexAccess::view(index);
  file::SectionWriter writer;
  writer.add("frame", std::span(&view.frame, 1));
  std::visit([&](auto xyz) { writer.add("positions", xyz); }, view.positions);
  writer.add("permutation", view.permutation);
  writer.add("place", view.slot);
  writer.add("leaves", view.leaves);
  writer.add("leaf_begin", view.leaf_begin);
  writer.add("links", view.links);
  writer.add("crossings", view.cross_edges);
  writer.add("adjacency", view.adjacency);
  writer.add("groups", view.groups);
  writer.add("mean_radii", view.mean_radii);
  const bool is_double = std::holds_alternative<std::span<const double>>(view.positions);
  const std::size_t scalar_bytes = is_double ? sizeof(double) : sizeof(float);
  TaskContext task(1, options.progress, writer.parts());
  const Fingerprint mesh = fingerprint_of(index, task);
  task.report_progress();
  writer.write({.vertices = view.vertex_count(),
                .mesh = mesh,
                .kind = IndexKind::Exact,
                .scalar_bytes = static_cast<std::uint8_t>(scalar_bytes)},
               sink, task);
}

Index load(std::span<const std::byte> bytes, const LoadOptions& options) {
  // Before anything is allocated for it.
  static_cast<void>(read_header(bytes));
  file::AlignedCopy copy(bytes);
  const auto at = copy.bytes();
  return map(at, copy.take_owner(), {.progress = options.progress});
}

Index map(std::span<const std::byte> bytes, std::shared_ptr<const void> owner, const MapOptions& options) {
  verify_alignment(bytes);
  file::SectionReader file(bytes);
  file::expect_kind(file.header().kind, IndexKind::Exact);
  TaskContext task(1, options.progress, options.trusted ? 0 : file.header().sections + file::kVerifyParts);
  if (!options.trusted) file.verify_checksums(task);
  auto view = take_arrays(file);
  file.expect_end();
  if (!options.trusted) file::verify(*view, file, task);
  view->owner = std::move(owner);
  return IndexAccess::make(std::move(view));
}

}  // namespace meshhood
