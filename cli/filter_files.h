// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "meshhood/filter.h"

#include "input.h"

/// The walls and the ignored vertices of a command, from files that list them.
namespace meshhood::cli {

/// The names of the files; "" without.
struct FilterFiles {
  std::string walls;
  std::string ignored;

  [[nodiscard]] bool empty() const { return walls.empty() && ignored.empty(); }
};

/// --walls and --ignored.
void add_filter(CLI::App& command, FilterFiles& files);

/// The masks that the files describe.
class FilterMasks {
 public:
  /// Throws as `read_vertex_list`.
  FilterMasks(const FilterFiles& files, const Input& input);

  /// Borrows from this object.
  [[nodiscard]] Filter filter() const { return {.walls = walls_, .ignored = ignored_}; }

  /// Ignores the vertices that have become others, which are still at their places.
  void ignore_welded(const Welding& welding);

  /// The number of vertices in each mask.
  [[nodiscard]] std::size_t wall_count() const;
  [[nodiscard]] std::size_t ignored_count() const;

 private:
  std::vector<std::uint8_t> walls_;
  std::vector<std::uint8_t> ignored_;
};

}  // namespace meshhood::cli
