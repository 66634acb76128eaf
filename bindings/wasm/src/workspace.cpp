// SPDX-License-Identifier: MIT
#include "workspace.h"

#include <utility>

namespace meshhood::wasm {

void Workspace::read(std::span<const std::byte> file, const std::string& name, const io::ReadOptions& options) {
  mesh_ = io::read_mesh(file, name, options);
}

void Workspace::build(const MeshView& mesh, const BuildOptions& options) {
  replace_index(meshhood::build(mesh, options));
}

void Workspace::load(std::span<const std::byte> bytes, const LoadOptions& options) {
  replace_index(meshhood::load(bytes, options));
}

void Workspace::replace_index(Index&& index) {
  ball_.reset();
  bfs_.reset();
  paper_.reset();
  exact_.reset();
  paper_index_.reset();
  mean_edge_.reset();
  graph_.reset();
  index_ = std::move(index);
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

Searcher& Workspace::exact() {
  if (!exact_) exact_.emplace(index());
  return *exact_;
}

paper::Searcher& Workspace::paper() {
  if (!paper_) paper_.emplace(paper_index());
  return *paper_;
}

ReferenceSearcher& Workspace::bfs() {
  if (!bfs_) bfs_.emplace(graph().view());
  return *bfs_;
}

BallSearcher& Workspace::ball() {
  if (!ball_) ball_.emplace(graph().view().positions);
  return *ball_;
}

SearchMethod Workspace::search_method(Method method) {
  switch (method) {
    case Method::Exact: return index();
    case Method::Paper: return paper_index();
    case Method::Bfs: return SearchMethod::breadth_first(graph().view());
    case Method::Ball: return SearchMethod::ball_scan(graph().view().positions);
  }
  __builtin_unreachable();
}

}  // namespace meshhood::wasm
