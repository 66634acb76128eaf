// SPDX-License-Identifier: MIT
#include "parts/partition.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <span>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "meshhood/error.h"

#include "base/checksum.h"
#include "base/distance.h"
#include "base/text.h"
#include "io/messages.h"
#include "parts/corner_positions.h"
#include "parts/cut_tree.h"
#include "parts/edge_lengths.h"
#include "parts/folder_lock.h"
#include "parts/part_writer.h"
#include "parts/temporary_folder.h"

namespace meshhood::parts {
namespace {

namespace fs = std::filesystem;

/// Of the vertices that are read at once. Fixed, because the content hash depends on it.
constexpr std::size_t kVertexChunk = std::size_t{1} << 16;
constexpr std::size_t kHashedCorners = std::size_t{1} << 18;

constexpr std::string_view kTemporaryFolder = ".partition.tmp";

/// How the memory is divided. A chunk of faces takes about 100 bytes a corner, with all that is derived from it.
struct Budget {
  std::size_t corners;
  std::size_t spill_bytes;
  std::uint64_t part_bytes;
  std::uint64_t sample_bytes;

  explicit Budget(std::uint64_t memory)
      : corners(static_cast<std::size_t>(memory / 256)),
        spill_bytes(static_cast<std::size_t>(memory / 8)),
        part_bytes(memory - memory / 4),
        sample_bytes(memory / 4) {}
};

/// The progress of the whole: each stage has a share of it.
class Stages {
 public:
  explicit Stages(const Progress& progress) : progress_(progress) { report(0); }

  /// Begins a stage, at whose end `share` of the whole is done.
  void begin(double share) {
    begin_ = end_;
    end_ = share;
    report(0);
  }

  void report(double fraction) {
    done_ = std::max(done_, static_cast<std::size_t>(kTotal * (begin_ + (end_ - begin_) * std::min(1.0, fraction))));
    if (progress_ && !progress_(done_, kTotal)) raise(ErrorCode::Cancelled, "cancelled");
  }

  void report(std::uint64_t done, std::uint64_t total) {
    report(total == 0 ? 1.0 : static_cast<double>(done) / static_cast<double>(total));
  }

 private:
  static constexpr std::size_t kTotal = 10'000;

  const Progress& progress_;
  double begin_ = 0;
  double end_ = 0;
  std::size_t done_ = 0;
};

/// Calls `f(first, positions)` for all vertices, a chunk at a time.
template <class F>
void for_each_vertex_chunk(ChunkedMesh& mesh, Stages& stages, F&& f) {
  std::vector<Point> positions;
  for (std::uint64_t first = 0; first < mesh.vertex_count(); first += positions.size()) {
    positions.resize(static_cast<std::size_t>(std::min<std::uint64_t>(kVertexChunk, mesh.vertex_count() - first)));
    mesh.read_positions(first, positions);
    f(first, std::span<const Point>(positions));
    stages.report(first + positions.size(), mesh.vertex_count());
  }
}

/// The same for single vertices: `f(site)`.
template <class F>
void for_each_vertex(ChunkedMesh& mesh, Stages& stages, F&& f) {
  for_each_vertex_chunk(mesh, stages, [&](std::uint64_t first, std::span<const Point> positions) {
    for (std::size_t i = 0; i < positions.size(); ++i) f(Site{positions[i], first + i});
  });
}

/// What the first pass learns.
struct Survey {
  std::uint64_t faces = 0;
  std::uint64_t corners = 0;
  Fingerprint content_hash;
  std::vector<Site> sample;
};

/// Spreads ids, so that a sample by this number does not follow a pattern of the numbering. The finalizer of
/// SplitMix64 (Steele, Lea and Flood, 2014).
std::uint64_t scattered(std::uint64_t id) {
  id += 0x9e3779b97f4a7c15U;
  id = (id ^ id >> 30U) * 0xbf58476d1ce4e5b9U;
  id = (id ^ id >> 27U) * 0x94d049bb133111ebU;
  return id ^ id >> 31U;
}

/// Every vertex with a number up to this is in the sample.
std::uint64_t sample_limit(std::uint64_t vertices, std::uint64_t sample) {
  constexpr auto kAll = std::numeric_limits<std::uint64_t>::max();
  return vertices <= sample ? kAll : kAll / vertices * sample;
}

/// Reads the whole mesh once, so that every fault is found before anything is written.
Survey survey(ChunkedMesh& mesh, std::uint64_t sample, Stages& stages) {
  Survey result;
  const auto hash = [&](std::span<const std::byte> bytes) {
    const Fingerprint before = result.content_hash;
    result.content_hash = wide_checksum({std::as_bytes(std::span(&before, 1)), bytes});
  };
  const std::array<std::uint64_t, 2> head{mesh.vertex_count(), mesh.is_double() ? 8U : 4U};
  hash(std::as_bytes(std::span(head)));
  const std::uint64_t limit = sample_limit(mesh.vertex_count(), sample);
  for_each_vertex_chunk(mesh, stages, [&](std::uint64_t first, std::span<const Point> positions) {
    hash(std::as_bytes(positions));
    for (std::size_t i = 0; i < positions.size(); ++i) {
      if (scattered(first + i) <= limit) result.sample.push_back({positions[i], first + i});
    }
  });
  FaceChunk chunk;
  mesh.rewind_faces();
  while (mesh.read_faces(kHashedCorners, chunk)) {
    hash(std::as_bytes(std::span(chunk.corners)));
    hash(std::as_bytes(std::span(chunk.ends)));
    result.faces += chunk.size();
    result.corners += chunk.corners.size();
    stages.report(1.0);
  }
  return result;
}

std::uint64_t number_of_parts(const PartitionOptions& options, std::uint64_t vertices) {
  if (options.parts != 0) return options.parts;
  return std::max<std::uint64_t>(1, (vertices + options.vertices_per_part - 1) / options.vertices_per_part);
}

void check(const PartitionOptions& options) {
  if ((options.parts == 0) == (options.vertices_per_part == 0)) {
    raise(ErrorCode::InvalidOption, "expected the number of parts or the vertices per part, one of them");
  }
  if (!(options.halo >= 0) || std::isinf(options.halo)) {
    raise(ErrorCode::InvalidRadius, "halo " + to_text(options.halo) + ", expected a finite number >= 0");
  }
  if (options.memory < kLeastMemory) {
    raise(ErrorCode::InvalidOption,
          fmt::format("a memory of {} bytes, expected at least {}", options.memory, kLeastMemory));
  }
}

/// The number of vertices by which the cuts are chosen. It depends on the number of parts alone, so that a run with
/// another memory cuts alike. A part then owns its share give or take a standard deviation of about 2 %.
std::uint64_t sample_size(std::uint64_t parts) {
  constexpr std::uint64_t kOfEachPart = 2048;
  constexpr std::uint64_t kLeast = std::uint64_t{1} << 18;
  return std::max(kLeast, parts * kOfEachPart);
}

void check_number_of_parts(std::uint64_t parts, std::uint64_t sample_bytes) {
  constexpr std::uint64_t kMostParts = std::numeric_limits<std::uint32_t>::max() / 4;
  if (parts <= kMostParts && sample_size(parts) * sizeof(Site) <= sample_bytes) return;
  raise(ErrorCode::TooLarge, fmt::format("{} parts need more memory than is allowed; use fewer parts", parts));
}

/// Which parts each corner of a chunk belongs to.
class CornerParts {
 public:
  CornerParts(const CornerPositions& vertices, const CutTree& tree, double squared_halo) {
    begins_.reserve(vertices.size() + 1);
    std::vector<std::uint32_t> near;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      begins_.push_back(parts_.size());
      tree.find_near(vertices.at(i), squared_halo, near);
      parts_.insert(parts_.end(), near.begin(), near.end());
    }
    begins_.push_back(parts_.size());
  }

  [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t number) const {
    return std::span(parts_).subspan(begins_[number], begins_[number + 1] - begins_[number]);
  }

 private:
  std::vector<std::size_t> begins_;
  std::vector<std::uint32_t> parts_;  // ascending for each vertex
};

/// One run of `partition`.
class Run {
 public:
  Run(ChunkedMesh& mesh, const fs::path& folder, const PartitionOptions& options)
      : mesh_(mesh), folder_(folder), options_(options), budget_(options.memory), stages_(options.progress) {}

  PartitionResult run() {
    const FolderLock lock(folder_);
    const std::uint64_t parts = number_of_parts(options_, mesh_.vertex_count());
    check_number_of_parts(parts, budget_.sample_bytes);
    stages_.begin(0.05);
    Survey found = survey(mesh_, sample_size(parts), stages_);
    const TemporaryFolder temporary(folder_ / kTemporaryFolder);
    make_plan(found, parts, temporary.path());
    keep_finished_parts();
    if (result_.kept < plan().parts) {
      CutTree tree(std::exchange(found.sample, {}), plan().parts);
      write_parts(tree, found.corners, temporary.path());
    }
    stages_.begin(1.0);
    stages_.report(1.0);
    write_manifest(folder_, result_.manifest);
    return std::move(result_);
  }

 private:
  [[nodiscard]] Plan& plan() { return result_.manifest.plan; }

  void make_plan(const Survey& found, std::uint64_t parts, const fs::path& temporary) {
    stages_.begin(0.2);
    std::uint64_t done = 0;
    const double mean = mean_edge_length(mesh_, temporary, budget_.corners,
                                         [&](std::size_t corners) { stages_.report(done += corners, found.corners); });
    plan() = {.vertices = mesh_.vertex_count(),
              .faces = found.faces,
              .is_double = mesh_.is_double(),
              .content_hash = found.content_hash,
              .mean_edge_length = mean,
              .halo = options_.halo_in_edges ? options_.halo * mean : options_.halo,
              .parts = static_cast<std::size_t>(parts)};
  }

  [[nodiscard]] fs::path folder_of(std::size_t part) const { return folder_ / part_name(part); }

  /// Finds out which parts need not be written. A folder of another plan is refused.
  void keep_finished_parts() {
    finished_.resize(plan().parts);
    result_.manifest.parts.resize(plan().parts);
    if (!options_.resume) return remove_old();
    if (fs::exists(folder_ / kManifestFile)) check_plan(read_manifest(folder_).plan);
    for (std::size_t part = 0; part < plan().parts; ++part) {
      std::optional<Part> found = read_part(folder_of(part), plan(), part);
      if (!found || !is_whole(folder_of(part), *found)) continue;
      result_.manifest.parts[part] = std::move(*found);
      finished_[part] = true;
      ++result_.kept;
    }
  }

  void check_plan(const Plan& old) {
    if (old == plan()) return;
    raise(ErrorCode::MalformedIndex,
          fmt::format("{}: holds {} parts of {} with halo {} already; expected an empty folder, or the same mesh, halo "
                      "and number of parts",
                      io::printable_name(folder_.string()), old.parts,
                      old.content_hash == plan().content_hash ? "this mesh" : "another mesh", to_text(old.halo)));
  }

  static bool is_whole(const fs::path& folder, const Part& part) {
    try {
      verify_part(folder, part);
      return true;
    } catch (const Error& error) {
      if (error.code() != ErrorCode::MalformedIndex && error.code() != ErrorCode::IoFailure) throw;
      return false;  // written again
    }
  }

  void remove_old() const {
    fs::remove(folder_ / kManifestFile);
    std::vector<fs::path> old;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      if (fs::exists(entry.path() / kPartFile)) old.push_back(entry.path());
    }
    for (const fs::path& path : old) fs::remove_all(path);
  }

  void write_parts(CutTree& tree, std::uint64_t corners, const fs::path& temporary) {
    stages_.begin(0.22);
    for_each_vertex(mesh_, stages_, [&](const Site& vertex) { tree.add(vertex); });
    PartContents contents{.vertices = Spill(temporary, "vertices", plan().parts, budget_.spill_bytes / 2),
                          .faces = Spill(temporary, "faces", plan().parts, budget_.spill_bytes / 2)};
    const double squared_halo = squared_radius(plan().halo);
    distribute_vertices(tree, squared_halo, contents);
    distribute_faces(tree, squared_halo, corners, contents);
    contents.vertices.flush();
    contents.faces.flush();
    check_memory(contents);
    for (std::size_t part = 0; part < plan().parts; ++part) {
      stages_.begin(0.4 + 0.6 * static_cast<double>(part + 1) / static_cast<double>(plan().parts));
      if (!finished_[part]) write_one(part, contents, tree, temporary);
    }
  }

  void distribute_vertices(const CutTree& tree, double squared_halo, PartContents& contents) {
    stages_.begin(0.25);
    std::vector<std::uint64_t> sizes(plan().parts);
    std::vector<std::uint32_t> near;
    for_each_vertex(mesh_, stages_, [&](const Site& vertex) {
      tree.find_near(vertex.position, squared_halo, near);
      for (const std::uint32_t part : near) {
        ++sizes[part];
        if (!finished_[part]) contents.vertices.append(part, vertex_words(vertex));
      }
    });
    warn_about(sizes);
  }

  void warn_about(std::span<const std::uint64_t> sizes) {
    const auto whole = std::count(sizes.begin(), sizes.end(), plan().vertices);
    if (plan().parts == 1 || plan().vertices == 0 || whole == 0) return;
    result_.warnings.push_back(
        fmt::format("with the halo {}, {} of {} parts are as large as the mesh; a smaller halo makes smaller parts",
                    to_text(plan().halo), whole, plan().parts));
  }

  void distribute_faces(const CutTree& tree, double squared_halo, std::uint64_t corners, PartContents& contents) {
    stages_.begin(0.4);
    FaceChunk chunk;
    std::uint64_t done = 0;
    mesh_.rewind_faces();
    while (mesh_.read_faces(budget_.corners, chunk)) {
      const CornerPositions vertices(mesh_, chunk);
      const CornerParts parts(vertices, tree, squared_halo);
      for (std::size_t face = 0; face < chunk.size(); ++face) {
        distribute_face(chunk.face(face), vertices, parts, contents);
      }
      stages_.report(done += chunk.corners.size(), corners);
    }
  }

  /// Every part that has a corner of a face gets the face, and the other corners as its fringe.
  void distribute_face(std::span<const std::uint64_t> face, const CornerPositions& vertices, const CornerParts& parts,
                       PartContents& contents) {
    takers_.clear();
    for (const std::uint64_t corner : face) {
      const auto more = parts[vertices.number(corner)];
      takers_.insert(takers_.end(), more.begin(), more.end());
    }
    std::sort(takers_.begin(), takers_.end());
    takers_.erase(std::unique(takers_.begin(), takers_.end()), takers_.end());
    for (const std::uint32_t part : takers_) {
      if (finished_[part]) continue;
      contents.faces.append(part, std::array{std::uint64_t{face.size()}});
      contents.faces.append(part, face);
      for (const std::uint64_t corner : face) {
        const std::size_t number = vertices.number(corner);
        const auto has = parts[number];
        if (std::binary_search(has.begin(), has.end(), part)) continue;
        contents.vertices.append(part, vertex_words({vertices.at(number), corner}));
      }
    }
  }

  void check_memory(const PartContents& contents) const {
    for (std::size_t part = 0; part < finished_.size(); ++part) {
      const std::uint64_t bytes = part_memory(contents, part);
      if (finished_[part] || bytes <= budget_.part_bytes) continue;
      raise(ErrorCode::TooLarge,
            fmt::format("part {} takes about {:.4g} MB of memory with its halo, but {:.4g} MB are allowed: use more "
                        "parts, a smaller halo or more memory",
                        part, static_cast<double>(bytes) / 1e6 * 4 / 3, static_cast<double>(options_.memory) / 1e6));
    }
  }

  void write_one(std::size_t part, const PartContents& contents, const CutTree& tree, const fs::path& temporary) {
    const fs::path work = temporary / part_name(part);
    const Progress progress = [this](std::size_t done, std::size_t total) {
      stages_.report(done, total);
      return true;
    };
    fs::create_directory(work);
    const BuildOptions build{.threads = options_.threads, .progress = progress};
    Part written = write_part_files(work, contents, part, tree, plan().is_double, build);
    write_part(work, plan(), part, written);
    fs::remove_all(folder_of(part));  // a damaged one
    fs::rename(work, folder_of(part));
    fs::remove(contents.vertices.file(part));
    fs::remove(contents.faces.file(part));
    result_.manifest.parts[part] = std::move(written);
  }

  ChunkedMesh& mesh_;
  fs::path folder_;
  const PartitionOptions& options_;
  Budget budget_;
  Stages stages_;
  PartitionResult result_;
  std::vector<bool> finished_;
  std::vector<std::uint32_t> takers_;  // of the current face
};

/// Calls `f`. An error of the file system becomes one of ours.
template <class F>
auto naming_file_errors(F&& f) {
  try {
    return f();
  } catch (const fs::filesystem_error& error) {
    io::raise_errno(error.path1(), error.code().value());
  }
}

}  // namespace

PartitionResult partition(ChunkedMesh& mesh, const fs::path& folder, const PartitionOptions& options) {
  check(options);
  return naming_file_errors([&] {
    std::error_code error;
    fs::create_directory(folder, error);
    // A file of this name is refused when the folder is opened.
    if (error && error != std::errc::file_exists) io::raise_errno(folder, error.value(), "create");
    return Run(mesh, folder, options).run();
  });
}

}  // namespace meshhood::parts
