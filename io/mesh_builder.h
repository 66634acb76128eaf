// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "io/input_buffer.h"
#include "io/mesh_io.h"
#include "io/messages.h"

/// The arrays of a mesh that is being read.
namespace meshhood::inline v0_1::io {

/// Reads a coordinate into `value`. Returns nothing, or the problem: "is not a number", "is not finite", "is too
/// large". NaN is not finite, but becomes the value.
template <class Real>
[[nodiscard]] std::optional<std::string_view> to_coordinate(std::string_view token, Real& value);
template <class Real>
[[nodiscard]] std::optional<std::string_view> to_coordinate(double number, Real& value);

/// Appends to an array that will become large. Grows in larger steps than a vector does by itself: untouched memory
/// costs nothing, and a new array has to be filled again.
template <class T>
void append_many(std::vector<T>& array, std::span<const T> more) {
  const std::size_t size = array.size() + more.size();
  if (size > array.capacity()) array.reserve(std::max(size, 4 * array.size()));
  array.insert(array.end(), more.begin(), more.end());
}

/// Faces in order. Offsets are stored from the first face on that is not a triangle.
class Faces {
 public:
  void reserve_corners(std::uint64_t corners);
  void append_corner(std::uint32_t vertex) { corners_.push_back(vertex); }

  /// Ends a face of `corners` corners. The corners may be appended before or after.
  void end_face(std::uint64_t corners);

  void append(const Faces& faces);

  /// Appends `count` faces of as many corners each.
  void append(std::size_t count, std::span<const std::uint32_t> corners);

  void clear();

  [[nodiscard]] std::uint64_t size() const { return size_; }

  [[nodiscard]] std::vector<std::uint32_t>& corners() { return corners_; }
  [[nodiscard]] std::vector<std::uint64_t>& offsets() { return offsets_; }

 private:
  std::uint64_t size_ = 0;
  std::vector<std::uint64_t> offsets_;
  std::vector<std::uint32_t> corners_;
};

/// What rows of a file hold (see `PlainRows`).
template <class Real>
struct PlainBlock {
  std::size_t rows = 0;
  std::vector<Real> positions;
  Faces faces;
  bool float_keeps = false;      ///< all coordinates; only found out if it is true at first
  std::size_t most_missing = 0;  ///< how many vertices must precede, so that no face names one that follows it

  [[nodiscard]] std::size_t vertex_count() const { return positions.size() / 3; }
};

/// What a file says about the type of its coordinates.
enum class Declared { Float, FloatInText, Double, Nothing };

/// Positions in the chosen precision. They are *open* if they are double and may become float at the end: those of a
/// text that declares nothing, as long as float keeps every number.
class Positions {
 public:
  Positions(Precision precision, Declared declared);

  /// Reserves memory, so that appending does not copy.
  void reserve(std::uint64_t vertices);

  /// Appends the next coordinate, which may be NaN, or returns the problem as `to_coordinate`.
  [[nodiscard]] std::optional<std::string_view> append(std::string_view token);
  [[nodiscard]] std::optional<std::string_view> append(double number) { return append_as(number); }

  [[nodiscard]] bool are_double() const { return std::holds_alternative<std::vector<double>>(xyz_); }
  [[nodiscard]] bool are_open() const { return is_open_; }

  /// Float does not keep a number, unless `keeps`.
  void note(bool keeps) { is_open_ = is_open_ && keeps; }

  /// Appends coordinates that are valid.
  template <class Real>
  void append(std::span<const Real> scalars) {
    append_many(std::get<std::vector<Real>>(xyz_), scalars);
  }

  template <class Real>
  void append(const PlainBlock<Real>& block) {
    append(std::span<const Real>(block.positions));
    note(block.float_keeps);
  }

  /// Ends a vertex whose coordinates were appended one by one, the last of them at `location`.
  void end_vertex(const Location& location);

  /// Where the file has a vertex with NaN, if it is among the first of them: there may be any number.
  [[nodiscard]] std::optional<Location> location_of_nan(std::uint64_t vertex) const;

  /// Whether there is a vertex with NaN.
  [[nodiscard]] bool have_nan() const { return !nan_vertices_.empty(); }

  /// Sorts the last three coordinates into the order x, y, z. They were appended in ascending order of `ranks`, which
  /// has one value for each of x, y, z.
  void reorder_last(const std::array<std::size_t, 3>& ranks);

  /// The number of coordinates so far.
  [[nodiscard]] std::size_t scalar_count() const;
  [[nodiscard]] std::uint64_t vertex_count() const { return scalar_count() / 3; }

  [[nodiscard]] std::variant<std::vector<float>, std::vector<double>>& values() { return xyz_; }

 private:
  template <class Source>
  [[nodiscard]] std::optional<std::string_view> append_as(Source source);

  std::variant<std::vector<float>, std::vector<double>> xyz_;
  std::vector<std::pair<std::uint64_t, Location>> nan_vertices_;  // by ascending vertex
  bool is_open_;
};

/// 'x', 'y' or 'z': the axis of coordinate `scalar` in a list of positions.
[[nodiscard]] inline char axis(std::uint64_t scalar) { return "xyz"[scalar % 3]; }

/// Accepted deviations, each kind once. In strict mode the first is an error.
class Warnings {
 public:
  Warnings(std::string file, bool strict) : file_(std::move(file)), strict_(strict) {}

  /// Throws Error{MalformedFile} in strict mode.
  void add(std::string_view what, const Location& location, std::uint64_t count = 1);

  [[nodiscard]] std::vector<Warning>& list() { return list_; }

 private:
  std::string file_;
  bool strict_;
  std::vector<Warning> list_;
};

struct MeshBuilder {
  Positions positions;
  Faces faces;
  Warnings warnings;

  MeshBuilder(const InputBuffer& input, const ReadOptions& options, Declared declared);

  /// Moves the arrays out. Open positions become float unless that is coarse for the mesh. Warns if positions are float
  /// and that is coarse, also in strict mode: it is no deviation from the format.
  /// Vertices with NaN become walls, with a warning, or an error if a face has one.
  [[nodiscard]] Mesh finish(Format format);

 private:
  void place_vertices(Mesh& mesh);

  std::string file_;
  std::string_view way_out_;  // where float is coarse
};

/// Throws Error{TooLarge} if `vertices` exceeds `kMaxVertices`.
void check_vertex_count(std::uint64_t vertices, const std::string& file, const Location& location);

}  // namespace meshhood::inline v0_1::io
