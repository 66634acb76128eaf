// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "io/input.h"
#include "io/mesh_io.h"
#include "io/place.h"

/// A mesh while it is read: arrays that grow as the bytes arrive.
namespace meshhood::io {

/// Reads a coordinate into `value`. Nothing, or why it is none: "is not a number", "is not finite", "is too large".
template <class Real>
[[nodiscard]] std::optional<std::string_view> to_coordinate(std::string_view token, Real& value);
template <class Real>
[[nodiscard]] std::optional<std::string_view> to_coordinate(double number, Real& value);

/// Positions in the precision chosen for the file.
class Positions {
 public:
  explicit Positions(bool as_double) {
    if (as_double) xyz_.emplace<std::vector<double>>();
  }

  /// Makes room for `vertices` in one piece, so that growing copies nothing.
  void reserve(std::uint64_t vertices);

  /// Appends the next coordinate, where `to_coordinate` makes one of it.
  [[nodiscard]] std::optional<std::string_view> append(std::string_view token) { return append_as(token); }
  [[nodiscard]] std::optional<std::string_view> append(double number) { return append_as(number); }

  /// Puts the last three coordinates in the order x, y, z. `ranks` has what x, y and z are sorted by as they stand.
  void reorder_last(const std::array<std::size_t, 3>& ranks);

  /// The number of coordinates so far.
  [[nodiscard]] std::size_t scalar_count() const;
  [[nodiscard]] std::uint64_t vertex_count() const { return scalar_count() / 3; }

  [[nodiscard]] std::variant<std::vector<float>, std::vector<double>>& values() { return xyz_; }

 private:
  template <class Source>
  [[nodiscard]] std::optional<std::string_view> append_as(Source source);

  std::variant<std::vector<float>, std::vector<double>> xyz_;
};

/// 'x', 'y' or 'z', for coordinate `scalar` of a list of positions.
[[nodiscard]] inline char axis(std::uint64_t scalar) { return "xyz"[scalar % 3]; }

/// Faces one after the other. The offsets are written from the first face on that is no triangle.
class Faces {
 public:
  void reserve_corners(std::uint64_t corners);
  void append_corner(std::uint32_t vertex) { corners_.push_back(vertex); }

  /// Makes the next `corners` corners a face, be they appended already or not.
  void end_face(std::uint64_t corners);

  [[nodiscard]] std::uint64_t size() const { return size_; }

  [[nodiscard]] std::vector<std::uint32_t>& corners() { return corners_; }
  [[nodiscard]] std::vector<std::uint64_t>& offsets() { return offsets_; }

 private:
  std::uint64_t size_ = 0;
  std::vector<std::uint64_t> offsets_;
  std::vector<std::uint32_t> corners_;
};

/// What was odd but accepted, each kind once. In strict mode the first is an error.
class Warnings {
 public:
  Warnings(std::string file, bool strict) : file_(std::move(file)), strict_(strict) {}

  /// Throws Error{MalformedFile} in strict mode.
  void add(std::string_view what, const Place& place, std::uint64_t count = 1);

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

  MeshBuilder(const Input& input, const ReadOptions& options, bool file_has_doubles);

  /// Hands the arrays over.
  [[nodiscard]] Mesh finish(Format format);
};

/// Throws Error{TooLarge} where a mesh of `vertices` vertices has no place in memory or in an id.
void check_vertex_count(std::uint64_t vertices, const std::string& file, const Place& place);

}  // namespace meshhood::io
