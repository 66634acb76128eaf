// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "meshhood/start.h"

#include "input.h"
#include "vertex_files.h"

/// The options of a query beyond vertex and radius: where it starts, and what it may pass.
namespace meshhood::cli {

/// --point.
CLI::Option* add_point(CLI::App& command, const std::string& description, std::vector<std::string>& point);

/// What was typed. Throws Error{InvalidOption}.
[[nodiscard]] SpacePoint parse_point(const std::vector<std::string>& point);

struct StartOptions {
  std::vector<std::string> vertices;  ///< numbers; or the name of standard input, for those that it lists
  std::vector<std::string> point;
  std::vector<std::uint64_t> seeds;
  MaskFiles masks;

  /// Whether there may be several answers.
  [[nodiscard]] bool is_list() const;

  /// Whether the query has none of these options.
  [[nodiscard]] bool is_plain() const { return point.empty() && masks.empty(); }
};

/// --vertex, with its description; `-` is a list on standard input. Also --point, --seed, --walls and
/// --ignored.
void add_start(CLI::App& command, const std::string& vertex, StartOptions& options);

/// Throws Error{InvalidOption} unless there is either a point, or a vertex, or several for a command that `takes_many`.
/// Rings take no point.
void check_start_options(const StartOptions& options, bool takes_many, const std::string& metric = "straight");

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

/// What these options mean for an input: the start of --point, or those of the vertices. Reads the lists, and sets the
/// masks of the input, as a search by `metric` takes them. Throws as `QueryStart`, `read_vertex_list` and `read_masks`.
[[nodiscard]] std::vector<QueryStart> starts_of(const StartOptions& options, const std::string& metric, Input& input);

/// The answer to one query, ring by ring. With one radius there is one ring.
struct Answer {
  std::optional<VertexId> vertex = {};   ///< none for --point
  std::vector<std::size_t> counts = {};  ///< for each radius: the first `counts[i]` vertices are within it
  std::vector<VertexId> vertices = {};   ///< each ring in an order of its own; empty if only their number is needed
  std::vector<double> distances = {};    ///< of `vertices`, if needed
};

/// Answers starts one after the other, in memory that it keeps.
class RegionSearch {
 public:
  RegionSearch(const std::string& metric, Input& input);

  /// The neighborhoods of a start for ascending `radii`, at least one, as the rings of `Searcher::nested`. By rings the
  /// start must be a vertex.
  [[nodiscard]] Answer regions(const QueryStart& start, std::span<const double> radii);

 private:
  PositionsView positions_;
  Searcher searcher_;
  std::vector<double> distance_of_;  // #V; `nested` returns no distances
};

}  // namespace meshhood::cli
