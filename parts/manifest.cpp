// SPDX-License-Identifier: MIT
#include "parts/manifest.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <numeric>
#include <span>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "meshhood/error.h"

#include "base/checksum.h"
#include "io/file_writer.h"
#include "io/mapped_file.h"
#include "io/messages.h"

// Each JSON file begins with a line of fixed length that holds the checksum of all bytes after it.

namespace meshhood::parts {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kPartFiles{kIndexFile, kVerticesFile, kOwnedFile, kCornersFile, kOffsetsFile};

std::string hex(std::uint64_t number) { return fmt::format("{:016x}", number); }

std::uint64_t number_of(std::string_view hex_digits) {
  std::uint64_t number = 0;
  const char* const end = hex_digits.data() + hex_digits.size();
  const auto [rest, error] = std::from_chars(hex_digits.data(), end, number, 16);
  if (hex_digits.size() != 16 || error != std::errc() || rest != end) {
    raise(ErrorCode::MalformedIndex, fmt::format("{}, expected 16 hexadecimal digits", io::quote(hex_digits)));
  }
  return number;
}

std::uint64_t checksum_of(std::string_view text) { return checksum({std::as_bytes(std::span(text))}); }

std::string first_line(std::string_view rest) {
  return fmt::format("{{\"checksum\": \"{}\",\n", hex(checksum_of(rest)));
}

[[noreturn]] void refuse(const std::filesystem::path& file, std::string_view reason) {
  raise(ErrorCode::MalformedIndex, fmt::format("{}: {}", io::printable_name(file.string()), reason));
}

void write_json(const std::filesystem::path& file, const Json& document) {
  const std::string rest = document.dump(1).substr(1) + "\n";  // without the brace, which the first line has
  io::FileWriter writer(file);
  writer.write(first_line(rest) + rest);
  writer.commit();
}

std::string read_text(const std::filesystem::path& file) {
  const io::MappedFile mapped(file);
  const std::span<const std::byte> bytes = mapped.bytes();
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Calls `read(document)`. Every fault of the text becomes an error that names the file.
template <class F>
auto read_json(const std::filesystem::path& file, F&& read) {
  const std::string text = read_text(file);
  const std::size_t line = std::min(text.find('\n'), text.size() - 1) + 1;
  const std::string rest = text.substr(line);
  if (text.empty() || text.substr(0, line) != first_line(rest)) {
    refuse(file, "has been changed or truncated: its checksum does not match");
  }
  try {
    return read(Json::parse(text));
  } catch (const Json::exception& error) {
    refuse(file, fmt::format("is not written by meshhood partition: {}", error.what()));
  } catch (const Error& error) {
    refuse(file, error.what());
  }
}

Json to_json(const Plan& plan) {
  return {{"format", kFormat},
          {"vertices", plan.vertices},
          {"faces", plan.faces},
          {"precision", plan.is_double ? "double" : "float"},
          {"content_hash", to_text(plan.content_hash)},
          {"mean_edge_length", plan.mean_edge_length},
          {"halo", plan.halo},
          {"parts", plan.parts}};
}

Plan plan_from(const Json& json) {
  if (const auto format = json.at("format").get<unsigned>(); format != kFormat) {
    raise(ErrorCode::MalformedIndex, fmt::format("format {}, expected {}", format, kFormat));
  }
  const auto hash = json.at("content_hash").get<std::string>();
  const Plan plan{.vertices = json.at("vertices").get<std::uint64_t>(),
                  .faces = json.at("faces").get<std::uint64_t>(),
                  .is_double = json.at("precision").get<std::string>() == "double",
                  .content_hash = {number_of(hash.substr(0, hash.size() / 2)), number_of(hash.substr(hash.size() / 2))},
                  .mean_edge_length = json.at("mean_edge_length").get<double>(),
                  .halo = json.at("halo").get<double>(),
                  .parts = json.at("parts").get<std::size_t>()};
  if (!(plan.halo >= 0) || !std::isfinite(plan.halo)) {
    raise(ErrorCode::MalformedIndex, fmt::format("halo {}, expected a finite number >= 0", plan.halo));
  }
  return plan;
}

Json to_json(const Part& part) {
  Json files = Json::object();
  for (const PartFile& file : part.files) {
    files[file.name] = {{"bytes", file.bytes}, {"checksum", hex(file.checksum)}};
  }
  return {{"vertices", part.vertices}, {"owned", part.owned}, {"faces", part.faces}, {"files", std::move(files)}};
}

Part part_from(const Json& json) {
  Part part{.vertices = json.at("vertices").get<std::uint64_t>(),
            .owned = json.at("owned").get<std::uint64_t>(),
            .faces = json.at("faces").get<std::uint64_t>(),
            .files = {}};
  if (part.owned > part.vertices) {
    raise(ErrorCode::MalformedIndex, fmt::format("a part that owns {} of its {} vertices", part.owned, part.vertices));
  }
  for (const std::string_view name : kPartFiles) {
    const Json& file = json.at("files").at(std::string(name));
    part.files.push_back(
        {std::string(name), file.at("bytes").get<std::uint64_t>(), number_of(file.at("checksum").get<std::string>())});
  }
  return part;
}

void check_counts(const Manifest& manifest) {
  if (manifest.parts.size() != manifest.plan.parts) {
    raise(ErrorCode::MalformedIndex, fmt::format("lists {} parts of {}", manifest.parts.size(), manifest.plan.parts));
  }
  const std::uint64_t owned = std::accumulate(manifest.parts.begin(), manifest.parts.end(), std::uint64_t{0},
                                              [](std::uint64_t sum, const Part& part) { return sum + part.owned; });
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

void write_part(const std::filesystem::path& part_folder, const Plan& plan, std::size_t number, const Part& part) {
  write_json(part_folder / kPartFile, {{"plan", to_json(plan)}, {"number", number}, {"part", to_json(part)}});
}

std::optional<Part> read_part(const std::filesystem::path& part_folder, const Plan& plan, std::size_t number) {
  const std::filesystem::path file = part_folder / kPartFile;
  std::error_code unknown;
  if (!std::filesystem::exists(file, unknown)) return std::nullopt;
  return read_json(file, [&](const Json& json) {
    if (plan_from(json.at("plan")) != plan || json.at("number").get<std::size_t>() != number) {
      raise(ErrorCode::MalformedIndex, "is a part of another mesh, or of another number of parts or halo");
    }
    return part_from(json.at("part"));
  });
}

void verify_part(const std::filesystem::path& part_folder, const Part& part) {
  for (const PartFile& expected : part.files) {
    const std::filesystem::path file = part_folder / expected.name;
    const PartFile found = describe_file(part_folder, expected.name);
    if (found.bytes != expected.bytes) {
      refuse(file, fmt::format("has {} bytes, but the manifest says {}", found.bytes, expected.bytes));
    }
    if (found.checksum != expected.checksum) {
      refuse(file, fmt::format("has the checksum {}, but the manifest says {}: it has been changed, or is of another "
                               "mesh",
                               hex(found.checksum), hex(expected.checksum)));
    }
  }
}

void write_manifest(const std::filesystem::path& folder, const Manifest& manifest) {
  Json parts = Json::array();
  for (const Part& part : manifest.parts) parts.push_back(to_json(part));
  write_json(folder / kManifestFile, {{"plan", to_json(manifest.plan)}, {"parts", std::move(parts)}});
}

Manifest read_manifest(const std::filesystem::path& folder) {
  return read_json(folder / kManifestFile, [](const Json& json) {
    Manifest manifest{.plan = plan_from(json.at("plan")), .parts = {}};
    for (const Json& part : json.at("parts")) manifest.parts.push_back(part_from(part));
    check_counts(manifest);
    return manifest;
  });
}

}  // namespace meshhood::parts
