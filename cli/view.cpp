// SPDX-License-Identifier: MIT
// meshhood view: a page that shows the mesh and its neighborhoods.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "meshhood/error.h"

#include "commands.h"
#include "input.h"
#include "io/byte_source.h"
#include "io/file_writer.h"
#include "io/messages.h"
#include "io/system.h"
#include "mesh_file.h"
#include "options.h"
#include "output.h"
#include "system.h"
#include "task.h"
#include "vertex_files.h"

namespace meshhood::cli {
namespace {

namespace fs = std::filesystem;

/// The page has this comment where the mesh goes.
constexpr std::string_view kPlace = "<!-- meshhood:page -->";

/// A browser holds a text of at most 2^29 characters.
constexpr std::uint64_t kMostBytes = std::uint64_t{256} << 20;

struct ViewCommand {
  Reading reading;
  std::optional<std::uint64_t> vertex;
  Radius radius;
  std::string answer;
  std::string values;
  std::string output;
  bool open = false;
};

std::string base64(std::span<const char> bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) { return k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0U; };
    const unsigned word = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    for (const int shift : {18, 12, 6, 0}) text += kDigits[word >> shift & 63];
  }
  const std::size_t padding = (3 - bytes.size() % 3) % 3;
  text.replace(text.size() - padding, padding, padding, '=');
  return text;
}

/// In base 64, as float, and little-endian, as this machine is (an index can be loaded on no other). Values that are
/// not finite get no color.
std::string encode(const std::vector<double>& values) {
  std::vector<float> result;
  result.reserve(values.size());
  for (const double value : values) result.push_back(to_float(value, "values", result.size(), "a page"));
  return base64({reinterpret_cast<const char*>(result.data()), result.size() * sizeof(float)});
}

/// The initial state of the page.
Json settings_of(const ViewCommand& options, Input& input) {
  Json settings{{"name", path_of(options.reading.file).filename().string()}};
  if (options.vertex) settings["vertex"] = resolve_vertex(*options.vertex, input);
  if (!options.radius.value.empty()) {
    const double radius = resolve(options.radius, input);
    // JSON has no infinity.
    if (!std::isfinite(radius)) {
      raise(ErrorCode::InvalidRadius, fmt::format("radius {}, expected a finite number for a page", radius));
    }
    settings["radius"] = radius;
  }
  if (!options.reading.weld.empty()) settings["weld"] = eps_of(options.reading.weld);
  if (!options.reading.precision.empty()) settings["precision"] = options.reading.precision;
  if (!options.answer.empty()) {
    std::vector<VertexId> answer = read_vertex_list(options.answer, input.vertex_count());
    for (VertexId& v : answer) v = input.welding().kept(v);
    settings["ids"] = answer;
  }
  if (!options.values.empty()) {
    const std::vector<double> values = read_channel(options.values, input.vertex_count(), "values");
    const std::string title = path_of(options.values).stem().string();
    settings["scalar"] = {{"title", title}, {"values", encode(values)}};
  }
  return settings;
}

/// In HTML, no `<` of a JSON text may begin a tag.
std::string to_script(const Json& settings) {
  std::string text = settings.dump(-1, ' ', false, Json::error_handler_t::replace);
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
  return text;
}

std::string read_text(const fs::path& path) {
  io::FileSource source(path);
  std::string text;
  std::array<char, std::size_t{1} << 16> piece;
  while (const std::size_t count = source.read(piece)) {
    text.append(piece.data(), count);
    if (text.size() > kMostBytes) io::raise_io(path, 0, "is not the page of the viewer: it is too large");
  }
  return text;
}

fs::path folder_of_program() {
  std::error_code unknown;
  return fs::read_symlink("/proc/self/exe", unknown).parent_path();
}

/// Writes `source`, the content of `mesh`, in base 64, in pieces whose size is a multiple of three.
void write_base64(io::FileWriter& output, const fs::path& mesh, io::ByteSource& source) {
  std::vector<char> piece(std::size_t{3} << 16);
  std::uint64_t done = 0;
  while (const std::size_t count = source.fill(piece)) {
    output.write(base64(std::span(piece).first(count)));
    done += count;
    if (done > kMostBytes) io::raise_io(mesh, 0, "is more than a page holds");
  }
  source.finish();
}

/// Refuses a mesh that is no regular file, or is larger than a browser takes in a page.
void check_mesh_of_page(const fs::path& mesh) {
  if (mesh == io::kStandardInput) io::raise_io(mesh, 0, "is read once, but a page needs the mesh twice; name a file");
  if (!fs::is_regular_file(mesh)) io::raise_io(mesh, 0, "is not a regular file, which a page needs");
  const std::uint64_t bytes = fs::file_size(mesh);
  if (bytes <= kMostBytes) return;
  raise(ErrorCode::TooLarge, fmt::format("{}: {}, but a page holds at most {}; drop the file onto a page instead",
                                         printable_name(mesh.string()), bytes_text(static_cast<double>(bytes)),
                                         bytes_text(static_cast<double>(kMostBytes))));
}

/// The built page of viewer/: the file that MESHHOOD_VIEWER names, or that of the installation, of the build tree, or
/// of the Python package whose wheel contains this program.
fs::path find_page() {
  if (const char* const named = std::getenv("MESHHOOD_VIEWER"); named != nullptr && *named != '\0') return named;
  const fs::path here = folder_of_program();
  for (const fs::path& page : {here / "../share/meshhood/viewer.html", here / "../viewer/viewer.html"}) {
    if (fs::exists(page)) return page;
  }
  raise(ErrorCode::IoFailure,
        "the viewer is not built: 'make view' in the sources of meshhood builds it, and MESHHOOD_VIEWER may name its "
        "viewer.html");
}

/// Writes a copy of `page` that holds `mesh`, or `ply` unless it is empty, the content of the same mesh as PLY.
void write_page(const fs::path& page, const fs::path& output, const fs::path& mesh, const std::string& ply,
                const Json& settings) {
  const std::string text = read_text(page);
  std::error_code none;
  if (fs::equivalent(page, output, none)) io::raise_io(output, 0, "is the page that is copied, expected another file");
  const std::size_t place = text.find(kPlace);
  if (place == std::string::npos) io::raise_io(page, 0, "is not the page of the viewer");
  Task task("writing the page");
  io::FileWriter file(output);
  file.write(std::string_view(text).substr(0, place));
  file.write(
      fmt::format("<script type=\"application/json\" id=\"meshhood-settings\">{}</script>\n", to_script(settings)));
  file.write(R"(<script type="text/plain" id="meshhood-mesh">)");
  io::FileSource read(mesh);
  io::MemorySource converted(std::as_bytes(std::span(ply)));
  io::ByteSource& source = ply.empty() ? static_cast<io::ByteSource&>(read) : converted;
  const Progress progress = task.progress();
  source.watch(progress, mesh.string());
  write_base64(file, mesh, source);
  file.write("</script>\n");
  file.write(std::string_view(text).substr(place + kPlace.size()));
  file.commit();
}

void view(const ViewCommand& options) {
  const std::string output =
      options.output.empty() ? path_of(options.reading.file).stem().string() + ".html" : options.output;
  if (options.output.empty()) name_output("--output", output);
  check_outputs();
  check_mesh_of_page(path_of(options.reading.file));
  const fs::path page = find_page();  // before the work begins
  Input input(options.reading);
  input.need_edges("view");
  write_page(page, path_of(output), path_of(options.reading.file), input.other_as_ply(), settings_of(options, input));
  print_text(output + "\n");
  if (!options.open) return;
  if (const auto program = open_in_browser(fs::absolute(path_of(output))); !program.empty()) {
    print_error("warning: ", fmt::format("{} could not open {}", program, printable_name(output)));
  }
}

}  // namespace

void add_view(CLI::App& program) {
  const auto [command, options] =
      add_command(program, "view", "Write a page that shows the mesh and its neighborhoods in a browser", view);
  add_file(command, options.reading);
  add_number(command, "-v,--vertex", "vertex to show at first, by its number in the file from 0", options.vertex);
  add_radius(command, options.radius)->required(false);
  add_file_option(command, "--ids", "show these vertices, one on each line, as printed by query", options.answer);
  add_file_option(command, "--values", "color the vertices by these numbers: one per line, or an array of NumPy (.npy)",
                  options.values);
  add_output(command, ".html", "the page; by default the name of FILE, in this folder", options.output);
  command.add_flag("--open", options.open, "also open the page in the browser");
}

}  // namespace meshhood::cli
