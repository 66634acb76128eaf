// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "meshhood/export.h"
#include "meshhood/mesh.h"
#include "meshhood/mesh_data.h"
#include "meshhood/run.h"

/// Reading and writing mesh files. Readers keep the vertex numbering and the polygons of the file.
namespace meshhood::inline v0_1::io {
MESHHOOD_API_BEGIN

enum class Format {
  Ply,
  Obj,
  Off,
  Stl,
  Vtk,
  FreeSurfer,
  Other,  ///< of a mesh that another library has read
};

/// The precision of the coordinates in memory.
enum class Precision {
  FromFile,  ///< as the file declares (PLY, binary STL, VTK, FreeSurfer); of other text float if that keeps what is
             ///< written, else double
  Float,     ///< rounded to float
  Double,    ///< the double nearest to the text or value in the file
};

struct ReadOptions {
  Precision precision = Precision::FromFile;

  /// Throw an error instead of recording that a deviation was accepted.
  bool strict = false;

  /// As in `Run`. The mesh, its warnings and errors do not depend on it.
  unsigned threads = kAllProcessors;

  /// Refuse a file of more bytes. Also limits endless devices.
  std::uint64_t max_bytes = std::uint64_t{16} << 30;

  /// Called on the calling thread, at least once per 4 MB, and ten times a second while a pipe has nothing to read.
  /// Counts bytes; the total is 0 if the size is unknown (a pipe).
  Progress progress = {};
};

/// A deviation from the format that was accepted, or that float is coarse for the mesh.
struct Warning {
  std::string what;         ///< "data after the last element", ...
  std::uint64_t count = 1;  ///< how often it occurs
  std::string first_place;  ///< where it occurs first: "line 12", "byte 1048621"; empty if it concerns the whole mesh

  /// All in a sentence: "line 12: data after the last element (3 times)".
  [[nodiscard]] std::string text() const;
};

/// A mesh read from a file.
struct Mesh : MeshData {
  Format format = Format::Ply;
  std::vector<Warning> warnings;

  /// #V, or empty if there are none: 1 for each vertex without a position, for `masked`. Such a vertex is in no face,
  /// and `positions` has it where another vertex is.
  std::vector<std::uint8_t> walls;
};

/// Reads a PLY (ASCII or binary of either byte order), OBJ, OFF or STL (ASCII or binary) file, the polygons of VTK's
/// legacy format (ASCII or binary; polygonal data, or an unstructured grid of faces) or the triangles of FreeSurfer, in
/// the coordinates of the surface. The format is detected by content; the extension is used only if the content fits no
/// format or is empty. STL corners are welded by exact equality of positions (-0 equals 0) and numbered in order of
/// first appearance.
///
/// The coordinates of OBJ, OFF and STL text are read as double. They are stored as float if each float, printed with
/// the digits that were written or with the fewest that tell it from others, is the number in the file; if vertices of
/// an STL at different positions remain so; and if the mean edge is at least 64 times as long as the distance of
/// neighboring floats at the largest coordinate. Where float is chosen otherwise and edges are shorter, a warning says
/// so.
///
/// A vertex whose position is NaN, as scanners and depth cameras mark holes, is a wall if no face has it (see
/// `Mesh::walls`), with a warning; otherwise it is an error.
///
/// If each row of an ASCII PLY file has a line of its own, further numbers in the line are skipped with a warning, and
/// fewer are an error. Otherwise rows may run over lines and share them, and there must be exactly as many numbers as
/// the header declares. Where more than 16 MiB follow the first row that ends within a line, rows are taken for lines.
///
/// Peak memory is at most twice the decoded arrays plus 64 MB, where positions in text count as double. A count in a
/// header allocates no memory unless the file is long enough for it. Parsing does not depend on the locale. No other
/// file is opened.
/// Throws Error{IoFailure, MalformedFile, UnsupportedFormat, TooLarge, InvalidMesh, InvalidOption, Cancelled}: one line
/// with the file, the line and column or the byte, the element, its value and what was expected.
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& path, const ReadOptions& options = {});

/// The same for bytes in memory. `name` is the file in messages; its extension is used as that of a file.
[[nodiscard]] Mesh read_mesh(std::span<const std::byte> bytes, const std::string& name,
                             const ReadOptions& options = {});

/// Throws Error{InvalidMesh} if the mesh has vertices without a position: for what stores a mesh without its walls.
/// `name` is the file in the message.
void refuse_walls(const Mesh& mesh, const std::string& name);

/// Throws the same about one vertex.
[[noreturn]] void refuse_wall(std::uint64_t vertex, const std::string& name);

/// An additional value, or vector, for each vertex of a written file.
struct VertexProperty {
  std::string name;        ///< printable ASCII without blanks
  Borrowed<float> values;  ///< #V; or #V by 3: in PLY the properties NAME_x, NAME_y and NAME_z
};

struct PlyOptions {
  Borrowed<std::uint8_t> colors = {};  ///< #V by 3 (red, green, blue), or empty
  std::vector<VertexProperty> properties = {};
  Borrowed<std::uint8_t> walls = {};  ///< #V, or empty: not 0 for vertices to be written as NaN (see `Mesh::walls`)
  bool ascii = false;                 ///< binary little-endian otherwise

  /// Called every few thousand rows, and once more when the data is on the disk, just before the rename. Counts
  /// vertices and faces.
  Progress progress = {};
};

/// Writes `mesh` as PLY, with positions in their own precision. The file is written atomically: to a temporary file
/// beside the target, which is renamed.
///
/// Throws Error{InvalidMesh, InvalidOption, IoFailure, Cancelled}; the old file is then unchanged.
void write_ply(const std::filesystem::path& path, const MeshView& mesh, const PlyOptions& options = {});

struct VtkOptions {
  std::vector<VertexProperty> properties = {};  ///< ParaView and PyVista show the first at once, if it is a scalar

  // As in `PlyOptions`.
  Borrowed<std::uint8_t> walls = {};
  Progress progress = {};
};

/// Writes `mesh` as VTK polygonal data, in the binary legacy format 4.2, with the properties as point data; otherwise
/// as `write_ply`. Throws also Error{TooLarge}: the format counts in 31 bits.
void write_vtk(const std::filesystem::path& path, const MeshView& mesh, const VtkOptions& options = {});

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1::io
