// SPDX-License-Identifier: MIT
// Saves and loads the index of the paper. Data that follows from other data is not stored and so cannot contradict it:
// parents, the vertices of clusters above the lowest level, the cluster of each vertex, mean radii.
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "meshhood/error.h"
#include "meshhood/serialize.h"

#include "format/format.h"
#include "paper/draft.h"
#include "paper/hierarchy.h"
#include "shared/aligned_buffer.h"
#include "shared/distance.h"
#include "shared/parallel.h"

namespace meshhood::inline v0_1::paper {
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

/// Returns the name of the section of the first members of clusters: vertices on the lowest level, children above.
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

void verify_row(const AdjacencyView& siblings, std::size_t cluster, const SectionReader& file) {
  const std::span<const VertexId> row = siblings[cluster];
  for (const VertexId& sibling : row) {
    const bool is_next = &sibling == row.data() || (&sibling)[-1] < sibling;
    if (sibling < siblings.size() && sibling != cluster && is_next) continue;
    file.refuse(&sibling, "cluster " + std::to_string(cluster) + ": sibling " + std::to_string(sibling) +
                              ", expected another of " + std::to_string(siblings.size()) + ", in ascending order");
  }
}

/// `ids` must have each of 0 .. size - 1 once.
void verify_permutation(std::span<const VertexId> ids, const SectionReader& file) {
  std::vector<bool> seen(ids.size());
  for (const VertexId& id : ids) {
    if (id >= ids.size() || seen[id]) {
      file.refuse(&id, "vertex " + std::to_string(id) + ", expected each of " + std::to_string(ids.size()) + " once");
    }
    seen[id] = true;
  }
}

/// `starts` must ascend strictly from 0 to `end`.
void verify_starts(std::span<const ClusterId> starts, std::size_t end, const SectionReader& file) {
  if (starts.front() != 0) file.refuse(starts.data(), "begins with " + std::to_string(starts.front()) + ", expected 0");
  for (std::size_t c = 0; c + 1 < starts.size(); ++c) {
    if (starts[c] < starts[c + 1] && starts[c + 1] <= end) continue;
    file.refuse(&starts[c], "cluster " + std::to_string(c) + ": range from " + std::to_string(starts[c]) + " to " +
                                std::to_string(starts[c + 1]) + ", expected a range that is not empty and ends by " +
                                std::to_string(end));
  }
  if (starts.back() != end) {
    file.refuse(&starts.back(), "ends with " + std::to_string(starts.back()) + ", expected " + std::to_string(end));
  }
}

/// Each row must ascend, be in range, and not contain its own cluster; each pair must occur in both directions.
void verify_siblings(const AdjacencyView& siblings, const SectionReader& file) {
  const std::size_t end = siblings.neighbors.size();
  if (siblings.offsets.front() != 0 || siblings.offsets.back() != end) {
    file.refuse(siblings.offsets.data(), "rows do not run from 0 to " + std::to_string(end));
  }
  for (std::size_t c = 0; c < siblings.size(); ++c) {
    if (siblings.offsets[c] <= siblings.offsets[c + 1] && siblings.offsets[c + 1] <= end) continue;
    file.refuse(&siblings.offsets[c], "cluster " + std::to_string(c) + ": rows do not ascend");
  }
  for (std::size_t c = 0; c < siblings.size(); ++c) verify_row(siblings, c, file);
  // Clusters are visited in ascending order, so their entries must come in that order in each sibling's row.
  std::vector<EdgeOffset> next(siblings.offsets.begin(), siblings.offsets.end());
  for (std::size_t c = 0; c < siblings.size(); ++c) {
    for (const VertexId& sibling : siblings[c]) {
      const std::size_t back = next[sibling]++;
      if (back < siblings.offsets[sibling + std::size_t{1}] && siblings.neighbors[back] == c) continue;
      file.refuse(&sibling, "cluster " + std::to_string(c) + ": sibling " + std::to_string(sibling) +
                                " does not list it as a sibling");
    }
  }
}

template <class Real>
void verify_spheres(std::span<const Sphere<Real>> spheres, const SectionReader& file) {
  for (const Sphere<Real>& s : spheres) {
    const bool is_sphere = std::isfinite(s.x) && std::isfinite(s.y) && std::isfinite(s.z) && std::isfinite(s.radius);
    if (!is_sphere || s.radius < 0)
      file.refuse(&s, "a sphere whose center or radius is not finite, or whose radius is negative");
  }
}

/// Spheres must enclose their vertices, with the distances of the query.
template <class Real>
void verify_enclosed(const Hierarchy<Real>& hierarchy, const SectionReader& file) {
  for (std::size_t l = 0; l < hierarchy.levels.size(); ++l) {
    const Level<Real>& level = hierarchy.levels[l];
    for (std::size_t c = 0; c < level.size(); ++c) {
      const Sphere<Real>& sphere = level.spheres[c];
      for (std::size_t i = level.first_vertex[c]; i < level.first_vertex[c + 1]; ++i) {
        const double d2 = squared_distance(center_of(sphere), point<Real>(hierarchy.positions, i));
        if (std::sqrt(d2) <= static_cast<double>(sphere.radius)) continue;
        file.refuse_in(
            "spheres " + std::to_string(l), c * sizeof(Sphere<Real>),
            "cluster " + std::to_string(c) + ": does not enclose vertex " + std::to_string(hierarchy.vertices[i]));
      }
    }
  }
}

/// `below` has the levels below, and the vertices.
template <class Real>
Level<Real> take_level(SectionReader& file, std::size_t l, const LevelRecord& record, const Hierarchy<Real>& below) {
  const std::size_t clusters = record.clusters;
  const std::size_t members = l == 0 ? below.vertices.size() : below.levels.back().spheres.size();
  Level<Real> level;
  level.number = static_cast<int>(record.number);
  const auto first = file.take<ClusterId>(members_name(l), std::uint64_t{clusters} + 1);
  verify_starts(first, members, file);
  (l == 0 ? level.first_vertex : level.first_child) = copy(first);
  const auto spheres = file.take<Sphere<Real>>(on_level("spheres", l), clusters);
  verify_spheres(spheres, file);
  level.spheres = copy(spheres);
  const auto rows = file.take<EdgeOffset>(on_level("sibling_rows", l), std::uint64_t{clusters} + 1);
  const auto siblings = file.take<ClusterId>(on_level("siblings", l));
  verify_siblings({rows, siblings}, file);
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
  verify_permutation(ids, file);
  hierarchy.vertices = copy(ids);
  for (std::size_t l = 0; l < records.size(); ++l) {
    hierarchy.levels.push_back(take_level(file, l, records[l], hierarchy));
  }
  file.expect_end();
  derive(hierarchy);
  for (Level<Real>& level : hierarchy.levels) level.mean_radius = mean_radius(level);
  verify_enclosed(hierarchy, file);
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

}  // namespace meshhood::inline v0_1::paper
