// SPDX-License-Identifier: MIT
#include "input.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "meshhood/error.h"
#include "meshhood/masks.h"

#include "io/messages.h"
#include "io/number.h"
#include "io/weld.h"
#include "output.h"
#include "parts/manifest.h"
#include "program.h"
#include "system.h"

namespace meshhood::cli {
namespace {

constexpr Unit kMegabytes{"MB", 1e6};

/// The readers would say that it is a directory.
void refuse_parts(const std::string& file) {
  std::error_code none;
  const std::filesystem::path folder = path_of(file);
  if (!std::filesystem::is_regular_file(folder / parts::kManifestFile, none)) return;
  wrong_option(
      "{}: is a folder of parts; name the index of one, such as {}, whose vertices.npy has the numbers of "
      "its vertices, or use meshhood.open_parts of the Python package for all",
      printable_name(file), printable_name((folder / "part-00000" / "index.mhi").generic_string()));
}

OtherReader other_reader;

io::Mesh mesh_of(const OtherFile& other, const std::string& file, const io::ReadOptions& options) {
  io::Mesh mesh = io::read_mesh(std::as_bytes(std::span(other.ply)), file, options);
  mesh.format = io::Format::Other;
  // Those with a place in the PLY file are among the notes.
  std::erase_if(mesh.warnings, [](const io::Warning& warning) { return !warning.first_place.empty(); });
  for (const std::string& note : other.notes) mesh.warnings.push_back({.what = note, .first_place = {}});
  return mesh;
}

/// Calls `read`, and for a file that it refuses the other reader.
template <class Content>
Content read_with(Content (*read)(const std::filesystem::path&, const io::ReadOptions&), const Reading& reading,
                  io::ReadOptions options) {
  const std::string& file = reading.file;
  refuse_parts(file);
  Task task("reading " + file, kMegabytes);
  options.progress = task.progress();
  if (!reading.precision.empty()) {
    options.precision = reading.precision == "float" ? io::Precision::Float : io::Precision::Double;
  }
  try {
    return read(path_of(file), options);
  } catch (const Error& refusal) {
    if (refusal.code() != ErrorCode::UnsupportedFormat || !other_reader) throw;
    const std::optional<OtherFile> other = other_reader(file);
    if (!other) throw;
    return mesh_of(*other, file, options);
  }
}

/// An index says itself how its mesh was read.
void refuse_to_read_otherwise(const Reading& reading) {
  for (const auto& [value, option, advice] : {std::array<std::string_view, 3>{reading.weld, "--weld", "weld the mesh"},
                                              {reading.precision, "--precision", "choose it"}}) {
    if (value.empty()) continue;
    wrong_option("{}: {} is an index; {} when the index is built", option, printable_name(reading.file), advice);
  }
}

void print_warnings(const io::Mesh& mesh, const std::string& file) {
  for (const io::Warning& warning : mesh.warnings) {
    const std::string times = warning.count == 1 ? "" : fmt::format("{} times, first ", warning.count);
    const std::string location = warning.first_place.empty() ? "" : " (" + times + "at " + warning.first_place + ")";
    print_error("warning: ", fmt::format("{}: {}{}", file, warning.what, location));
  }
}

/// In the numbering of the mesh.
PositionsData positions_of(const paper::Index& index) {
  return index.positions().visit([&]<class Real>(const StridedPositions<Real>& strided) -> PositionsData {
    const std::span<const Real> in_index_order = strided.packed();
    std::vector<Real> positions(in_index_order.size());
    const std::span<const VertexId> vertices = index.permutation();
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      std::copy_n(&in_index_order[3 * i], 3, &positions[std::size_t{3} * vertices[i]]);
    }
    return positions;
  });
}

/// As `kept_vertices` of a mesh, whose walls are kept: they have no position, and are where the first vertex that has
/// one is.
std::vector<VertexId> kept_of_mesh(const io::Mesh& mesh, double eps) {
  std::vector<VertexId> kept = kept_vertices(mesh.view().positions, eps);
  const auto first = static_cast<VertexId>(std::ranges::find(mesh.walls, 0) - mesh.walls.begin());
  for (VertexId v = 0; v < mesh.walls.size(); ++v) {
    if (mesh.walls[v] != 0) {
      kept[v] = v;
    } else if (mesh.walls[kept[v]] != 0) {
      kept[v] = first;
    }
  }
  return kept;
}

}  // namespace

double eps_of(const std::string& weld) {
  if (const auto number = io::parse_real<double>(weld)) return *number;
  wrong_option("--weld={}, expected a finite number >= 0", io::quote(weld));
}

std::string rounding_eps(double mean_edge) { return fmt::format("{:.1g}", mean_edge / 1000); }

std::vector<VertexId> kept_vertices(const PositionsView& positions, double eps) {
  std::vector<VertexId> kept = io::welded_ids(positions, eps);
  std::vector<VertexId> first;
  for (std::size_t v = 0; v < kept.size(); ++v) {
    if (kept[v] == first.size()) first.push_back(static_cast<VertexId>(v));
    kept[v] = first[kept[v]];
  }
  return kept;
}

Welding::Welding(io::Mesh& mesh, const std::string& weld, const std::string& file) {
  if (weld.empty()) return;
  kept_ = kept_of_mesh(mesh, eps_of(weld));
  for (std::uint32_t& corner : mesh.corners) corner = kept_[corner];
  for (std::size_t v = 0; v < kept_.size(); ++v) count_ += kept_[v] == v ? 0 : 1;
  print_error("note: ",
              fmt::format("{}: {} of {} vertices welded; all keep their numbers", file, count_, kept_.size()));
}

void read_others_by(OtherReader reader) { other_reader = std::move(reader); }

bool reads_others() { return other_reader != nullptr; }

Input::Input(const Reading& reading, unsigned threads) : name_(reading.file) {
  auto content = read_with(io::read_mesh_or_index, reading, {.threads = threads});
  if (auto* mesh = std::get_if<io::Mesh>(&content)) {
    mesh_ = std::move(*mesh);
    print_warnings(*mesh_, name_);
    masks_.walls = mesh_->walls;
    welding_ = Welding(*mesh_, reading.weld, name_);
    return;
  }
  refuse_to_read_otherwise(reading);
  auto& loaded = std::get<io::LoadedIndex>(content);
  header_ = loaded.header;
  if (auto* exact = std::get_if<Index>(&loaded.index)) exact_ = std::move(*exact);
  if (auto* paper = std::get_if<paper::Index>(&loaded.index)) paper_ = std::move(*paper);
#ifndef MESHHOOD_DEMO  // which knows no parts
  // The index of a part is known by its own name, also behind a link or standard input.
  std::error_code missing;
  const auto path = std::filesystem::canonical(path_of(name_), missing);
  if (path.filename() == parts::kIndexFile) plan_ = parts::read_plan(path.parent_path());
#endif
}

std::string Input::other_as_ply() const {
  if (!mesh_ || mesh_->format != io::Format::Other) return {};
  const std::optional<OtherFile> other = other_reader(name_);
  if (!other) raise(ErrorCode::IoFailure, name_ + ": has changed since it was read, expected the same mesh");
  return other->ply;
}

void Input::need_halo(double radius) const {
  if (!plan_ || radius <= plan_->halo) return;
  raise(ErrorCode::InvalidRadius,
        fmt::format("{}: the radius {} is larger than the halo {} of these parts{}", printable_name(name_), radius,
                    plan_->halo, std::isinf(radius) ? "" : fmt::format("; partition the mesh with --halo {}", radius)));
}

std::size_t Input::vertex_count() const {
  return mesh_ ? mesh_->view().positions.size() : static_cast<std::size_t>(header().vertices);
}

void Input::need_edges(const std::string& purpose) const {
  if (mesh_ || exact_) return;
  wrong_option(
      "{}: {} needs the edges of the mesh, which an index of the paper does not "
      "contain; name the mesh or an exact index",
      printable_name(name_), purpose);
}

void Input::need_faces(const std::string& purpose) const {
  if (mesh_ || (exact_ && exact_->faces())) return;
  wrong_option(
      "{}: {} needs the faces of the mesh, which this index does not contain; name the mesh, or an index "
      "that was built with --faces",
      printable_name(name_), purpose);
}

PositionsView Input::positions() {
  if (mesh_) return mesh_->view().positions;
  if (exact_) return graph().positions;
  if (!positions_) positions_ = positions_of(*paper_);
  return std::visit([](const auto& xyz) { return PositionsView(xyz); }, *positions_);
}

const std::vector<VertexId>& Input::first_at_position() {
  if (!first_at_position_) first_at_position_ = kept_vertices(positions(), 0);
  return *first_at_position_;
}

GraphView Input::graph() {
  assert(mesh_ || exact_);
  if (mesh_) {
    if (!adjacency_) adjacency_ = adjacency(mesh_->view());
    return {mesh_->view().positions, adjacency_->view()};
  }
  if (!graph_) graph_ = extract_graph(*exact_);
  return graph_->view();
}

MeshView Input::surface() {
  if (mesh_) return mesh_->view();
  if (exact_ && exact_->faces()) return {positions(), *exact_->faces()};
  print_error("warning: ", name_ + ": this index has no faces, so the picture has only vertices");
  return {positions(), FacesView{}};
}

void Input::set_masks(OwnedMasks masks) {
  masks_ = std::move(masks);
  if (!mesh_ || mesh_->walls.empty()) return;
  masks_.walls.resize(mesh_->walls.size());
  std::transform(masks_.walls.begin(), masks_.walls.end(), mesh_->walls.begin(), masks_.walls.begin(), std::bit_or<>());
}

void Input::need_positions(const std::string& method) const {
  if (!mesh_ || mesh_->walls.empty()) return;
  wrong_option(
      "{}: has vertices without a position, which are walls: {} does not pass them by; expected --method "
      "exact or ball",
      printable_name(name_), method);
}

void Input::ignore_welded() {
  if (welding_.count() == 0) return;
  masks_.ignored.resize(vertex_count());
  for (VertexId v = 0; v < masks_.ignored.size(); ++v) {
    masks_.ignored[v] |= static_cast<std::uint8_t>(welding_.kept(v) != v);
  }
}

std::span<const std::uint8_t> Input::unplaced() const {
  return mesh_ ? std::span<const std::uint8_t>(mesh_->walls) : std::span<const std::uint8_t>();
}

void Input::change_index(std::function<Index(const Index& index, unsigned threads)> change) {
  change_ = std::move(change);
}

const Index& Input::exact_index(unsigned threads) {
  if (!exact_) {
    exact_ = mesh_ && !adjacency_ ? build_exact_index(mesh_->view(), threads) : build_exact_index(graph(), threads);
  }
  if (has_masks() && !masked_) {
    masked_ = meshhood::masked(*exact_, {.walls = masks_.walls, .ignored = masks_.ignored}, {.threads = threads});
  }
  const Index& index = has_masks() ? *masked_ : *exact_;
  if (!change_) return index;
  if (!changed_) changed_ = change_(index, threads);
  return *changed_;
}

const paper::Index& Input::paper_index() {
  if (!paper_) paper_ = build_paper_index(graph());
  return *paper_;
}

io::Mesh read_mesh(const Reading& reading, unsigned threads, std::uint64_t max_bytes) {
  auto mesh = read_with<io::Mesh>(io::read_mesh, reading, {.threads = threads, .max_bytes = max_bytes});
  print_warnings(mesh, reading.file);
  return mesh;
}

io::LoadedIndex load_index(const std::string& file) {
  refuse_parts(file);
  Task task("reading " + file, kMegabytes);
  return io::load_any(path_of(file), {.progress = task.progress()});
}

std::string_view kind_name(IndexKind kind) { return kind == IndexKind::Exact ? "exact" : "paper"; }

}  // namespace meshhood::cli
