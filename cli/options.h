// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "meshhood/mesh.h"

#include "input.h"

/// The options that several commands share. Each `add_` function stores the value in its last argument, which must
/// outlive the command.
namespace meshhood::cli {

/// A command and its options, which live as long.
template <class Options>
struct Command {
  CLI::App& app;
  Options& options;
};

/// Adds a command, which calls `run(options)` when the arguments are parsed.
template <class Options>
Command<Options> add_command(CLI::App& program, const std::string& name, const std::string& description,
                             void (*run)(const Options&)) {
  auto options = std::make_shared<Options>();
  CLI::App* const command = program.add_subcommand(name, description);
  command->callback([options, run] { run(*options); });
  return {*command, *options};
}

/// The values of an enumeration and their names on the command line.
template <class T, std::size_t Size>
using Names = std::array<std::pair<std::string_view, T>, Size>;

/// The names, in their order.
template <class T, std::size_t Size>
[[nodiscard]] std::vector<std::string> names_of(const Names<T, Size>& names) {
  std::vector<std::string> result;
  for (const auto& [name, value] : names) result.emplace_back(name);
  return result;
}

/// The value of a name, which is one of `names`.
template <class T, std::size_t Size>
[[nodiscard]] T value_of(const Names<T, Size>& names, std::string_view name) {
  for (const auto& [known, value] : names) {
    if (known == name) return value;
  }
  return names.front().second;
}

/// The name of a file that is read more than once, or of a folder: `-` is refused. An empty name is refused, too, which
/// is what a shell makes of an unset variable.
[[nodiscard]] CLI::Validator stored_name(const std::string& option);

/// Accepts decimal digits only, for a number up to `most`: CLI11 reads 010 as 8, and 2^64 as 2^64 - 1.
[[nodiscard]] CLI::Validator whole_number(std::uint64_t most = std::numeric_limits<std::uint64_t>::max());

/// An option whose value is a whole number up to `most`.
template <class Value>
CLI::Option* add_number(CLI::App& command, const std::string& name, const std::string& description, Value& value,
                        std::uint64_t most = std::numeric_limits<std::uint64_t>::max()) {
  return command.add_option(name, value, description)->transform(whole_number(most))->type_name("NUMBER");
}

/// An option whose values are separated by commas or given one by one, each as `accept` makes it. The delimiter of
/// CLI11 would drop an empty one, which a shell makes of an unset variable.
template <class Value>
CLI::Option* add_list(CLI::App& command, const std::string& name, const std::string& description,
                      std::vector<Value>& values, const CLI::Validator& accept = {}) {
  const auto store = [&values, accept,
                      option = name.substr(name.rfind(',') + 1)](const std::vector<std::string>& lists) {
    values.clear();
    for (const std::string& list : lists) {
      for (std::string& value : CLI::detail::split(list + ',', ',')) {
        if (const std::string fault = accept(value); !fault.empty()) throw CLI::ValidationError(option, fault);
        CLI::detail::lexical_cast(value, values.emplace_back());
      }
    }
  };
  return command.add_option_function<std::vector<std::string>>(name, store, description)->allow_extra_args(false);
}

/// The same for whole numbers.
CLI::Option* add_numbers(CLI::App& command, const std::string& name, const std::string& description,
                         std::vector<std::uint64_t>& values);

/// The same for vertices, or `-` for a list of them on standard input, which is then stored as its name.
CLI::Option* add_vertices(CLI::App& command, const std::string& name, const std::string& description,
                          std::vector<std::string>& vertices);

/// An option whose value is one of `values`; the one at hand is the default.
CLI::Option* add_choice(CLI::App& command, const std::string& name, const std::string& description,
                        std::vector<std::string> values, std::string& value);

/// The same for one or several, separated by commas.
CLI::Option* add_choices(CLI::App& command, const std::string& name, const std::string& description,
                         std::vector<std::string> values, std::vector<std::string>& chosen);

/// An option whose value is the name of a file to read. `-` is standard input, for one argument at most.
CLI::Option* add_file_option(CLI::App& command, const std::string& name, const std::string& description,
                             std::string& file);

/// FILE: a mesh or an index, with --weld and --precision.
void add_file(CLI::App& command, Reading& reading);

/// The same for MESH: a mesh.
void add_mesh(CLI::App& command, Reading& reading);

/// The same for MESH: a mesh, or an index with faces.
void add_surface(CLI::App& command, Reading& reading);

/// --output, or the option `name`, optional unless made required. `-` is standard output. An extension other than
/// `extensions` (".ply", or ".npz or .csv") is refused.
CLI::Option* add_output(CLI::App& command, const std::string& extensions, const std::string& description,
                        std::string& file, const std::string& name = "-o,--output");

/// --weld and --precision alone.
std::array<CLI::Option*, 2> add_reading(CLI::App& command, Reading& reading);

/// --max-bytes, for a `SizeLimit`.
void add_max_bytes(CLI::App& command, std::optional<std::uint64_t>& max_bytes);

/// --threads.
void add_threads(CLI::App& command, unsigned& threads);

/// --json.
void add_json(CLI::App& command, bool& json);

/// A radius as it was typed.
struct Radius {
  std::string value;
  std::string unit = "mesh";
};

/// Several radii as they were typed.
struct Radii {
  std::vector<std::string> values;
  std::string unit = "mesh";
};

/// --radius and --unit. Returns the former, which is required unless made optional.
CLI::Option* add_radius(CLI::App& command, Radius& radius);

/// The same for one radius or several, separated by commas or given one by one.
CLI::Option* add_radii(CLI::App& command, Radii& radii);

/// --unit. `length` is what has the unit: "radius".
void add_unit(CLI::App& command, const std::string& length, std::string& unit);

/// The length of a unit, in that of the positions: of the index of a part, of the whole mesh. Throws
/// Error{InvalidOption}.
[[nodiscard]] double length_of_unit(const std::string& unit, Input& input);

/// In the unit of the positions. Throws Error{InvalidRadius, InvalidOption}, and as `Input::need_halo`.
[[nodiscard]] double resolve(const Radius& radius, Input& input);
[[nodiscard]] std::vector<double> resolve(const Radii& radii, Input& input);

/// The double nearest to `text`; nothing if it is no number, or one in digits beyond the range of double.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

/// The same of a radius; `name` is for the message. Throws Error{InvalidRadius}.
[[nodiscard]] double parse_radius(std::string_view name, const std::string& text);

/// Vertex `v` of the file, or the one that it has become (see `Welding`). Throws Error{VertexOutOfRange} unless the
/// mesh has it.
[[nodiscard]] VertexId resolve_vertex(std::uint64_t v, const Input& input);

/// Makes `file` an output of the command, as if the option `name` had named it.
void name_output(const std::string& name, const std::string& file);

/// Checks all output files of the command before the work begins. From then on, if one is standard output, what the
/// command prints goes to standard error. Throws Error{InvalidOption} if one is also another output or an input, and
/// Error{IoFailure} if its folder does not exist or is not writable.
void check_outputs();

/// "; did you mean 'build'?", or "" if no candidate is similar to `word`.
[[nodiscard]] std::string suggestion(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace meshhood::cli
