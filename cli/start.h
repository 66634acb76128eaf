// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "meshhood/filter.h"
#include "meshhood/start.h"

#include "input.h"

/// The options of a query beyond vertex and radius: where it starts, what it may pass, and how it measures lengths.
namespace meshhood::cli {

struct StartOptions {
  std::vector<std::string> point;
  std::vector<std::uint64_t> seeds;
  std::string metric = "straight";
  std::string walls;
  std::string ignored;

  [[nodiscard]] bool has_filter() const { return !walls.empty() || !ignored.empty(); }
  [[nodiscard]] bool is_along_edges() const { return metric == "path"; }

  /// --point. Throws Error{InvalidOption}.
  [[nodiscard]] SpacePoint center() const;

  /// Whether the query has none of these options.
  [[nodiscard]] bool is_plain() const { return point.empty() && !has_filter() && !is_along_edges(); }
};

/// --point, --seed, --metric, --walls and --ignored.
void add_start(CLI::App& command, StartOptions& options);

/// Throws Error{InvalidOption} if the options contradict each other or `method`.
void check_start_options(const StartOptions& options, const std::string& method, bool has_vertices);

/// The masks of a query, from files that list vertices.
class FilterMasks {
 public:
  FilterMasks(const StartOptions& options, const Input& input);

  [[nodiscard]] Filter filter() const { return {.walls = walls_, .ignored = ignored_}; }

 private:
  std::vector<std::uint8_t> walls_;
  std::vector<std::uint8_t> ignored_;
};

/// Where a search starts. Owns the seeds.
class QueryStart {
 public:
  explicit QueryStart(VertexId v) : vertex_(v) {}

  /// At --point, from --seed or else from the vertex nearest to the point. Throws Error{InvalidOption,
  /// VertexOutOfRange}.
  QueryStart(const StartOptions& options, Input& input);

  /// The vertex; none for --point.
  [[nodiscard]] std::optional<VertexId> vertex() const { return vertex_; }

  /// Borrows from this object.
  [[nodiscard]] Start view() const { return vertex_ ? Start(*vertex_) : Start(point_, seeds_); }

 private:
  std::optional<VertexId> vertex_;
  SpacePoint point_{};
  std::vector<VertexId> seeds_;
};

/// The starts of a command: that of --point, or those of its vertices.
[[nodiscard]] std::vector<QueryStart> starts_of(const StartOptions& options, std::span<const std::uint64_t> vertices,
                                                Input& input);

/// The start of a command that takes one. Throws Error{InvalidOption} if there are several vertices.
[[nodiscard]] QueryStart start_of(const StartOptions& options, std::span<const std::uint64_t> vertices, Input& input);

/// The answer to one query, ring by ring. With one radius there is one ring.
struct StartAnswer {
  std::vector<VertexId> vertices;   ///< ascending within each ring
  std::vector<double> distances;    ///< of `vertices`
  std::vector<std::size_t> counts;  ///< the first `counts[i]` vertices are within radius `i`
};

/// The regions of a start for ascending `radii`, at least one, as the rings of `RegionSearcher::nested`; with --metric
/// path the vertices whose path distance is at most each radius.
[[nodiscard]] StartAnswer regions_of(const StartOptions& options, const QueryStart& start,
                                     std::span<const double> radii, Input& input);

/// The vertices that at most `k` edges separate from vertex `v`, all as one ring, with the number of these edges.
[[nodiscard]] StartAnswer rings_of(const StartOptions& options, VertexId v, std::size_t k, Input& input);

}  // namespace meshhood::cli
