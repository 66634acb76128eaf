// SPDX-License-Identifier: MIT
#include "parts/partition.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "meshhood/error.h"

#include "io/messages.h"
#include "parts/cut_tree.h"
#include "parts/distribution.h"
#include "parts/folder.h"
#include "parts/part_writer.h"
#include "parts/passes.h"
#include "parts/survey.h"
#include "shared/coarse_float.h"
#include "shared/distance.h"
#include "shared/text.h"

namespace meshhood::parts {
namespace {

namespace fs = std::filesystem;

/// How the memory is divided. A chunk of faces takes about 100 bytes a corner, with all that is derived from it.
struct Budget {
  std::uint64_t memory;
  std::size_t corners = static_cast<std::size_t>(memory / 256);
  std::size_t spill_bytes = static_cast<std::size_t>(memory / 8);
  std::uint64_t part_bytes = memory - memory / 4;
  std::uint64_t sample_bytes = memory / 4;
};

std::uint64_t number_of_parts(const PartitionOptions& options, std::uint64_t vertices) {
  if (options.parts != 0) return options.parts;
  return std::max<std::uint64_t>(1, (vertices + options.vertices_per_part - 1) / options.vertices_per_part);
}

void check(const PartitionOptions& options) {
  if ((options.parts == 0) == (options.vertices_per_part == 0)) {
    raise(ErrorCode::InvalidOption, "expected either the number of parts or the vertices per part");
  }
  if (!(options.halo >= 0) || std::isinf(options.halo)) {
    raise(ErrorCode::InvalidRadius, "halo " + to_text(options.halo) + ", expected a finite number >= 0");
  }
  if (options.memory < kLeastMemory) {
    raise(ErrorCode::InvalidOption,
          fmt::format("a memory of {} bytes, expected at least {}", options.memory, kLeastMemory));
  }
}

void check_number_of_parts(std::uint64_t parts, std::uint64_t sample_bytes) {
  constexpr std::uint64_t kMostParts = std::numeric_limits<std::uint32_t>::max() / 4;
  if (parts <= kMostParts && sample_size(parts) * sizeof(Site) <= sample_bytes) return;
  raise(ErrorCode::TooLarge, fmt::format("{} parts need more memory than is allowed; use fewer parts", parts));
}

/// One call of `partition`.
class Partitioning {
 public:
  Partitioning(ChunkedMesh& mesh, const fs::path& folder, const PartitionOptions& options, const Run& run)
      : mesh_(mesh), folder_(folder), options_(options), run_(run) {}

  PartitionResult run() {
    const FolderLock lock(folder_);
    check_mark(folder_);
    const std::uint64_t parts = number_of_parts(options_, mesh_.vertex_count());
    check_number_of_parts(parts, budget_.sample_bytes);
    stages_.begin(0.05);
    Survey found = survey(mesh_, parts, stages_);
    mark_folder(folder_);
    const TemporaryFolder temporary(folder_ / kTemporaryFolder);
    make_plan(found, parts, temporary.path());
    keep_finished_parts(temporary.path());
    if (result_.kept < plan().parts) {
      CutTree tree(std::exchange(found.sample, {}), plan().parts);
      write_parts(tree, found.corners, temporary.path());
    }
    stages_.begin(1.0);
    stages_.report(1.0);
    // A run that is killed meanwhile leaves its file where the next one removes it.
    write_manifest(temporary.path(), result_.manifest);
    fs::rename(temporary.path() / kManifestFile, folder_ / kManifestFile);
    lock.sync();
    return std::move(result_);
  }

 private:
  [[nodiscard]] Plan& plan() { return result_.manifest.plan; }

  void make_plan(const Survey& found, std::uint64_t parts, const fs::path& temporary) {
    stages_.begin(0.2);
    const double mean = mean_edge_length(mesh_, temporary, budget_.corners, found.corners, stages_);
    plan() = {.vertices = mesh_.vertex_count(),
              .faces = found.faces,
              .is_double = mesh_.is_double(),
              .content_hash = found.content_hash,
              .mean_edge_length = mean,
              .halo = options_.halo_in_edges ? options_.halo * mean : options_.halo,
              .parts = static_cast<std::size_t>(parts)};
    if (const auto* warnings = mesh_.warnings()) {
      for (const auto& warning : *warnings) {
        result_.warnings.push_back(fmt::format("{}: {}", mesh_.name(), warning.text()));
      }
    } else if (!mesh_.is_double()) {
      warn_if_coarse(found.sample);
    }
  }

  void warn_if_coarse(std::span<const Site> sample) {
    double largest = 0;
    for (const auto& [p, id] : sample) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (const auto coarse = coarse_float(plan().mean_edge_length, largest)) {
      result_.warnings.push_back(fmt::format("{}: {}; {}", mesh_.name(), coarse->text(), kWriteOtherwise));
    }
  }

  [[nodiscard]] fs::path folder_of(std::size_t part) const { return folder_ / part_name(part); }

  /// Determines which parts need not be written, and removes the others. A folder of another plan is an error.
  void keep_finished_parts(const fs::path& temporary) {
    finished_.resize(plan().parts);
    result_.manifest.parts.resize(plan().parts);
    if (options_.resume && fs::exists(folder_ / kManifestFile)) check_plan(read_manifest(folder_).plan);
    std::vector<fs::path> removed;
    for (std::size_t part = 0; part < plan().parts || is_there(part); ++part) {
      if (is_there(part) && !(options_.resume && keep(part))) removed.push_back(folder_of(part));
    }
    for (const fs::path& part : removed) check_part(part);
    if (!options_.resume) fs::remove(folder_ / kManifestFile);
    // The last one first: if the run is stopped, those that are left are found as they have no gap.
    for (; !removed.empty(); removed.pop_back()) remove_part(removed.back(), temporary);
  }

  [[nodiscard]] bool is_there(std::size_t part) const { return fs::exists(fs::symlink_status(folder_of(part))); }

  /// False if the plan has no such part, or a file that its record lists is damaged.
  bool keep(std::size_t part) {
    std::optional<Part> found = read_part(folder_of(part), plan(), part);
    if (!found || part >= plan().parts || !is_whole(folder_of(part), *found)) return false;
    result_.manifest.parts[part] = std::move(*found);
    finished_[part] = true;
    ++result_.kept;
    return true;
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
    const auto is_as_listed = [&](const PartFile& file) { return describe_file(folder, file.name) == file; };
    try {
      return std::ranges::all_of(part.files, is_as_listed);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::IoFailure) throw;
      return false;  // written again
    }
  }

  void write_parts(CutTree& tree, std::uint64_t corners, const fs::path& temporary) {
    stages_.begin(0.22);
    for_each_vertex(mesh_, stages_, [&](const Site& vertex) { tree.add(vertex); });
    PartContents contents{.vertices = Spill(temporary, "vertices", plan().parts, budget_.spill_bytes / 2),
                          .faces = Spill(temporary, "faces", plan().parts, budget_.spill_bytes / 2)};
    const Distribution distribution{mesh_, tree, squared_radius(plan().halo), finished_, contents};
    stages_.begin(0.25);
    warn_about(distribution.add_vertices(stages_));
    stages_.begin(0.4);
    distribution.add_faces(budget_.corners, corners, stages_);
    contents.vertices.flush();
    contents.faces.flush();
    check_memory(contents);
    for (std::size_t part = 0; part < plan().parts; ++part) {
      stages_.begin(0.4 + 0.6 * static_cast<double>(part + 1) / static_cast<double>(plan().parts));
      if (!finished_[part]) write_one(part, contents, tree, temporary);
    }
  }

  void warn_about(std::span<const std::uint64_t> sizes) {
    const auto whole = std::count(sizes.begin(), sizes.end(), plan().vertices);
    if (plan().parts == 1 || plan().vertices == 0 || whole == 0) return;
    result_.warnings.push_back(
        fmt::format("with the halo {}, {} of {} parts are as large as the mesh; a smaller halo makes smaller parts",
                    to_text(plan().halo), whole, plan().parts));
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
    Part written =
        write_part_files(work, contents, part, tree, plan().is_double, {.threads = run_.threads, .progress = progress});
    write_part(work, plan(), part, written);
    fs::rename(work, folder_of(part));
    fs::remove(contents.vertices.file(part));
    fs::remove(contents.faces.file(part));
    result_.manifest.parts[part] = std::move(written);
  }

  ChunkedMesh& mesh_;
  const fs::path& folder_;
  const PartitionOptions& options_;
  const Run& run_;
  Budget budget_{.memory = options_.memory};
  Stages stages_{run_.progress};
  PartitionResult result_;
  std::vector<bool> finished_;
};

}  // namespace

PartitionResult partition(ChunkedMesh& mesh, const fs::path& folder, const PartitionOptions& options, const Run& run) {
  check(options);
  try {
    std::error_code error;
    fs::create_directory(folder, error);
    // A file of this name is refused when the folder is opened.
    if (error && error != std::errc::file_exists) io::raise_errno(folder, error.value(), "create");
    return Partitioning(mesh, folder, options, run).run();
  } catch (const fs::filesystem_error& error) {
    io::raise_errno(error.path1(), error.code().value());
  }
}

}  // namespace meshhood::parts
