// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
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
  [[nodiscard]] bool is_along_edges() const { return metric == "edge"; }

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
  FilterMasks(const StartOptions& options, std::size_t vertices);

  [[nodiscard]] Filter filter() const { return {.walls = walls_, .ignored = ignored_}; }

 private:
  std::vector<std::uint8_t> walls_;
  std::vector<std::uint8_t> ignored_;
};

/// The answer to one query, ascending by vertex.
struct StartAnswer {
  std::vector<VertexId> vertices;
  std::vector<double> distances;
};

/// The region of --point.
[[nodiscard]] StartAnswer region_of_point(const StartOptions& options, double radius, Input& input);

/// The region of a vertex; with --metric edge the vertices whose path distance is at most the radius.
[[nodiscard]] StartAnswer region_of_vertex(const StartOptions& options, VertexId v, double radius, Input& input);

}  // namespace meshhood::cli
