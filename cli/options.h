// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "meshhood/mesh.h"

#include "input.h"

/// The options that several commands share. Each `add_` function stores the value in its last argument, which must
/// outlive the command.
namespace meshhood::cli {

/// Refuses an empty file name, which is what a shell makes of an unset variable.
[[nodiscard]] CLI::Validator file_name();

/// Accepts decimal digits only, for a number up to `most`: CLI11 reads 010 as 8, and 2^64 as 2^64 - 1.
[[nodiscard]] CLI::Validator whole_number(std::uint64_t most = std::numeric_limits<std::uint64_t>::max());

/// Accepts one of `values`, and suggests one for a typo.
[[nodiscard]] CLI::Validator one_of(std::vector<std::string> values);

/// The values of --method, and its description.
inline const std::vector<std::string> kMethods{"exact", "bfs", "paper", "ball"};
inline constexpr const char* kMethodsHelp =
    "exact: by the index; bfs: exact by breadth-first search, slower; paper: with a few extra vertices; ball: all "
    "vertices in the ball";

/// FILE: a mesh or an index.
void add_file(CLI::App& command, std::string& file);

/// MESH: a mesh.
void add_mesh(CLI::App& command, std::string& file);

/// --output, optional unless made required. An extension other than `extension` (".ply") is refused.
CLI::Option* add_output(CLI::App& command, const std::string& extension, const std::string& description,
                        std::string& file);

/// --threads.
void add_threads(CLI::App& command, unsigned& threads);

/// --json.
void add_json(CLI::App& command, bool& json);

/// A radius as it was typed.
struct Radius {
  std::string value;
  std::string unit = "mesh";
};

/// --radius and --unit. Returns the former, which is required unless made optional.
CLI::Option* add_radius(CLI::App& command, Radius& radius);

/// --unit.
void add_unit(CLI::App& command, std::string& unit);

/// The radius in the unit of the positions. Throws Error{InvalidRadius, InvalidOption}.
[[nodiscard]] double resolve(const Radius& radius, Input& input);

/// The double nearest to `text`; `name` is for the message. Throws Error{InvalidRadius}.
[[nodiscard]] double parse_radius(std::string_view name, const std::string& text);

/// Throws Error{VertexOutOfRange} unless the mesh has vertex `v`.
[[nodiscard]] VertexId resolve_vertex(std::uint64_t v, const Input& input);

/// Checks an output file before the work begins; does nothing if `output` is empty. Throws Error{InvalidOption} if it
/// is one of the `inputs`, and Error{IoFailure} if its folder does not exist or is not writable.
void check_output(const std::string& output, std::initializer_list<std::string> inputs = {});

/// "; did you mean 'build'?", or "" if no candidate is similar to `word`.
[[nodiscard]] std::string suggestion(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace meshhood::cli
