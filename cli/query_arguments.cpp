// SPDX-License-Identifier: MIT
#include "query_arguments.h"

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <system_error>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "meshhood/adjacency.h"
#include "meshhood/error.h"
#include "meshhood/progress.h"

#include "input.h"

namespace meshhood::cli {
namespace {

double edge_unit(Input& input) {
  input.need_edges("--unit edge");
  const double mean = mean_edge_length(input.graph());
  if (mean > 0) return mean;
  raise(ErrorCode::InvalidOption, "--unit edge: the edges of " + input.name() + " have no length to measure by");
}

/// `text` as the double nearest to it.
double parse_radius(const std::string& text) {
  double radius = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, radius);
  if (error == std::errc() && rest == end) return radius;
  raise(ErrorCode::InvalidRadius, "radius '" + text + "' is not a number that a double can hold");
}

}  // namespace

CLI::Validator whole_number(std::uint64_t most) {
  const bool is_any = most == std::numeric_limits<std::uint64_t>::max();
  const std::string limit = is_any ? "below 2^64" : fmt::format("up to {}", most);
  const auto check = [most, limit](std::string& text) -> std::string {
    std::uint64_t number = 0;
    const char* end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, number);
    if (error != std::errc() || rest != end || number > most) {
      return fmt::format("'{}' is not a whole number {}", text, limit);
    }
    text = std::to_string(number);
    return {};
  };
  return {check, ""};
}

CLI::Validator file_name() {
  const auto check = [](const std::string& name) -> std::string { return name.empty() ? "the name is empty" : ""; };
  return {check, ""};
}

void add_file(CLI::App& command, std::string& file) {
  command.add_option("FILE", file, "mesh (PLY, OBJ, OFF or STL), or index (meshhood build)")
      ->required()
      ->check(file_name())
      ->type_name("");
}

void add_mesh(CLI::App& command, std::string& file) {
  command.add_option("MESH", file, "PLY, OBJ, OFF or STL")->required()->check(file_name())->type_name("");
}

CLI::Option* add_output(CLI::App& command, std::string& file, const std::string& description) {
  return command.add_option("-o,--output", file, description)->check(file_name())->type_name("FILE");
}

void add_threads(CLI::App& command, unsigned& threads) {
  command.add_option("--threads", threads, "how many; 0: as many as the processor has")
      ->transform(whole_number(kMaxThreads))
      ->type_name("NUMBER")
      ->capture_default_str();
}

void add_radius(CLI::App& command, Radius& radius) {
  command.add_option("-r,--radius", radius.value, "how far to go, in space")->type_name("NUMBER")->required();
  command.add_option("--unit", radius.unit, "of the radius: that of the positions, or the average edge")
      ->check(CLI::IsMember({"mesh", "edge"}))
      ->type_name("")
      ->capture_default_str();
}

double resolve(const Radius& radius, Input& input) {
  const double unit = radius.unit == "edge" ? edge_unit(input) : 1.0;
  return unit * parse_radius(radius.value);
}

void add_query_arguments(CLI::App& command, QueryArguments& arguments) {
  add_file(command, arguments.file);
  command.add_option("-v,--vertex", arguments.vertex, "the vertex to start from, by its number in the file")
      ->transform(whole_number())
      ->type_name("NUMBER")
      ->required();
  add_radius(command, arguments.radius);
}

Query resolve(const QueryArguments& arguments, Input& input) {
  const std::size_t vertices = input.vertex_count();
  if (arguments.vertex >= vertices) {
    raise(ErrorCode::VertexOutOfRange,
          fmt::format("vertex {} is out of range: {} has {} vertices", arguments.vertex, input.name(), vertices));
  }
  return {static_cast<VertexId>(arguments.vertex), resolve(arguments.radius, input)};
}

}  // namespace meshhood::cli
