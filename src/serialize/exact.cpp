// SPDX-License-Identifier: MIT
// The sections of the exact index: its arrays as they lie in memory, which is what can be mapped.
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "meshhood/error.h"
#include "meshhood/serialize.h"

#include "index/graph.h"
#include "index/index_access.h"
#include "index/layout.h"
#include "parallel.h"
#include "serialize/aligned_copy.h"
#include "serialize/exact_verify.h"
#include "serialize/section_reader.h"
#include "serialize/section_writer.h"

namespace meshhood {
namespace {

// Without a byte between or behind the fields: all of them have a value.
static_assert(sizeof(Frame) == 32 && sizeof(Leaf) == 28 && sizeof(Link) == 12 && sizeof(Crossing) == 2 &&
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
std::unique_ptr<IndexStorage> take_arrays(file::SectionReader& file) {
  const std::uint64_t vertices = file.header().vertices;
  auto storage = std::make_unique<IndexStorage>();
  storage->frame = file.take<Frame>("frame", 1).front();
  storage->positions = take_positions(file);
  storage->permutation = take_permutation(file);
  storage->place = file.take<std::uint32_t>("place", vertices);
  storage->leaves = file.take<Leaf>("leaves");
  // No leaf is empty, so there are no more of them than vertices, and none without vertices.
  const std::size_t leaves = storage->leaves.empty() ? 0 : storage->leaves.size() - 1;
  if (storage->leaves.empty() || leaves > vertices || (leaves == 0) != (vertices == 0)) {
    file.refuse_last(std::to_string(storage->leaves.size()) + " records of leaves for " + std::to_string(vertices) +
                     " vertices");
  }
  storage->leaf_begin = file.take<VertexId>("leaf_begin", leaves + 1);
  storage->links = file.take<Link>("links");
  if (storage->links.empty()) file.refuse_last("no link, expected one at the end at least");
  storage->crossings = file.take<Crossing>("crossings");
  if (storage->crossings.size() < kLeafCapacity) {
    file.refuse_last(std::to_string(storage->crossings.size()) + " crossings, expected " +
                     std::to_string(kLeafCapacity) + " at the end at least");
  }
  storage->adjacency = file.take<Lanes>("adjacency", vertices + kLeafCapacity);
  storage->groups = file.take<Group>("groups", tree_groups(leaves));
  storage->mean_radii = file.take<double>("mean_radii", tree_nodes(leaves).size());
  storage->tree = make_levels(leaves, storage->groups, storage->mean_radii);
  return storage;
}

void verify_alignment(std::span<const std::byte> bytes) {
  const auto address = reinterpret_cast<std::uintptr_t>(bytes.data());
  if (address % kIndexAlignment == 0) return;
  raise(ErrorCode::InvalidOption, "bytes to be mapped begin " + std::to_string(address % kIndexAlignment) +
                                      " after a multiple of " + std::to_string(kIndexAlignment));
}

/// As `fingerprint(index)`, which would not be watched.
Fingerprint fingerprint_of(const Index& index, Work& work) {
  const GraphData mesh = graph(index, work);
  return fingerprint(mesh.view());
}

}  // namespace

void save(const Index& index, const Sink& sink, const SaveOptions& options) {
  const IndexStorage& storage = IndexAccess::storage(index);
  file::SectionWriter writer;
  writer.add("frame", std::span(&storage.frame, 1));
  std::visit([&](auto xyz) { writer.add("positions", xyz); }, storage.positions);
  writer.add("permutation", storage.permutation);
  writer.add("place", storage.place);
  writer.add("leaves", storage.leaves);
  writer.add("leaf_begin", storage.leaf_begin);
  writer.add("links", storage.links);
  writer.add("crossings", storage.crossings);
  writer.add("adjacency", storage.adjacency);
  writer.add("groups", storage.groups);
  writer.add("mean_radii", storage.mean_radii);
  const bool is_double = std::holds_alternative<std::span<const double>>(storage.positions);
  const std::size_t scalar_bytes = is_double ? sizeof(double) : sizeof(float);
  Work work(1, options.progress, writer.parts());
  const Fingerprint mesh = fingerprint_of(index, work);
  work.report();
  writer.write({.vertices = storage.vertex_count(),
                .mesh = mesh,
                .kind = IndexKind::Exact,
                .scalar_bytes = static_cast<std::uint8_t>(scalar_bytes)},
               sink, work);
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
  Work work(1, options.progress, options.trusted ? 0 : file.header().sections + file::kVerifyParts);
  if (!options.trusted) file.verify_checksums(work);
  auto storage = take_arrays(file);
  file.expect_end();
  if (!options.trusted) file::verify(*storage, file, work);
  storage->owner = std::move(owner);
  return IndexAccess::make(std::move(storage));
}

}  // namespace meshhood
