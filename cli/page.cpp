// SPDX-License-Identifier: MIT
#include "page.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <span>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "meshhood/error.h"

#include "io/byte_source.h"
#include "io/file_writer.h"
#include "io/messages.h"
#include "io/system.h"
#include "output.h"
#include "quantity.h"
#include "task.h"

namespace meshhood::cli {
namespace {

namespace fs = std::filesystem;

/// The page has this comment where the mesh goes.
constexpr std::string_view kPlace = "<!-- meshhood:page -->";

/// A browser holds a text of at most 2^29 characters.
constexpr std::uint64_t kMostBytes = std::uint64_t{256} << 20;

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

/// Little-endian, as this machine is (an index can be loaded on no other).
std::string encode(const std::vector<float>& values) {
  return base64({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)});
}

/// In HTML, no `<` of a JSON text may begin a tag.
std::string to_script(const PageSettings& settings) {
  Json document{{"name", settings.name}};
  if (settings.vertex) document["vertex"] = *settings.vertex;
  if (settings.radius) document["radius"] = *settings.radius;
  if (settings.weld) document["weld"] = *settings.weld;
  if (!settings.precision.empty()) document["precision"] = settings.precision;
  if (settings.answer) document["ids"] = *settings.answer;
  if (!settings.values.empty()) {
    document["scalar"] = {{"title", settings.values_name}, {"values", encode(settings.values)}};
  }
  std::string text = document.dump(-1, ' ', false, Json::error_handler_t::replace);
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
void write_base64(io::FileWriter& output, const fs::path& mesh, io::ByteSource& source, Task& task) {
  const auto total = static_cast<std::size_t>(source.size().value_or(0));
  const Progress progress = task.progress();
  std::vector<char> piece(std::size_t{3} << 16);
  std::size_t done = 0;
  for (std::size_t filled = 1; filled != 0;) {
    filled = 0;
    while (filled < piece.size()) {
      const std::size_t count = source.read(std::span(piece).subspan(filled));
      if (count == 0) break;
      filled += count;
    }
    output.write(base64(std::span(piece).first(filled)));
    done += filled;
    if (done > kMostBytes) io::raise_io(mesh, 0, "is more than a page holds");
    io::report(progress, done, std::max(done, total), mesh.string());
  }
}

}  // namespace

void check_mesh_of_page(const fs::path& mesh) {
  if (mesh == io::kStandardInput) io::raise_io(mesh, 0, "is read once, but a page needs the mesh twice; name a file");
  if (!fs::is_regular_file(mesh)) io::raise_io(mesh, 0, "is not a regular file, which a page needs");
  const std::uint64_t bytes = fs::file_size(mesh);
  if (bytes <= kMostBytes) return;
  raise(ErrorCode::TooLarge, fmt::format("{}: {}, but a page holds at most {}; drop the file onto a page instead",
                                         printable_name(mesh.string()), bytes_text(static_cast<double>(bytes)),
                                         bytes_text(static_cast<double>(kMostBytes))));
}

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

void write_page(const fs::path& output, const fs::path& mesh, const std::string& ply, const PageSettings& settings) {
  check_mesh_of_page(mesh);
  const fs::path page = find_page();
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
  write_base64(file, mesh, ply.empty() ? static_cast<io::ByteSource&>(read) : converted, task);
  file.write("</script>\n");
  file.write(std::string_view(text).substr(place + kPlace.size()));
  file.commit();
}

}  // namespace meshhood::cli
