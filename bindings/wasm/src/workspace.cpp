// SPDX-License-Identifier: MIT
#include "workspace.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "meshhood/error.h"

namespace meshhood::wasm {

void Workspace::refit(const PositionsView& positions, const std::optional<IndicesView>& changed) {
  if (changed) {
    index_->refit_in_place(positions, *changed);
  } else {
    index_->refit_in_place(positions);
  }
  // Only now: where arguments are refused, a call ends without destructors, and what it had taken would be lost.
  std::optional<Surface> surface = faces_ ? std::exchange(surface_, {}) : std::nullopt;
  const std::optional<Fingerprint> faces = faces_;
  forget_derived();
  if (surface && changed) {
    surface->refit_in_place(*index_, *changed);
  } else if (surface) {
    surface->refit_in_place(*index_);
  }
  surface_ = std::move(surface);
  faces_ = faces;
}

void Workspace::replace_index(Index&& index) {
  forget_derived();
  index_ = std::move(index);
}

void Workspace::forget_derived() {
  faces_.reset();
  surface_.reset();
  searches_ = {};
  has_masks_ = false;
  is_along_surface_ = false;
  paper_index_.reset();
  mean_edge_.reset();
  graph_.reset();
}

void Workspace::forget_surfaces() {
  faces_.reset();
  is_along_surface_ = false;
  for (Searches& along_edges : searches_[0]) {
    along_edges.patches.reset();
    along_edges.surface.reset();
  }
  searches_[1] = {};
}

void Workspace::set_masks(std::span<const std::uint8_t> walls, std::span<const std::uint8_t> ignored) {
  has_masks_ = is_along_surface_ = false;  // if this throws
  if (walls.empty() && ignored.empty()) return;
  Searches& kept = searches_[0][1];
  if (!kept.index || !std::ranges::equal(walls_, walls) || !std::ranges::equal(ignored_, ignored)) {
    kept = {};
    searches_[1][1] = {};
    walls_.assign(walls.begin(), walls.end());
    ignored_.assign(ignored.begin(), ignored.end());
    kept.index = masked(*index_, {.walls = walls_, .ignored = ignored_});
  }
  has_masks_ = true;
}

void Workspace::search_along_surface(bool is_along_surface) {
  is_along_surface_ = false;
  if (!is_along_surface) return;
  std::optional<Index>& along_surface = searches_[1][has_masks_ ? 1 : 0].index;
  if (!along_surface) along_surface = surface_paths(surface());
  is_along_surface_ = true;
}

const GraphData& Workspace::graph() {
  if (!graph_) graph_ = extract_graph(index());
  return *graph_;
}

double Workspace::mean_edge() {
  if (!mean_edge_) mean_edge_ = mean_edge_length(graph().view());
  return *mean_edge_;
}

const paper::Index& Workspace::paper_index() {
  if (!paper_index_) paper_index_ = paper::build(graph().view());
  return *paper_index_;
}

SearchMethod Workspace::make_method(MethodName name) {
  if (has_masks_ && (name == MethodName::Paper || name == MethodName::Bfs)) {
    raise(ErrorCode::InvalidOption, std::string(name == MethodName::Paper ? "method: 'paper'" : "method: 'bfs'") +
                                        ", expected 'exact' or 'ball' with walls or ignored vertices");
  }
  switch (name) {
    case MethodName::Exact: return searched();
    case MethodName::Paper: return paper_index();
    case MethodName::Bfs: return SearchMethod::breadth_first(graph().view());
    case MethodName::Ball: return SearchMethod(searched()).by(Metric::Space);
  }
  __builtin_unreachable();
}

Method& Workspace::kept_method(MethodName name) {
  std::optional<Method>& method = searches().methods[static_cast<std::size_t>(name)];
  if (!method) method.emplace(Method{.search = make_method(name), .searcher = {}});
  return *method;
}

const SearchMethod& Workspace::method(MethodName name) { return kept_method(name).search; }

AnySearcher& Workspace::searcher(MethodName name) {
  Method& method = kept_method(name);
  if (!method.searcher) method.searcher = method.search.make_searcher();
  return *method.searcher;
}

Searcher& Workspace::searcher(Metric metric) {
  std::optional<Searcher>& searcher = searches().by_metric[static_cast<std::size_t>(metric)];
  if (!searcher) searcher.emplace(searched(), metric);
  return *searcher;
}

const Surface& Workspace::surface() {
  std::optional<Surface>& surface = searches().surface;
  if (!surface) surface = surface_->on(searched());
  return *surface;
}

PatchSearcher& Workspace::patch_searcher() {
  std::optional<PatchSearcher>& searcher = searches().patches;
  if (!searcher) searcher.emplace(surface());
  return *searcher;
}

void Workspace::use_faces(const FacesView& faces, const Fingerprint& content) {
  if (faces_ == content) return;
  forget_surfaces();
  surface_.emplace(index(), faces);
  faces_ = content;
}

void Workspace::use_normals(std::span<const double> normals) {
  forget_surfaces();
  surface_ = Surface::of_normals(index(), normals);
}

}  // namespace meshhood::wasm
