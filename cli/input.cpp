// SPDX-License-Identifier: MIT
#include "input.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "meshhood/error.h"

#include "io/byte_source.h"
#include "io/input.h"
#include "io/number.h"
#include "io/text.h"
#include "output.h"
#include "task.h"

namespace meshhood::cli {
namespace {

constexpr Unit kMegabytes{"MB", 1e6};

std::string reading(const std::string& file) { return "reading " + file; }

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

VertexId parse_vertex(const io::Text& text, std::string_view token, std::size_t vertices) {
  const std::uint64_t vertex = io::parse_count(token).value_or(vertices);
  if (vertex < vertices) return static_cast<VertexId>(vertex);
  const std::string expected =
      vertices == 0 ? "no vertex: the mesh has none" : fmt::format("a vertex from 0 to {}", vertices - 1);
  text.fail(ErrorCode::InvalidOption, fmt::format("{}, expected {}", io::quote(token), expected));
}

/// Calls `parse(token)` for the only token of each line that is not blank.
template <class Parse>
void for_each_line(io::Text& text, Parse&& parse) {
  while (text.next_line()) {
    const std::string_view token = text.token_on_line();
    if (token.empty()) continue;
    parse(token);
    if (const std::string_view second = text.token_on_line(); !second.empty()) {
      text.fail(ErrorCode::InvalidOption, fmt::format("{}, expected the end of the line", io::quote(second)));
    }
  }
}

/// Calls `read(text)` for a text file. A malformed list is a wrong option, not a wrong mesh.
template <class Read>
auto read_list(const std::string& file, Read&& read) {
  io::FileSource source(file);
  io::Input input(source, file, io::ReadOptions{}.max_bytes);
  io::Text text(input, {.hash_comments = true});
  try {
    return read(text);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::MalformedFile) throw;
    raise(ErrorCode::InvalidOption, error.what());
  }
}

}  // namespace

Input::Input(std::string file) : name_(std::move(file)) {
  auto content = [this] {
    Task task(reading(name_), kMegabytes);
    return io::read_mesh_or_index(name_, {.progress = task.progress()});
  }();
  if (auto* mesh = std::get_if<io::Mesh>(&content)) {
    mesh_ = std::move(*mesh);
    print_warnings(*mesh_, name_);
    return;
  }
  auto& loaded = std::get<io::LoadedIndex>(content);
  header_ = loaded.header;
  if (auto* exact = std::get_if<Index>(&loaded.index)) exact_ = std::move(*exact);
  if (auto* paper = std::get_if<paper::Index>(&loaded.index)) paper_ = std::move(*paper);
}

std::size_t Input::vertex_count() const {
  return mesh_ ? mesh_->view().positions.size() : static_cast<std::size_t>(header().vertices);
}

void Input::need_edges(const std::string& purpose) const {
  if (mesh_ || exact_) return;
  raise(ErrorCode::InvalidOption,
        fmt::format("{}: {} needs the edges of the mesh, which an index of the paper does not "
                    "contain; name the mesh or an exact index",
                    printable_name(name_), purpose));
}

PositionsView Input::positions() {
  if (mesh_) return mesh_->view().positions;
  if (exact_) return graph().positions;
  if (!positions_) positions_ = positions_of(*paper_);  // NOLINT(bugprone-unchecked-optional-access): one is set
  return std::visit([](const auto& xyz) { return PositionsView(xyz); }, *positions_);
}

Fingerprint Input::fingerprint() { return header_ ? header_->mesh : meshhood::fingerprint(graph()); }

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
  print_error("warning: ", name_ + ": an index has no faces, so the picture has only vertices");
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
  io::Mesh mesh = [&] {
    Task task(reading(file), kMegabytes);
    return io::read_mesh(file, {.progress = task.progress()});
  }();
  print_warnings(mesh, file);
  return mesh;
}

io::LoadedIndex load_index(const std::string& file) {
  Task task(reading(file), kMegabytes);
  return io::load_any(file, {.progress = task.progress()});
}

std::vector<VertexId> read_vertex_list(const std::string& file, std::size_t vertices) {
  return read_list(file, [&](io::Text& text) {
    std::vector<VertexId> list;
    for_each_line(text, [&](std::string_view token) { list.push_back(parse_vertex(text, token, vertices)); });
    return list;
  });
}

std::vector<float> read_values(const std::string& file, std::size_t vertices) {
  return read_list(file, [&](io::Text& text) {
    std::vector<float> values;
    for_each_line(text, [&](std::string_view token) {
      const auto value = io::parse_real<float>(token);
      if (!value) text.fail(ErrorCode::InvalidOption, fmt::format("{}, expected a number", io::quote(token)));
      values.push_back(*value);
    });
    if (values.size() == vertices) return values;
    raise(ErrorCode::InvalidOption,
          fmt::format("{}: {} values, but the mesh has {} vertices", printable_name(file), values.size(), vertices));
  });
}

template <class Mesh>
Index build_exact_index(const Mesh& mesh, unsigned threads) {
  Task task("building the index");
  return build(mesh, {.threads = threads, .progress = task.progress()});
}

template <class Mesh>
paper::Index build_paper_index(const Mesh& mesh) {
  Task task("building the index of the paper");
  return paper::build(mesh, {.progress = task.progress()});
}

template Index build_exact_index(const MeshView& mesh, unsigned threads);
template Index build_exact_index(const GraphView& graph, unsigned threads);
template paper::Index build_paper_index(const MeshView& mesh);
template paper::Index build_paper_index(const GraphView& graph);

}  // namespace meshhood::cli
