// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "meshhood/meshhood.h"

namespace meshhood::wasm {

/// The numbers are part of the interface with JavaScript.
enum class MethodName : std::uint8_t { Exact, Paper, Bfs, Ball };

inline constexpr std::size_t kMethodCount = 4;
inline constexpr std::size_t kMetricCount = static_cast<std::size_t>(Metric::Space) + 1;

/// Of calls; the first are those of `Metric`. Along the surface: by the paths of another index (see `surface_paths`).
enum class MetricName : std::uint8_t { Straight, Path, Rings, Space, Surface };

/// What 32 bits address, but for the last page.
inline constexpr std::uint64_t kMostBytes = (std::uint64_t{1} << 32) - (1 << 16);

/// A method, and a searcher for single queries, made when it is first used; those of the exact method are `by_metric`.
struct Method {
  SearchMethod search;
  std::optional<AnySearcher> searcher;
};

/// The searches of an index, each made when it is first used.
struct Searches {
  std::optional<Index> index;  // with masks, or along the surface; none: that of the workspace
  std::array<std::optional<Method>, kMethodCount> methods;  // by their names
  std::array<std::optional<Searcher>, kMetricCount> by_metric;
  std::optional<Surface> surface;
  std::optional<PatchSearcher> patches;
};

/// One mesh, its index, and what the methods need besides: the graph, the paper's index, searchers. Each part is made
/// when it is first used.
class Workspace {
 public:
  void replace_index(Index&& index);

  /// Moves the vertices `changed`, or all. Throws as `meshhood::refit`; the index is then as it was.
  void refit(const PositionsView& positions, const std::optional<IndicesView>& changed);

  /// Sets the masks of the searches that follow; none if both are empty. The index of the last masks is kept.
  void set_masks(std::span<const std::uint8_t> walls, std::span<const std::uint8_t> ignored);

  /// Sets whether the paths of the searches that follow are those along the surface. There must be faces.
  void search_along_surface(bool is_along_surface);

  /// There must be an index, as for all functions below.
  [[nodiscard]] const Index& index() const { return *index_; }

  /// The same with the masks, along the surface if these are the paths.
  [[nodiscard]] const Index& searched() { return searches().index ? *searches().index : *index_; }

  /// The graph and the positions, in the numbering of the mesh.
  [[nodiscard]] const GraphData& graph();

  /// In the unit of the positions.
  [[nodiscard]] double mean_edge();

  /// How long calls run: with the most bytes that a result can have beside the index. Larger results are refused before
  /// memory is out, which would end the instance.
  [[nodiscard]] Run run() const { return {.max_bytes = kMostBytes - index().bytes().total()}; }

  // Of the index that is searched:

  [[nodiscard]] const SearchMethod& method(MethodName name);
  [[nodiscard]] AnySearcher& searcher(MethodName name);
  [[nodiscard]] Searcher& searcher(Metric metric);

  /// Makes the surface of faces; nothing is done if `content`, a hash of the faces, is that of the faces before.
  /// Throws as `Surface`.
  void use_faces(const FacesView& faces, const Fingerprint& content);

  /// Throws as `Surface::of_normals`.
  void use_normals(std::span<const double> normals);

  /// Of the last `use_...`, on the index that is searched.
  [[nodiscard]] const Surface& surface();
  [[nodiscard]] PatchSearcher& patch_searcher();

 private:
  void forget_derived();
  void forget_surfaces();
  [[nodiscard]] const paper::Index& paper_index();
  [[nodiscard]] SearchMethod make_method(MethodName name);
  [[nodiscard]] Method& kept_method(MethodName name);
  [[nodiscard]] Searches& searches() { return searches_[is_along_surface_ ? 1 : 0][has_masks_ ? 1 : 0]; }

  std::optional<Index> index_;
  std::optional<GraphData> graph_;
  std::optional<double> mean_edge_;
  std::optional<paper::Index> paper_index_;
  std::array<std::array<Searches, 2>, 2> searches_;  // along edges and along the surface, without and with masks
  bool has_masks_ = false;
  bool is_along_surface_ = false;
  std::vector<std::uint8_t> walls_;  // of the searches with masks
  std::vector<std::uint8_t> ignored_;
  std::optional<Surface> surface_;
  std::optional<Fingerprint> faces_;  // those of `surface_`, if it was made from faces
};

/// One for each instance of the module, which has one thread.
inline Workspace workspace;

}  // namespace meshhood::wasm
