// SPDX-License-Identifier: MIT
#include "parts/manifest.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "meshhood/error.h"

#include "io/file_writer.h"
#include "io/mapped_file.h"
#include "io/messages.h"
#include "parts/json.h"
#include "shared/checksum.h"

// Each JSON file begins with a line of fixed length that holds the checksum of all bytes after it.

namespace meshhood::parts {
namespace {

/// The version of the folder and its files.
constexpr unsigned kFormat = 1;

constexpr std::string_view kFloat = "float";
constexpr std::string_view kDouble = "double";

std::string hex(std::uint64_t number) { return fmt::format("{:016x}", number); }

std::uint64_t number_of(std::string_view hex_digits) {
  std::uint64_t number = 0;
  const char* const begin = hex_digits.data();
  const char* const end = begin + hex_digits.size();
  const auto [rest, error] = std::from_chars(begin, end, number, 16);
  if (hex_digits.size() != 16 || error != std::errc() || rest != end) {
    raise(ErrorCode::MalformedIndex, fmt::format("{}, expected 16 hexadecimal digits", io::quote(hex_digits)));
  }
  return number;
}

std::string first_line(std::string_view rest) {
  return fmt::format("{{\"checksum\": \"{}\",\n", hex(checksum({std::as_bytes(std::span(rest))})));
}

[[noreturn]] void refuse(const std::filesystem::path& file, std::string_view reason) {
  raise(ErrorCode::MalformedIndex, fmt::format("{}: {}", io::printable_name(file.string()), reason));
}

/// `rest`: the document after its opening brace, which the first line has.
void write_json(const std::filesystem::path& file, const std::string& rest) {
  io::FileWriter writer(file);
  writer.write(first_line(rest) + rest);
  writer.commit();
}

/// Calls `read(values)`. Every fault of the text becomes an error that names the file.
template <class F>
auto read_json(const std::filesystem::path& file, F&& read) {
  const io::MappedFile mapped(file);
  const std::string text(reinterpret_cast<const char*>(mapped.bytes().data()), mapped.bytes().size());
  const std::size_t line = std::min(text.find('\n'), text.size() - 1) + 1;
  const std::string rest = text.substr(line);
  if (text.empty() || text.substr(0, line) != first_line(rest)) {
    refuse(file, "has been changed or truncated: its checksum does not match");
  }
  try {
    return read(JsonValues(text));
  } catch (const Error& error) {
    refuse(file, error.what());
  }
}

std::string json_of(const Plan& plan) {
  return fmt::format(R"(
 "plan": {{
  "format": {},
  "vertices": {},
  "faces": {},
  "precision": "{}",
  "content_hash": "{}",
  "mean_edge_length": {},
  "halo": {},
  "parts": {}
 }})",
                     kFormat, plan.vertices, plan.faces, plan.is_double ? kDouble : kFloat, to_text(plan.content_hash),
                     json_text(plan.mean_edge_length), json_text(plan.halo), plan.parts);
}

/// A finite number >= 0.
double length_at(const JsonValues& json, const std::string& path) {
  const double length = json.number(path);
  if (length >= 0 && std::isfinite(length)) return length;
  raise(ErrorCode::MalformedIndex, fmt::format("'{}' is {}, expected a finite number >= 0", path, length));
}

bool is_double_at(const JsonValues& json, const std::string& path) {
  const std::string& precision = json.text(path);
  if (precision != kFloat && precision != kDouble) {
    raise(ErrorCode::MalformedIndex,
          fmt::format("'{}' is {}, expected {} or {}", path, io::quote(precision), kFloat, kDouble));
  }
  return precision == kDouble;
}

Plan plan_from(const JsonValues& json) {
  if (const std::uint64_t format = json.count("plan/format"); format != kFormat) {
    raise(ErrorCode::MalformedIndex,
          fmt::format("format {}, but this version reads format {}: {}", format, kFormat,
                      format < kFormat ? "partition the mesh again" : "install a newer meshhood"));
  }
  const std::string& hash = json.text("plan/content_hash");
  return {.vertices = json.count("plan/vertices"),
          .faces = json.count("plan/faces"),
          .is_double = is_double_at(json, "plan/precision"),
          .content_hash = {number_of(hash.substr(0, hash.size() / 2)), number_of(hash.substr(hash.size() / 2))},
          .mean_edge_length = length_at(json, "plan/mean_edge_length"),
          .halo = length_at(json, "plan/halo"),
          .parts = static_cast<std::size_t>(json.count("plan/parts"))};
}

std::string json_of(const PartFile& file, std::string_view indent) {
  return fmt::format(R"(
{0}"{1}": {{
{0} "bytes": {2},
{0} "checksum": "{3}"
{0}}})",
                     indent, file.name, file.bytes, hex(file.checksum));
}

std::string json_of(const Part& part, const std::string& indent) {
  std::vector<std::string> files(part.files.size());
  std::ranges::transform(part.files, files.begin(), [&](const PartFile& f) { return json_of(f, indent + "  "); });
  return fmt::format(R"({{
{0} "vertices": {1},
{0} "owned": {2},
{0} "faces": {3},
{0} "files": {{{4}
{0} }}
{0}}})",
                     indent, part.vertices, part.owned, part.faces, fmt::join(files, ","));
}

Part part_from(const JsonValues& json, const std::string& path) {
  Part part{.vertices = json.count(path + "/vertices"),
            .owned = json.count(path + "/owned"),
            .faces = json.count(path + "/faces"),
            .files = {}};
  if (part.owned > part.vertices) {
    raise(ErrorCode::MalformedIndex, fmt::format("a part that owns {} of its {} vertices", part.owned, part.vertices));
  }
  for (const std::string_view name : kPartFiles) {
    const std::string file = fmt::format("{}/files/{}", path, name);
    part.files.push_back({std::string(name), json.count(file + "/bytes"), number_of(json.text(file + "/checksum"))});
  }
  return part;
}

void check_counts(const Manifest& manifest) {
  if (manifest.parts.size() != manifest.plan.parts) {
    raise(ErrorCode::MalformedIndex, fmt::format("lists {} parts of {}", manifest.parts.size(), manifest.plan.parts));
  }
  std::uint64_t owned = 0;
  for (const Part& part : manifest.parts) owned += part.owned;
  if (owned != manifest.plan.vertices) {
    raise(ErrorCode::MalformedIndex, fmt::format("the parts own {} vertices of {}", owned, manifest.plan.vertices));
  }
}

}  // namespace

std::string part_name(std::size_t part) { return fmt::format("part-{:05}", part); }

PartFile describe_file(const std::filesystem::path& folder, std::string_view name) {
  const io::MappedFile mapped(folder / name);
  return {std::string(name), mapped.bytes().size(), checksum({mapped.bytes()})};
}

void verify_size(const std::filesystem::path& file, std::uint64_t bytes, const PartFile& expected) {
  if (bytes == expected.bytes) return;
  refuse(file, fmt::format("has {} bytes, but the manifest says {}", bytes, expected.bytes));
}

void verify_file(const std::filesystem::path& file, std::span<const std::byte> content, const PartFile& expected) {
  verify_size(file, content.size(), expected);
  const std::uint64_t found = checksum({content});
  if (found != expected.checksum) {
    refuse(file, fmt::format("has the checksum {}, but the manifest says {}: it has been changed, or is of another "
                             "mesh",
                             hex(found), hex(expected.checksum)));
  }
}

void write_part(const std::filesystem::path& part_folder, const Plan& plan, std::size_t number, const Part& part) {
  write_json(part_folder / kPartFile,
             fmt::format("{},\n \"number\": {},\n \"part\": {}\n}}\n", json_of(plan), number, json_of(part, " ")));
}

std::optional<Part> read_part(const std::filesystem::path& part_folder, const Plan& plan, std::size_t number) {
  const std::filesystem::path file = part_folder / kPartFile;
  std::error_code unknown;
  if (!std::filesystem::exists(file, unknown)) return std::nullopt;
  return read_json(file, [&](const JsonValues& json) {
    if (plan_from(json) != plan || json.count("number") != number) {
      raise(ErrorCode::MalformedIndex, "is a part of another mesh, or of another number of parts or halo");
    }
    return part_from(json, "part");
  });
}

std::optional<Plan> read_plan(const std::filesystem::path& part_folder) {
  const std::filesystem::path file = part_folder / kPartFile;
  std::error_code unknown;
  if (!std::filesystem::exists(file, unknown)) return std::nullopt;
  return read_json(file, plan_from);
}

void write_manifest(const std::filesystem::path& folder, const Manifest& manifest) {
  std::vector<std::string> parts(manifest.parts.size());
  std::ranges::transform(manifest.parts, parts.begin(), [](const Part& part) { return "\n  " + json_of(part, "  "); });
  write_json(folder / kManifestFile,
             fmt::format("{},\n \"parts\": [{}\n ]\n}}\n", json_of(manifest.plan), fmt::join(parts, ",")));
}

Manifest read_manifest(const std::filesystem::path& folder) {
  return read_json(folder / kManifestFile, [](const JsonValues& json) {
    Manifest manifest{.plan = plan_from(json), .parts = {}};
    manifest.checksum = number_of(json.text("checksum"));
    const std::size_t parts = json.size("parts");
    for (std::size_t i = 0; i < parts; ++i) manifest.parts.push_back(part_from(json, fmt::format("parts/{}", i)));
    check_counts(manifest);
    return manifest;
  });
}

}  // namespace meshhood::parts
