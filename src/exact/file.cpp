// SPDX-License-Identifier: MIT
// Saves and loads the exact index. Its sections are its arrays as they are in memory, so that a file can be mapped.
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "meshhood/error.h"
#include "meshhood/serialize.h"

#include "exact/index_access.h"
#include "exact/layout.h"
#include "exact/stored_faces.h"
#include "exact/verify.h"
#include "format/format.h"
#include "shared/aligned_buffer.h"
#include "shared/parallel.h"

namespace meshhood::inline v0_1 {
namespace {

// There are no padding bytes: every byte in the file has a defined value.
static_assert(sizeof(Frame) == 32 && sizeof(Leaf) == 28 && sizeof(Link) == 12 && sizeof(CrossEdge) == 2 &&
              sizeof(Group) == 128 && sizeof(GroupRecord) == 64 && sizeof(NodeLink) == 5);

template <class T>
void take(file::SectionReader& file, const char* section, std::span<const T>& array) {
  array = file.take<T>(section);
}

void take(file::SectionReader& file, const char* section, PositionsInOrder& positions) {
  if (file.header().scalar_bytes == sizeof(float)) {
    positions = file.take<float>(section);
  } else {
    positions = file.take<double>(section);
  }
}

/// Throws unless each array has as many elements as the others imply. Does not read the elements.
void verify_sizes(const IndexView& view, const file::SectionReader& file) {
  const std::uint64_t vertices = file.header().vertices;
  const auto expect = [&](const char* section, std::uint64_t size, std::uint64_t expected, const char* what) {
    if (size == expected) return;
    file.refuse_in(section, 0, std::to_string(size) + ", expected " + std::to_string(expected) + what);
  };
  const auto refuse = [&](const char* section, const std::string& message) { file.refuse_in(section, 0, message); };
  const std::uint64_t padded = vertices + kLeafCapacity;
  expect("positions", std::visit([](auto xyz) { return xyz.size(); }, view.positions), 3 * padded, " values");
  if (!view.permutation.empty() && view.permutation.size() != padded) {
    refuse("permutation",
           std::to_string(view.permutation.size()) + " vertices, expected none or " + std::to_string(padded));
  }
  expect("place", view.slot.size(), vertices, " values");
  // No leaf is empty, and no group of leaves, so there are at most eight places for each vertex.
  const std::size_t leaves = view.leaves.empty() ? 0 : view.leaves.size() - 1;
  if (view.leaves.empty() || leaves > vertices * kFanOut || (leaves == 0) != (vertices == 0)) {
    refuse("leaves",
           std::to_string(view.leaves.size()) + " leaf records for " + std::to_string(vertices) + " vertices");
  }
  expect("leaf_begin", view.leaf_begin.size(), leaves + 1, " values");
  if (view.links.empty()) refuse("links", "no link record, expected at least the one that marks the end");
  if (view.cross_edges.size() < kLeafCapacity) {
    refuse("crossings", std::to_string(view.cross_edges.size()) + " cross edges, expected at least " +
                            std::to_string(kLeafCapacity) + " of padding");
  }
  expect("adjacency", view.adjacency.size(), padded, " values");
  if (view.levels.empty() || view.levels.front() != 0) refuse("levels", "the first level does not begin at group 0");
  if (view.levels.size() > kMaxLevels + 1) {
    refuse("levels",
           std::to_string(view.levels.size() - 1) + " levels, expected at most " + std::to_string(kMaxLevels));
  }
  for (std::size_t level = 1; level < view.levels.size(); ++level) {
    if (view.levels[level] <= view.levels[level - 1])
      refuse("levels", "level " + std::to_string(level - 1) + " has no group");
  }
  expect("leaves", leaves, view.levels.size() > 1 ? std::uint64_t{view.levels[1]} * kFanOut : 0, " places for leaves");
  expect("groups", view.groups.size(), view.levels.back(), " values");
  expect("group_records", view.records.size(), view.levels.back(), " values");
  expect("parents", view.parents.size(), view.levels.back(), " values");
  expect("mean_radii", view.mean_radii.size(), view.levels.size() - 1, " values");
}

/// Takes the sections of faces, which are optional, and follow those of all arrays. Does not read their elements.
std::optional<StoredFaces> take_faces(file::SectionReader& file) {
  if (!file.is_next("face_corners")) return std::nullopt;
  StoredFaces faces{.corners = file.take<VertexId>("face_corners"), .offsets = {}};
  if (file.is_next("face_offsets")) {
    faces.offsets = file.take<std::uint32_t>("face_offsets");
    if (faces.offsets.size() < 2) {
      file.refuse_last(std::to_string(faces.offsets.size()) + " values, expected one more than there are faces");
    }
  } else if (faces.corners.size() % 3 != 0) {
    file.refuse_last(std::to_string(faces.corners.size()) + " corners, expected three for each triangle");
  }
  return faces;
}

void add(file::SectionWriter& writer, const FaceArrays& faces) {
  writer.add("face_corners", std::span<const VertexId>(faces.corners));
  if (!faces.offsets.empty()) writer.add("face_offsets", std::span<const std::uint32_t>(faces.offsets));
}

/// Returns a view of the arrays in the file; only their sizes are verified.
std::shared_ptr<IndexView> take_arrays(file::SectionReader& file) {
  auto view = std::make_shared<IndexView>();
  view->frame = file.take<Frame>("frame", 1).front();
  for_each_array([&](ArrayInfo info, auto& array) { take(file, info.section, array); }, *view);
  verify_sizes(*view, file);
  view->faces = take_faces(file);
  derive(*view);
  return view;
}

template <class T>
void add(file::SectionWriter& writer, const char* section, std::span<const T> array) {
  writer.add(section, array);
}

void add(file::SectionWriter& writer, const char* section, const PositionsInOrder& positions) {
  std::visit([&](auto xyz) { writer.add(section, xyz); }, positions);
}

void verify_alignment(std::span<const std::byte> bytes) {
  const auto address = reinterpret_cast<std::uintptr_t>(bytes.data());
  if (address % kIndexAlignment == 0) return;
  raise(ErrorCode::InvalidOption, "the bytes to map begin " + std::to_string(address % kIndexAlignment) +
                                      " bytes after a multiple of " + std::to_string(kIndexAlignment));
}

}  // namespace

void save(const Index& index, const Sink& sink, const SaveOptions& options, const Run& run) {
  const IndexView& view = IndexAccess::whole(index, "saved");
  file::SectionWriter writer;
  writer.add("frame", std::span(&view.frame, 1));
  for_each_array([&](ArrayInfo info, const auto& array) { add(writer, info.section, array); }, view);
  FaceArrays faces;
  if (options.faces) {
    validate(MeshView{index.positions(), *options.faces});
    faces = make_face_arrays(*options.faces);
    add(writer, faces);
  }
  const bool is_double = std::holds_alternative<std::span<const double>>(view.positions);
  const std::size_t scalar_bytes = is_double ? sizeof(double) : sizeof(float);
  TaskContext task(1, run.progress, writer.parts());
  const Fingerprint mesh = fingerprint(index, task);
  task.report_progress();
  writer.write({.vertices = view.vertex_count(),
                .mesh = mesh,
                .kind = IndexKind::Exact,
                .scalar_bytes = static_cast<std::uint8_t>(scalar_bytes)},
               sink, task);
}

Index load(std::span<const std::byte> bytes, const Run& run) {
  // The header is verified before the copy is allocated.
  static_cast<void>(read_header(bytes));
  AlignedBuffer copy = AlignedBuffer::copy_of(bytes);
  const auto at = copy.bytes();
  return map(at, copy.take_owner(), {}, run);
}

Index map(std::span<const std::byte> bytes, std::shared_ptr<const void> owner, const MapOptions& options,
          const Run& run) {
  verify_alignment(bytes);
  file::SectionReader file(bytes);
  file::expect_kind(file.header().kind, IndexKind::Exact);
  TaskContext task(1, run.progress, options.trusted ? 0 : file.header().sections + file::kVerifyParts);
  if (!options.trusted) file.verify_checksums(task);
  auto view = take_arrays(file);
  file.expect_end();
  if (!options.trusted) file::verify(*view, file, task);
  view->owner = std::move(owner);
  return IndexAccess::make(std::move(view));
}

}  // namespace meshhood::inline v0_1
