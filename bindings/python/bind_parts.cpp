// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "meshhood/error.h"
#include "meshhood/serialize.h"

#include "about.h"
#include "arrays.h"
#include "bindings.h"
#include "interpreter.h"
#include "io/mapped_file.h"
#include "io/mesh_io.h"
#include "io/messages.h"
#include "methods.h"
#include "parts/manifest.h"
#include "parts/partition.h"
#include "parts/random_file.h"

namespace nb = nanobind;

namespace meshhood::python {
namespace {

using Path = std::filesystem::path;

/// `ply`: what another library has read from the file of the mesh. Returns the warnings.
std::vector<std::string> partition_file(const Path& mesh, const std::optional<Path>& faces, const Path& folder,
                                        std::uint64_t parts, std::uint64_t vertices_per_part, double halo,
                                        bool halo_in_edges, std::uint64_t memory, unsigned threads, bool resume,
                                        const std::optional<nb::bytes>& ply, nb::handle progress) {
  const parts::PartitionOptions options{.parts = parts,
                                        .vertices_per_part = vertices_per_part,
                                        .halo = halo,
                                        .halo_in_edges = halo_in_edges,
                                        .memory = memory,
                                        .resume = resume};
  const Run run{.threads = threads, .progress = progress_to(progress)};
  const std::uint64_t most = memory / parts::kMemoryPerByte;
  const std::string_view bytes = ply ? std::string_view(ply->c_str(), ply->size()) : "";
  return without_lock([&] {
    const auto read = [&] {
      const io::ReadOptions reading{.max_bytes = most, .progress = run.progress};
      return parts::chunked(io::read_mesh(std::as_bytes(std::span(bytes)), mesh.string(), reading),
                            io::printable_name(mesh.string()));
    };
    const auto opened = faces ? parts::open_arrays(mesh, *faces)
                        : ply ? read()
                              : parts::open_mesh(mesh, most, run.progress);
    return parts::partition(*opened, folder, options, run).warnings;
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
  result["mean_edge_length"] = plan.mean_edge_length;
  result["halo"] = plan.halo;
  result["parts"] = listed;
  result["checksum"] = manifest.checksum;
  return result;
}

/// A part as the manifest describes it. Its files are verified as they are used, because another partition may replace
/// them at any time.
struct PartFiles {
  Path folder;
  parts::Part part;

  [[nodiscard]] const parts::PartFile& file(std::string_view name) const {
    const auto found =
        std::find_if(part.files.begin(), part.files.end(), [&](const auto& f) { return f.name == name; });
    if (found == part.files.end()) throw nb::key_error(std::string(name).c_str());
    return *found;
  }
};

/// As str. A path would be made by Python code, which must not run below functions that are noexcept.
nb::object folder_of(const PartFiles& files) {
  const std::string& name = files.folder.native();
  return nb::steal(PyUnicode_DecodeFSDefaultAndSize(name.data(), static_cast<Py_ssize_t>(name.size())));
}

/// `checksum`: of the manifest that was opened.
PartFiles part_files(const Path& folder, std::size_t number, std::uint64_t checksum) {
  parts::Manifest manifest = without_lock([&] { return parts::read_manifest(folder); });
  if (manifest.checksum != checksum || number >= manifest.parts.size()) {
    meshhood::raise(ErrorCode::MalformedIndex,
                    folder.string() + ": other parts have replaced those that were opened; open them again");
  }
  return {folder / parts::part_name(number), std::move(manifest.parts[number])};
}

/// The content of a file, verified. Only a plain file of the size in the manifest is read.
nb::bytes content_of(const PartFiles& files, const std::string& name) {
  const Path path = files.folder / name;
  const parts::PartFile& expected = files.file(name);
  const std::string content = without_lock([&] {
    const parts::RandomFile file(path);
    parts::verify_size(path, file.size(), expected);
    std::string bytes(static_cast<std::size_t>(file.size()), '\0');
    file.read(0, bytes);
    parts::verify_file(path, std::as_bytes(std::span(bytes)), expected);
    return bytes;
  });
  return nb::bytes(content.data(), content.size());
}

/// The index is mapped. What is verified is the mapping, which stays as it is when the file is replaced.
std::shared_ptr<ExactMethod> index_of(const PartFiles& files) {
  const Path path = files.folder / parts::kIndexFile;
  return without_lock([&] {
    const auto mapped = std::make_shared<const io::MappedFile>(path);
    parts::verify_file(path, mapped->bytes(), files.file(parts::kIndexFile));
    return about(path.c_str(), [&] { return exact_method(map(mapped->bytes(), mapped)); });
  });
}

}  // namespace

void bind_parts(nb::module_& module) {
  module.def("partition", &partition_file, nb::arg("mesh"), nb::arg("faces").none(), nb::arg("folder"), nb::kw_only(),
             nb::arg("parts"), nb::arg("vertices_per_part"), nb::arg("halo"), nb::arg("halo_in_edges"),
             nb::arg("memory"), nb::arg("threads"), nb::arg("resume"), nb::arg("ply").none(),
             nb::arg("progress").none());
  module.def("read_manifest", &manifest_of, nb::arg("folder"));
  nb::class_<PartFiles>(module, "PartFiles")
      .def_prop_ro("folder", &folder_of)
      .def_prop_ro("vertices", [](const PartFiles& files) { return files.part.vertices; })
      .def_prop_ro("owned", [](const PartFiles& files) { return files.part.owned; })
      .def("index", &index_of)
      .def("read", &content_of, nb::arg("name"));
  module.def("part_files", &part_files, nb::arg("folder"), nb::arg("number"), nb::arg("checksum"));
}

}  // namespace meshhood::python
