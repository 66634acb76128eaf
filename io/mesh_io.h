// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "meshhood/mesh.h"
#include "meshhood/progress.h"

/// Mesh files in and out. Readers keep the file's numbering of the vertices and its polygons as they are.
namespace meshhood::io {

enum class Format { Ply, Obj, Off, Stl };

/// How coordinates are kept.
enum class Precision {
  FromFile,  ///< double where the file declares double (PLY), float elsewhere
  Float,     ///< rounded to float
  Double,    ///< as exact as the file's text or type
};

struct ReadOptions {
  Precision precision = Precision::FromFile;

  /// Refuse what is otherwise read with a warning.
  bool strict = false;

  /// Refuse a file of more bytes than this. Bounds endless devices too.
  std::uint64_t max_bytes = std::uint64_t{16} << 30;

  /// Called for each megabyte at least, and ten times a second while a pipe has nothing to read. Parts are bytes;
  /// without a size beforehand, as of a pipe, their total is 0.
  Progress progress = {};
};

/// Something odd that was accepted, how often, and where it was first seen.
struct Warning {
  std::string what;  ///< "bytes after the last element", ...
  std::uint64_t count = 1;
  std::string first_place;  ///< "line 12", "byte 1048621"
};

/// A mesh read from a file, owned.
struct Mesh {
  Format format = Format::Ply;
  std::variant<std::vector<float>, std::vector<double>> positions;  ///< #V by 3
  std::vector<std::uint64_t> offsets;                               ///< #F + 1, or empty where every face is a triangle
  std::vector<std::uint32_t> corners;                               ///< the corners of all faces, face after face
  std::vector<Warning> warnings;

  /// Borrows from this mesh.
  [[nodiscard]] MeshView view() const;
};

/// Reads a PLY (ascii or binary of either byte order), OBJ, OFF or STL (ascii or binary) file. The format is told by
/// content; the name's ending decides only where the content fits none or is empty. STL corners are welded by exact
/// equality of position (-0 equals 0), numbered in order of first appearance.
///
/// Peak memory is at most twice the decoded arrays and 64 MB. A count in a header allocates nothing before the bytes
/// that it promises are there. Parsing does not depend on the locale. No second file is ever opened.
/// Throws Error{IoFailure, MalformedFile, UnsupportedFormat, TooLarge, InvalidMesh, Cancelled}: one line that begins
/// with the file and the line and column, or byte, and names the element and what was expected.
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& path, const ReadOptions& options = {});

/// The same on bytes in memory. `name` stands for the file in messages, and its ending is the hint of the format.
[[nodiscard]] Mesh read_mesh(std::span<const std::byte> bytes, const std::string& name,
                             const ReadOptions& options = {});

/// A column that a written PLY gives its vertices beside the position.
struct VertexProperty {
  std::string name;               ///< a PLY property name: no blanks
  std::span<const float> values;  ///< #V
};

struct PlyOptions {
  std::span<const std::uint8_t> colors = {};  ///< #V by 3 (red, green, blue), or empty
  std::vector<VertexProperty> properties = {};
  bool ascii = false;  ///< binary little-endian otherwise

  /// Called every some thousand rows, and once more when all is on the disk, just before the file takes its name. Parts
  /// are vertices and faces.
  Progress progress = {};
};

/// Writes `mesh` as PLY, positions in their own precision. The file appears whole or not at all: it is written beside
/// the target under another name and renamed.
///
/// Throws Error{InvalidMesh, InvalidOption, IoFailure, Cancelled}; the old file is then as it was.
void write_ply(const std::filesystem::path& path, const MeshView& mesh, const PlyOptions& options = {});

}  // namespace meshhood::io
