// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include <CLI/CLI.hpp>

#include "meshhood/mesh.h"

#include "input.h"

namespace meshhood::cli {

/// Refuses the empty name, which is what a shell makes of a variable that is not set.
[[nodiscard]] CLI::Validator file_name();

/// Adds FILE, a mesh or an index, to `command`; it ends up in `file`, which must outlive it. So do the options below.
void add_file(CLI::App& command, std::string& file);

/// Adds MESH, a mesh alone.
void add_mesh(CLI::App& command, std::string& file);

/// Adds --output, a file to write. May be left out unless it is made required.
CLI::Option* add_output(CLI::App& command, std::string& file, const std::string& description);

/// Adds --threads.
void add_threads(CLI::App& command, unsigned& threads);

/// A radius as it was typed.
struct Radius {
  std::string value;
  std::string unit = "mesh";
};

/// Adds --radius and --unit.
void add_radius(CLI::App& command, Radius& radius);

/// In the unit of the positions. Throws Error{InvalidRadius, InvalidOption}.
[[nodiscard]] double resolve(const Radius& radius, Input& input);

/// FILE, a vertex and a radius.
struct QueryArguments {
  std::string file;
  std::uint64_t vertex = 0;
  Radius radius;
};

/// Adds FILE, --vertex, --radius and --unit.
void add_query_arguments(CLI::App& command, QueryArguments& arguments);

/// What the library is asked: a radius in the unit of the positions.
struct Query {
  VertexId vertex;
  double radius;
};

/// Throws Error{VertexOutOfRange, InvalidRadius, InvalidOption}.
[[nodiscard]] Query resolve(const QueryArguments& arguments, Input& input);

/// Accepts decimal digits alone, for a number up to `most`: CLI11 would read 010 as 8, and 2^64 as the largest number
/// there is.
[[nodiscard]] CLI::Validator whole_number(std::uint64_t most = std::numeric_limits<std::uint64_t>::max());

}  // namespace meshhood::cli
