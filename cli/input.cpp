// SPDX-License-Identifier: MIT
#include "input.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <filesystem>
#include <span>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "meshhood/error.h"

#include "io/index_io.h"
#include "output.h"
#include "progress.h"

namespace meshhood::cli {
namespace {

void complain_about(const io::Mesh& mesh, const std::string& file) {
  for (const io::Warning& warning : mesh.warnings) {
    const std::string times = warning.count == 1 ? "" : fmt::format("{} times, first ", warning.count);
    const std::string place = warning.first_place.empty() ? "" : " (" + times + "at " + warning.first_place + ")";
    print_error("warning: ", fmt::format("{}: {}{}", file, warning.what, place));
  }
}

/// In the numbering of the mesh.
PositionsData positions_of(const paper::Index& index) {
  return index.positions().visit([&](auto in_index_order) -> PositionsData {
    std::vector<typename decltype(in_index_order)::value_type> positions(in_index_order.size());
    const std::span<const VertexId> vertices = index.permutation();
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      std::copy_n(&in_index_order[3 * i], 3, &positions[std::size_t{3} * vertices[i]]);
    }
    return positions;
  });
}

/// What a reader tells, for the line on the terminal. Of a pipe it does not know how much there is.
auto on_progress(Progress& progress) {
  return [&progress](std::size_t done, std::size_t total) {
    if (total != 0) progress.report(done, total);
    return true;
  };
}

}  // namespace

Input::Input(std::string file) : name_(std::move(file)) {
  if (!io::is_index(name_)) {
    mesh_ = read_mesh(name_);
    return;
  }
  if (io::read_header(name_).kind == IndexKind::Paper) {
    paper_ = load_paper_index(name_);
  } else {
    exact_ = load_exact_index(name_);
  }
}

std::size_t Input::vertex_count() const {
  if (mesh_) return mesh_->view().positions.size();
  // One of the three is there. NOLINTNEXTLINE(bugprone-unchecked-optional-access)
  return exact_ ? exact_->vertex_count() : paper_->vertex_count();
}

void Input::need_edges(const std::string& purpose) const {
  if (mesh_ || exact_) return;
  raise(ErrorCode::InvalidOption,
        fmt::format("{}: {} needs the edges of the mesh, which an index of the paper does not keep", name_, purpose));
}

PositionsView Input::positions() {
  if (mesh_) return mesh_->view().positions;
  if (exact_) return graph().positions;
  if (!positions_) positions_ = positions_of(*paper_);  // NOLINT(bugprone-unchecked-optional-access): as above
  return std::visit([](const auto& xyz) { return PositionsView(xyz); }, *positions_);
}

GraphView Input::graph() {
  assert(mesh_ || exact_);
  if (mesh_) {
    if (!adjacency_) adjacency_ = adjacency(mesh_->view());
    return {mesh_->view().positions, adjacency_->view()};
  }
  if (!graph_) graph_ = meshhood::extract_graph(*exact_);
  return graph_->view();
}

MeshView Input::surface() {
  if (mesh_) return mesh_->view();
  print_error("warning: ", name_ + ": an index keeps no faces, so what is drawn of it are its vertices");
  return {positions(), FacesView{}};
}

const Index& Input::exact_index(unsigned threads) {
  if (!exact_) exact_ = build_exact_index(graph(), threads);
  return *exact_;
}

const paper::Index& Input::paper_index() {
  if (!paper_) paper_ = build_paper_index(graph());
  return *paper_;
}

io::Mesh read_mesh(const std::string& file) {
  Progress progress("reading " + file);
  io::Mesh mesh = io::read_mesh(file, {.progress = on_progress(progress)});
  complain_about(mesh, file);
  return mesh;
}

Index load_exact_index(const std::string& file) {
  Progress progress("reading " + file);
  return io::load(file, {.progress = on_progress(progress)});
}

paper::Index load_paper_index(const std::string& file) {
  Progress progress("reading " + file);
  return io::load_paper(file, {.progress = on_progress(progress)});
}

void refuse_same_file(const std::string& input, const std::string& output) {
  std::error_code missing;
  if (std::filesystem::equivalent(input, output, missing)) {
    raise(ErrorCode::InvalidOption, output + ": " + input + " would be overwritten; name another file for the output");
  }
}

}  // namespace meshhood::cli
