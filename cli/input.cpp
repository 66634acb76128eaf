// SPDX-License-Identifier: MIT
#include "input.h"

#include <filesystem>
#include <system_error>
#include <utility>

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
    complain("warning: ", fmt::format("{}: {}{}", file, warning.what, place));
  }
}

}  // namespace

Input::Input(std::string file) : name_(std::move(file)) {
  if (io::is_index(name_)) {
    const Progress progress("reading " + name_);
    exact_ = io::load(name_);
  } else {
    mesh_ = read_mesh(name_);
  }
}

std::size_t Input::vertex_count() const { return mesh_ ? mesh_->view().positions.size() : exact_->vertex_count(); }

PositionsView Input::positions() {
  if (mesh_) return mesh_->view().positions;
  return graph().positions;
}

GraphView Input::graph() {
  if (mesh_) {
    if (!adjacency_) adjacency_ = adjacency(mesh_->view());
    return {mesh_->view().positions, adjacency_->view()};
  }
  if (!graph_) graph_ = meshhood::graph(*exact_);
  return graph_->view();
}

MeshView Input::surface() {
  if (mesh_) return mesh_->view();
  complain("warning: ", name_ + ": an index keeps no faces, so what is drawn of it are its vertices");
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
  const Progress progress("reading " + file);
  io::Mesh mesh = io::read_mesh(file);
  complain_about(mesh, file);
  return mesh;
}

void refuse_same_file(const std::string& input, const std::string& output) {
  std::error_code missing;
  if (std::filesystem::equivalent(input, output, missing)) {
    raise(ErrorCode::InvalidOption, output + ": " + input + " would be overwritten; name another file for the output");
  }
}

}  // namespace meshhood::cli
