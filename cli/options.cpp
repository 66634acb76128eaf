// SPDX-License-Identifier: MIT
#include "options.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <numeric>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "meshhood/adjacency.h"
#include "meshhood/error.h"
#include "meshhood/run.h"

#include "io/file_writer.h"
#include "io/messages.h"
#include "io/number.h"
#include "io/system.h"
#include "io/text.h"
#include "output.h"
#include "system.h"

namespace meshhood::cli {
namespace {

constexpr const char* kEmptyName = "the name is empty";
constexpr std::string_view kStream = "-";

std::string mesh_formats() {
  return reads_others() ? "PLY, OBJ, OFF, STL, VTK, FreeSurfer; with meshhood[files] also GIFTI, VTP, VTU, MSH, GLB, "
                          "glTF, 3MF"
                        : "PLY, OBJ, OFF, STL, VTK or FreeSurfer";
}

double edge_unit(Input& input) {
  input.need_edges("--unit edge");
  const double mean = input.plan() != nullptr ? input.plan()->mean_edge_length : mean_edge_length(input.graph());
  if (mean > 0) return mean;
  wrong_option("--unit edge: the mean edge length of {} is 0, expected a length > 0", printable_name(input.name()));
}

/// The number of characters to insert, delete, replace or swap to turn `a` into `b`.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before;
  std::vector<std::size_t> last(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::vector<std::size_t> row(b.size() + 1, i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0U : 1U)});
      const bool is_swap = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (is_swap) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = std::exchange(last, row);
  }
  return last.back();
}

/// A file that an option names, or an argument.
struct NamedFile {
  std::string option;
  std::string file;
};

/// Of "-o,--output" the latter.
std::string long_name(const std::string& names) { return names.substr(names.rfind(',') + 1); }

/// The files of this run of the program, which has one command.
struct NamedFiles {
  std::vector<NamedFile> inputs;
  std::vector<NamedFile> outputs;
};

NamedFiles& named_files() {
  static NamedFiles files;
  return files;
}

CLI::Validator input_name(const std::string& option) {
  const auto check = [option](std::string& name) -> std::string {
    if (name.empty()) return kEmptyName;
    if (name == kStream) name = io::kStandardInput;
    for (const NamedFile& other : named_files().inputs) {
      if (name == io::kStandardInput && other.file == name) return "standard input is " + other.option + " already";
    }
    named_files().inputs.push_back({long_name(option), name});
    return {};
  };
  return {check, ""};
}

/// A name without extension may be a pipe or a device, and is accepted.
CLI::Validator output_name(const std::string& option, const std::string& extensions) {
  const auto check = [option, extensions](std::string& name) -> std::string {
    if (name.empty()) return kEmptyName;
    if (name == kStream) name = io::kStandardOutput;
    const std::string found = io::lower_case(std::filesystem::path(name).extension().string());
    if (!found.empty() && (extensions + ' ').find(found + ' ') == std::string::npos) {
      return fmt::format("'{}' has the extension {}, but the file will be {}", name, found, extensions);
    }
    name_output(option, name);
    return {};
  };
  return {check, ""};
}

/// Accepts one of `values`, and suggests one for a typo.
CLI::Validator one_of(std::vector<std::string> values) {
  const auto check = [values = std::move(values)](const std::string& word) -> std::string {
    if (std::find(values.begin(), values.end(), word) != values.end()) return {};
    return fmt::format("'{}' is not one of {}{}", word, fmt::join(values, ", "), suggestion(word, values));
  };
  return {check, ""};
}

/// Also of files that do not exist yet, where links to them and to their folders may.
bool is_same_file(const std::string& a, const std::string& b) {
  namespace fs = std::filesystem;
  std::error_code missing;
  const auto place = [&](const std::string& name) {
    const fs::path file = io::written_file(path_of(name));
    const fs::path folder = fs::canonical(file.has_parent_path() ? file.parent_path() : fs::path("."), missing);
    return missing ? file.lexically_normal() : folder / file.filename();
  };
  return place(a) == place(b) || fs::equivalent(path_of(a), path_of(b), missing);
}

/// An argument, and how it is read.
void add_input(CLI::App& command, const std::string& name, const std::string& description, Reading& reading) {
  add_file_option(command, name, description, reading.file)->required()->type_name("");
  add_reading(command, reading);
}

/// Throws unless a file can be created there.
void check_place(const std::string& name) {
  namespace fs = std::filesystem;
  if (name == io::kStandardOutput) return keep_standard_output_for_file();
  const fs::path output = path_of(name);
  std::error_code ignored;
  const fs::file_status status = fs::status(output, ignored);
  if (fs::is_directory(status)) io::raise_errno(output, EISDIR, "create");
  if (fs::exists(status) && !fs::is_regular_file(status)) return;  // a pipe or a device
  const fs::path folder = output.parent_path();
  const fs::file_status status_of_folder = fs::status(folder.empty() ? "." : folder, ignored);
  if (fs::exists(status_of_folder) && !fs::is_directory(status_of_folder)) io::raise_errno(output, ENOTDIR, "create");
  if (!io::may_create_in(folder.empty() ? "." : folder)) io::raise_errno(output, errno, "create");
}

}  // namespace

CLI::Validator stored_name(const std::string& option) {
  const auto check = [option](const std::string& name) -> std::string {
    if (name.empty()) return kEmptyName;
    named_files().inputs.push_back({option, name});
    return name == kStream ? "expected the name of a file or folder, not a standard stream" : "";
  };
  return {check, ""};
}

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

CLI::Option* add_numbers(CLI::App& command, const std::string& name, const std::string& description,
                         std::vector<std::uint64_t>& values) {
  return add_list(command, name, description, values, whole_number())->type_name("NUMBER");
}

CLI::Option* add_vertices(CLI::App& command, const std::string& name, const std::string& description,
                          std::vector<std::string>& vertices) {
  const auto check = [stream = input_name(name), number = whole_number()](std::string& text) {
    return text == kStream ? stream(text) : number(text);
  };
  return add_list(command, name, description, vertices, CLI::Validator(check, ""))->type_name("NUMBER");
}

CLI::Option* add_choice(CLI::App& command, const std::string& name, const std::string& description,
                        std::vector<std::string> values, std::string& value) {
  const std::string type = fmt::format("{}", fmt::join(values, "|"));
  return command.add_option(name, value, description)
      ->check(one_of(std::move(values)))
      ->type_name(type)
      ->capture_default_str();
}

CLI::Option* add_choices(CLI::App& command, const std::string& name, const std::string& description,
                         std::vector<std::string> values, std::vector<std::string>& chosen) {
  const std::string all = fmt::format("{}, separated by commas: {}", description, fmt::join(values, ", "));
  return add_list(command, name, all, chosen, one_of(std::move(values)))
      ->type_name("NAMES")
      ->default_str(fmt::format("[{}]", fmt::join(chosen, ",")));
}

std::array<CLI::Option*, 2> add_reading(CLI::App& command, Reading& reading) {
  CLI::Option* const weld =
      command
          .add_flag("--weld", reading.weld,
                    "of a mesh: join vertices at equal positions, or at most EPS apart; they keep their numbers, and "
                    "results name the first of them")
          ->option_text("[=EPS]");
  return {weld, add_choice(command, "--precision",
                           "of the positions of a mesh; without it, what the file declares, or for text that declares "
                           "nothing, float if that keeps what is written, else double",
                           {"float", "double"}, reading.precision)};
}

CLI::Option* add_file_option(CLI::App& command, const std::string& name, const std::string& description,
                             std::string& file) {
  return command.add_option(name, file, description)->transform(input_name(name))->type_name("FILE");
}

void add_file(CLI::App& command, Reading& reading) {
  add_input(command, "FILE", fmt::format("mesh ({}) or index (made by meshhood build)", mesh_formats()), reading);
}

void add_mesh(CLI::App& command, Reading& reading) { add_input(command, "MESH", mesh_formats(), reading); }

void add_surface(CLI::App& command, Reading& reading) {
  add_input(command, "MESH", fmt::format("mesh ({}) or index that was built with --faces", mesh_formats()), reading);
}

CLI::Option* add_output(CLI::App& command, const std::string& extensions, const std::string& description,
                        std::string& file, const std::string& name) {
  return command.add_option(name, file, fmt::format("{} ({})", description, extensions))
      ->transform(output_name(name, extensions))
      ->type_name("FILE");
}

void add_max_bytes(CLI::App& command, std::optional<std::uint64_t>& max_bytes) {
  add_number(command, "--max-bytes",
             "refuse a larger answer, if possible before it is computed (default: the free space of the disk)",
             max_bytes);
}

void add_threads(CLI::App& command, unsigned& threads) {
  add_number(command, "--threads", "number of threads; 0: as many as the processor has", threads, kMaxThreads)
      ->capture_default_str();
}

void add_json(CLI::App& command, bool& json) { command.add_flag("--json", json, "print one JSON document"); }

CLI::Option* add_radius(CLI::App& command, Radius& radius) {
  CLI::Option* const option =
      command
          .add_option("-r,--radius", radius.value, "radius of the ball; a vertex at exactly this distance is inside")
          ->type_name("NUMBER")
          ->required();
  add_unit(command, "radius", radius.unit);
  return option;
}

CLI::Option* add_radii(CLI::App& command, Radii& radii) {
  CLI::Option* const option =
      add_list(command, "-r,--radius",
               "radius of the ball, or several, separated by commas; a vertex at exactly this distance is inside",
               radii.values)
          ->type_name("NUMBER")
          ->required();
  add_unit(command, "radius", radii.unit);
  return option;
}

void add_unit(CLI::App& command, const std::string& length, std::string& unit) {
  add_choice(command, "--unit",
             fmt::format("unit of the {}; mesh: that of the positions; edge: the mean edge length of the mesh", length),
             {"mesh", "edge"}, unit);
}

std::optional<double> parse_number(std::string_view text) {
  const auto number = io::parse_real<double>(text);
  const bool is_overflow = number && std::isinf(*number) && text.find_first_of("0123456789") != std::string_view::npos;
  return is_overflow ? std::nullopt : number;
}

double parse_radius(std::string_view name, const std::string& text) {
  const auto number = parse_number(text);
  if (!number) {
    raise(ErrorCode::InvalidRadius,
          fmt::format("{} {}, expected a number >= 0 in the range of double", name, io::quote(text)));
  }
  if (!(*number >= 0)) raise(ErrorCode::InvalidRadius, fmt::format("{} {}, expected a number >= 0", name, text));
  return *number;
}

double length_of_unit(const std::string& unit, Input& input) { return unit == "edge" ? edge_unit(input) : 1; }

double resolve(const Radius& radius, Input& input) {
  return resolve(Radii{{radius.value}, radius.unit}, input).front();
}

std::vector<double> resolve(const Radii& radii, Input& input) {
  std::vector<double> result;
  result.reserve(radii.values.size());
  for (const std::string& value : radii.values) result.push_back(parse_radius("radius", value));
  const double unit = length_of_unit(radii.unit, input);  // once: it takes a pass over all edges
  for (double& radius : result) {
    radius *= unit;
    input.need_halo(radius);
  }
  return result;
}

VertexId resolve_vertex(std::uint64_t v, const Input& input) {
  const std::size_t vertices = input.vertex_count();
  if (v < vertices) return input.welding().kept(static_cast<VertexId>(v));
  raise(ErrorCode::VertexOutOfRange,
        fmt::format("vertex {} is out of range: {} has {} vertices", v, printable_name(input.name()), vertices));
}

void name_output(const std::string& name, const std::string& file) {
  named_files().outputs.push_back({long_name(name), file});
}

void check_outputs() {
  const std::vector<NamedFile>& outputs = named_files().outputs;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const auto& [option, output] = outputs[i];
    for (const auto& [other, file] : named_files().inputs) {
      if (!is_same_file(file, output)) continue;
      wrong_option("{} {} would overwrite {}, {}; name another file", option, printable_name(output), other,
                   printable_name(file));
    }
    for (const auto& [other, file] : std::span(outputs).first(i)) {
      if (!is_same_file(file, output)) continue;
      wrong_option("{} and {} name the same file, {}; name two", other, option, printable_name(output));
    }
    check_place(output);
  }
}

std::string suggestion(std::string_view word, const std::vector<std::string>& candidates) {
  std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
  std::string best;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < least) {
      least = distance;
      best = candidate;
    }
  }
  return best.empty() ? "" : fmt::format("; did you mean '{}'?", best);
}

}  // namespace meshhood::cli
