// SPDX-License-Identifier: MIT
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "meshhood/error.h"

#include "bindings.h"
#include "interpreter.h"
#include "parts/manifest.h"
#include "parts/partition.h"

namespace nb = nanobind;

namespace meshhood::python {
namespace {

using Path = std::filesystem::path;

/// Returns the number of parts that an earlier run had finished, and the warnings.
std::tuple<std::size_t, std::vector<std::string>> partition_file(const Path& mesh, const std::optional<Path>& faces,
                                                                 const Path& folder, std::uint64_t parts,
                                                                 std::uint64_t vertices_per_part, double halo,
                                                                 bool halo_in_edges, std::uint64_t memory,
                                                                 unsigned threads, bool resume, nb::handle progress) {
  // A mesh that is read into memory takes several times the bytes of its file.
  constexpr std::uint64_t kMemoryPerByte = 4;
  const parts::PartitionOptions options{.parts = parts,
                                        .vertices_per_part = vertices_per_part,
                                        .halo = halo,
                                        .halo_in_edges = halo_in_edges,
                                        .memory = memory,
                                        .threads = threads,
                                        .resume = resume,
                                        .progress = progress_to(progress)};
  return without_lock([&] {
    const auto opened = faces ? parts::open_arrays(mesh, *faces) : parts::open_mesh(mesh, memory / kMemoryPerByte);
    parts::PartitionResult result = parts::partition(*opened, folder, options);
    return std::tuple(result.kept, std::move(result.warnings));
  });
}

nb::dict manifest_of(const Path& folder) {
  const parts::Manifest manifest = without_lock([&] { return parts::read_manifest(folder); });
  const parts::Plan& plan = manifest.plan;
  nb::list listed;
  for (const parts::Part& part : manifest.parts) {
    listed.append(nb::make_tuple(part.vertices, part.owned, part.faces));
  }
  nb::dict result;
  result["vertices"] = plan.vertices;
  result["faces"] = plan.faces;
  result["content_hash"] = to_text(plan.content_hash);
  result["mean_edge_length"] = plan.mean_edge_length;
  result["halo"] = plan.halo;
  result["parts"] = listed;
  return result;
}

/// Returns the folder of the part.
Path verified_part(const Path& folder, std::size_t number, const std::string& content_hash) {
  return without_lock([&] {
    const parts::Manifest manifest = parts::read_manifest(folder);
    if (to_text(manifest.plan.content_hash) != content_hash || number >= manifest.parts.size()) {
      meshhood::raise(ErrorCode::MalformedIndex,
                      folder.string() + ": the parts of another mesh have replaced those that were opened");
    }
    Path part = folder / parts::part_name(number);
    parts::verify_part(part, manifest.parts[number]);
    return part;
  });
}

}  // namespace

void bind_parts(nb::module_& module) {
  module.def("partition", &partition_file, nb::arg("mesh"), nb::arg("faces").none(), nb::arg("folder"), nb::kw_only(),
             nb::arg("parts"), nb::arg("vertices_per_part"), nb::arg("halo"), nb::arg("halo_in_edges"),
             nb::arg("memory"), nb::arg("threads"), nb::arg("resume"), nb::arg("progress").none());
  module.def("read_manifest", &manifest_of, nb::arg("folder"));
  module.def("verified_part", &verified_part, nb::arg("folder"), nb::arg("number"), nb::arg("content_hash"));
}

}  // namespace meshhood::python
