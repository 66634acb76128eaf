// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "meshhood/fingerprint.h"

/// The contents of a folder of parts. docs/scale.md describes the files.
namespace meshhood::parts {

inline constexpr std::string_view kManifestFile = "manifest.json";

/// The mesh that was partitioned, and the options: the same for all parts of a folder.
struct Plan {
  std::uint64_t vertices = 0;
  std::uint64_t faces = 0;
  bool is_double = false;
  Fingerprint content_hash;     ///< of positions and faces, in the order of the mesh
  double mean_edge_length = 0;  ///< of the whole mesh
  double halo = 0;              ///< in the unit of the positions
  std::size_t parts = 0;

  friend bool operator==(const Plan&, const Plan&) = default;
};

/// A file of a part.
struct PartFile {
  std::string name;
  std::uint64_t bytes = 0;
  std::uint64_t checksum = 0;  ///< XXH3 (64 bits)

  friend bool operator==(const PartFile&, const PartFile&) = default;
};

/// A part, in a folder of its own.
struct Part {
  std::uint64_t vertices = 0;  ///< with the halo and the fringe
  std::uint64_t owned = 0;
  std::uint64_t faces = 0;
  std::vector<PartFile> files;
};

struct Manifest {
  Plan plan;
  std::vector<Part> parts;
  std::uint64_t checksum = 0;  ///< of the file that was read, and so of every file that it lists
};

/// The name of the folder of a part: part-00012.
[[nodiscard]] std::string part_name(std::size_t part);

/// The files of a part.
inline constexpr std::string_view kIndexFile = "index.mhi";
inline constexpr std::string_view kVerticesFile = "vertices.npy";
inline constexpr std::string_view kOwnedFile = "owned.npy";
inline constexpr std::string_view kCornersFile = "face_corners.npy";
inline constexpr std::string_view kOffsetsFile = "face_offsets.npy";
inline constexpr std::array kPartFiles{kIndexFile, kVerticesFile, kOwnedFile, kCornersFile, kOffsetsFile};
inline constexpr std::string_view kPartFile = "part.json";

/// Size and checksum of a file. Throws Error{IoFailure}. O(bytes).
[[nodiscard]] PartFile describe_file(const std::filesystem::path& folder, std::string_view name);

/// Writes PART_FOLDER/part.json. Throws Error{IoFailure}.
void write_part(const std::filesystem::path& part_folder, const Plan& plan, std::size_t number, const Part& part);

/// Reads PART_FOLDER/part.json; nothing if there is none.
/// Throws Error{MalformedIndex} if it has been changed or belongs to another plan or number.
[[nodiscard]] std::optional<Part> read_part(const std::filesystem::path& part_folder, const Plan& plan,
                                            std::size_t number);

/// What PART_FOLDER/part.json says of the whole mesh; nothing if there is none.
/// Throws Error{MalformedIndex} if it has been changed.
[[nodiscard]] std::optional<Plan> read_plan(const std::filesystem::path& part_folder);

/// Throws Error{MalformedIndex}, naming the file, unless it has the size.
void verify_size(const std::filesystem::path& file, std::uint64_t bytes, const PartFile& expected);

/// Throws Error{MalformedIndex}, naming the file, unless its content has the size and checksum.
void verify_file(const std::filesystem::path& file, std::span<const std::byte> content, const PartFile& expected);

/// Writes FOLDER/manifest.json atomically. Throws Error{IoFailure}.
void write_manifest(const std::filesystem::path& folder, const Manifest& manifest);

/// Reads FOLDER/manifest.json and verifies that it has not been changed and agrees with itself. The files that it lists
/// are not read. Throws Error{IoFailure, MalformedIndex}, naming the file.
[[nodiscard]] Manifest read_manifest(const std::filesystem::path& folder);

}  // namespace meshhood::parts
