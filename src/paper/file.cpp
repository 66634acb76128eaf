// SPDX-License-Identifier: MIT
// The sections of the paper's index. Data that follows from other data is not stored and so cannot contradict it:
// parents, the vertices of clusters above the lowest level, the cluster of each vertex, mean radii.
#include <string>
#include <utility>

#include "meshhood/error.h"
#include "meshhood/serialize.h"

#include "format/section_reader.h"
#include "format/section_writer.h"
#include "paper/draft.h"
#include "paper/hierarchy.h"
#include "paper/verify.h"
#include "shared/aligned_buffer.h"
#include "shared/parallel.h"

namespace meshhood::paper {
namespace {

using file::SectionReader;
using file::SectionWriter;

struct LevelRecord {
  std::uint32_t number;
  std::uint32_t clusters;
};

std::string on_level(const char* section, std::size_t level) { return section + (" " + std::to_string(level)); }

template <class T>
std::vector<T> copy(std::span<const T> values) {
  return {values.begin(), values.end()};
}

/// The section that says where the members of each cluster begin: vertices on the lowest level, children above.
std::string members_name(std::size_t level) { return level == 0 ? "first_vertex" : on_level("first_child", level); }

template <class Real>
void save(const Hierarchy<Real>& hierarchy, const Fingerprint& mesh, const Sink& sink, const Progress& progress) {
  std::vector<LevelRecord> records;
  records.reserve(hierarchy.levels.size());
  for (const Level<Real>& level : hierarchy.levels) {
    records.push_back({static_cast<std::uint32_t>(level.number), static_cast<std::uint32_t>(level.size())});
  }
  SectionWriter writer;
  writer.add("levels", std::span<const LevelRecord>(records));
  writer.add("positions", std::span<const Real>(hierarchy.positions));
  writer.add("vertices", std::span<const VertexId>(hierarchy.vertices));
  for (std::size_t l = 0; l < hierarchy.levels.size(); ++l) {
    const Level<Real>& level = hierarchy.levels[l];
    writer.add(members_name(l), std::span<const ClusterId>(l == 0 ? level.first_vertex : level.first_child));
    writer.add(on_level("spheres", l), std::span<const Sphere<Real>>(level.spheres));
    writer.add(on_level("sibling_rows", l), std::span<const EdgeOffset>(level.siblings.offsets));
    writer.add(on_level("siblings", l), std::span<const ClusterId>(level.siblings.neighbors));
  }
  TaskContext task(1, progress, writer.parts());
  writer.write(
      {.vertices = hierarchy.vertices.size(), .mesh = mesh, .kind = IndexKind::Paper, .scalar_bytes = sizeof(Real)},
      sink, task);
}

std::span<const LevelRecord> take_records(SectionReader& file) {
  const auto records = file.take<LevelRecord>("levels");
  if (records.empty() || records.size() > BuildOptions::kAllLevels) {
    file.refuse_last(std::to_string(records.size()) + " levels, expected 1 to " +
                     std::to_string(BuildOptions::kAllLevels));
  }
  for (const LevelRecord& record : records) {
    if (record.number >= BuildOptions::kAllLevels || record.number != records[0].number + (&record - records.data())) {
      file.refuse(&record, "level " + std::to_string(record.number) + ", expected ascending numbers below " +
                               std::to_string(BuildOptions::kAllLevels));
    }
  }
  return records;
}

/// below: the levels below, and the vertices.
template <class Real>
Level<Real> take_level(SectionReader& file, std::size_t l, const LevelRecord& record, const Hierarchy<Real>& below) {
  const std::size_t clusters = record.clusters;
  const std::size_t members = l == 0 ? below.vertices.size() : below.levels.back().spheres.size();
  Level<Real> level;
  level.number = static_cast<int>(record.number);
  const auto first = file.take<ClusterId>(members_name(l), std::uint64_t{clusters} + 1);
  file::verify_starts(first, members, file);
  (l == 0 ? level.first_vertex : level.first_child) = copy(first);
  const auto spheres = file.take<Sphere<Real>>(on_level("spheres", l), clusters);
  file::verify_spheres(spheres, file);
  level.spheres = copy(spheres);
  const auto rows = file.take<EdgeOffset>(on_level("sibling_rows", l), std::uint64_t{clusters} + 1);
  const auto siblings = file.take<ClusterId>(on_level("siblings", l));
  file::verify_siblings({rows, siblings}, file);
  level.siblings = {copy(rows), copy(siblings)};
  return level;
}

template <class Real>
Hierarchy<Real> take_hierarchy(SectionReader& file) {
  const auto records = take_records(file);
  const std::uint64_t vertices = file.header().vertices;
  Hierarchy<Real> hierarchy;
  const auto positions = file.take<Real>("positions", 3 * vertices);
  file::verify_coordinates(positions, file);
  hierarchy.positions = copy(positions);
  const auto ids = file.take<VertexId>("vertices", vertices);
  file::verify_permutation(ids, file);
  hierarchy.vertices = copy(ids);
  for (std::size_t l = 0; l < records.size(); ++l) {
    hierarchy.levels.push_back(take_level(file, l, records[l], hierarchy));
  }
  file.expect_end();
  derive(hierarchy);
  for (Level<Real>& level : hierarchy.levels) level.mean_radius = mean_radius(level);
  file::verify_enclosed(hierarchy, file);
  return hierarchy;
}

}  // namespace

void save(const Index& index, const Sink& sink, const Run& run) {
  std::visit([&](const auto& hierarchy) { save(hierarchy, IndexAccess::mesh(index), sink, run.progress); },
             IndexAccess::hierarchy(index));
}

Index load(std::span<const std::byte> bytes, const Run& run) {
  const IndexHeader header = read_header(bytes);
  file::expect_kind(header.kind, IndexKind::Paper);
  const AlignedBuffer copy = AlignedBuffer::copy_of(bytes);
  SectionReader file(copy.bytes());
  TaskContext task(1, run.progress, file.header().sections + 1);
  file.verify_checksums(task);
  AnyHierarchy hierarchy = header.is_double ? AnyHierarchy(take_hierarchy<double>(file)) : take_hierarchy<float>(file);
  task.step();
  return IndexAccess::make(std::move(hierarchy), header.mesh);
}

}  // namespace meshhood::paper
