// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "meshhood/meshhood.h"

#include "io/mesh_io.h"

namespace meshhood::wasm {

/// The numbers are part of the interface with JavaScript.
enum class Method : std::uint8_t { Exact, Paper, Bfs, Ball };

/// One mesh, its index, and what the methods need besides: the graph, the paper's index, searchers. Each part is made
/// when it is first used.
class Workspace {
 public:
  /// Replaces the mesh by that of a file. Throws as `io::read_mesh`.
  void read(std::span<const std::byte> file, const std::string& name, const io::ReadOptions& options);

  /// The mesh that was read.
  [[nodiscard]] const io::Mesh& mesh() const { return mesh_; }

  /// Replaces the index. Throws as `meshhood::build`.
  void build(const MeshView& mesh, const BuildOptions& options);

  /// Replaces the index by a saved one. Throws as `meshhood::load`.
  void load(std::span<const std::byte> bytes, const LoadOptions& options);

  /// There must be an index, as for all functions below.
  [[nodiscard]] const Index& index() const { return *index_; }

  /// The graph and the positions, in the numbering of the mesh.
  [[nodiscard]] const GraphData& graph();

  /// In the unit of the positions.
  [[nodiscard]] double mean_edge();

  /// Calls `f` with the searcher of `method`, and returns its result.
  template <class F>
  auto with_searcher(Method method, F&& f) {
    switch (method) {
      case Method::Exact: return f(exact());
      case Method::Paper: return f(paper());
      case Method::Bfs: return f(bfs());
      case Method::Ball: return f(ball());
    }
    __builtin_unreachable();
  }

  /// The method of a batch.
  [[nodiscard]] SearchMethod search_method(Method method);

 private:
  void replace_index(Index&& index);
  [[nodiscard]] const paper::Index& paper_index();
  [[nodiscard]] Searcher& exact();
  [[nodiscard]] paper::Searcher& paper();
  [[nodiscard]] ReferenceSearcher& bfs();
  [[nodiscard]] BallSearcher& ball();

  io::Mesh mesh_;
  std::optional<Index> index_;
  std::optional<GraphData> graph_;
  std::optional<double> mean_edge_;
  std::optional<paper::Index> paper_index_;
  std::optional<Searcher> exact_;
  std::optional<paper::Searcher> paper_;
  std::optional<ReferenceSearcher> bfs_;
  std::optional<BallSearcher> ball_;
};

}  // namespace meshhood::wasm
