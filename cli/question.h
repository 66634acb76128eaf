// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include <CLI/CLI.hpp>

#include "meshhood/mesh.h"

#include "input.h"

namespace meshhood::cli {

/// FILE, a vertex and a radius, as they were typed.
struct Question {
  std::string file;
  std::uint64_t vertex = 0;
  std::string radius;
  std::string unit = "mesh";
};

/// Adds FILE, --vertex, --radius and --unit to `command`; they end up in `question`, which must outlive it.
void add_question(CLI::App& command, Question& question);

/// What the library is asked: a radius in the unit of the positions.
struct Query {
  VertexId vertex;
  double radius;
};

/// Throws Error{VertexOutOfRange, InvalidRadius, InvalidOption}.
[[nodiscard]] Query resolve(const Question& question, const Input& input);

/// Accepts decimal digits alone: CLI11 would read 010 as 8, and 2^64 as the largest number there is.
[[nodiscard]] CLI::Validator whole_number();

/// `text` as the double nearest to it. Throws Error{InvalidRadius} where it is no number.
[[nodiscard]] double parse_radius(const std::string& text);

}  // namespace meshhood::cli
