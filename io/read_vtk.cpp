// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <string>
#include <utility>

#include "io/binary.h"
#include "io/mesh_builder.h"
#include "io/number.h"
#include "io/readers.h"
#include "io/text.h"

// VTK's legacy format: lines of words, and behind some of them numbers, in text or as big-endian bytes. POLYDATA is
// read, and UNSTRUCTURED_GRID, as which meshio writes surfaces, if all cells are faces. Until version 4, cells are
// lists of a number of corners and these corners; from version 5 on, an array of offsets and one of corners. What
// follows the first values of points or cells belongs to these, and is not read.

namespace meshhood::inline v0_1::io {
namespace {

using std::uint64_t;

/// The size of a number by the name of its type; 0 if it is none.
std::size_t size_of_type(std::string_view type) {
  using Size = std::pair<std::string_view, std::size_t>;
  constexpr std::array kSizes{Size{"char", 1},          Size{"signed_char", 1},  Size{"unsigned_char", 1},
                              Size{"vtktypeuint8", 1},  Size{"short", 2},        Size{"unsigned_short", 2},
                              Size{"int", 4},           Size{"unsigned_int", 4}, Size{"vtkidtype", 4},
                              Size{"vtktypeint32", 4},  Size{"float", 4},        Size{"long", 8},
                              Size{"unsigned_long", 8}, Size{"vtktypeint64", 8}, Size{"long_long", 8},
                              Size{"vtktypeuint64", 8}, Size{"double", 8}};
  for (const auto& [name, size] : kSizes) {
    if (name == type) return size;
  }
  return 0;
}

/// Words and numbers of a file in turn.
class VtkValues {
 public:
  explicit VtkValues(InputBuffer& input) : text_(input, {.line_end = '\n'}) {}

  void set_binary(bool is_binary) { is_binary_ = is_binary; }
  [[nodiscard]] bool are_binary() const { return is_binary_; }

  /// The next word in lower case; empty at the end of the file.
  [[nodiscard]] std::string word() {
    begin_ = text_.input().offset();
    return lower_case(std::string(text_.token()));
  }

  [[nodiscard]] uint64_t count(std::string_view what) {
    const std::string token(text_.token());
    const auto value = parse_count(token);
    if (!value) malformed("expected the number of {}, found {}", what, quote(token));
    return *value;
  }

  void skip_mark() {
    if (!text_.input().ahead(kVtkMark.size()).starts_with(kVtkMark)) malformed("expected {}", quote(kVtkMark));
    for (int word = 0; word < 4; ++word) text_.token();
  }

  void skip_line() {
    text_.next_line();
    text_.skip_line();
  }

  /// To the next line without words.
  void skip_paragraph() {
    while (text_.next_line() && !text_.at_line_end()) {
    }
  }

  /// Before `count` numbers of `bytes` bytes each. The file must be long enough for them.
  void begin_numbers(uint64_t count, std::size_t bytes, std::string_view what) {
    const std::size_t least = is_binary_ ? bytes : 2;  // a digit and a blank
    const auto left = text_.input().left();
    if (left && count > (*left + 1) / least) {
      malformed("{} {}, but {} bytes are left", count, what, *left);
    }
    if (is_binary_) text_.finish_line();
  }

  /// Appends a coordinate of the type `Real`; or returns the problem.
  template <class Real>
  [[nodiscard]] std::optional<std::string> append_to(Positions& positions) {
    if (is_binary_) return std::optional<std::string>(positions.append(double{binary<Real>()}));
    const std::string token(text());
    const auto problem = positions.append(token);
    return problem ? std::optional(fmt::format("= {} {}", quote(token), *problem)) : std::nullopt;
  }

  [[nodiscard]] std::int64_t integer(std::size_t bytes) {
    if (is_binary_) return bytes == sizeof(std::int32_t) ? binary<std::int32_t>() : binary<std::int64_t>();
    const auto token = text();
    const auto value = parse_integer(token);
    if (!value) malformed("expected an integer, found {}", quote(token));
    return *value;
  }

  void skip(uint64_t count, std::size_t bytes) {
    for (uint64_t i = 0; i < count; ++i) {
      if (!is_binary_) {
        static_cast<void>(text());
      } else {
        for (std::size_t byte = 0; byte < bytes; ++byte) static_cast<void>(binary<char>());
      }
    }
  }

  /// In text, each is a line. In bytes, each begins with its length, and this with two bits that say how long it is.
  void skip_strings(uint64_t count) {
    if (is_binary_) text_.finish_line();
    for (uint64_t i = 0; i < count; ++i) {
      if (!is_binary_) {
        if (!text_.next_line()) malformed("the file ends here");
        text_.skip_line();
        continue;
      }
      const auto first = binary<std::uint8_t>();
      uint64_t length = first & 0x3fU;
      for (int more = std::array{7, 3, 1, 0}[first >> 6U]; more != 0; --more) {
        length = length << 8U | binary<std::uint8_t>();
      }
      skip(length, 1);
    }
  }

  [[nodiscard]] uint64_t most_numbers(std::size_t bytes) const {
    return text_.input().left().value_or(0) / (is_binary_ ? bytes : 2);
  }

  [[nodiscard]] Location location() const { return is_binary_ ? Location{.byte = begin_} : text_.location(); }
  [[nodiscard]] const std::string& file() const { return text_.input().name(); }

  [[noreturn]] void fail(ErrorCode code, std::string_view message) const { fail_at(file(), location(), code, message); }

  template <class... Args>
  [[noreturn]] void malformed(fmt::format_string<Args...> format, Args&&... args) const {
    fail(ErrorCode::MalformedFile, fmt::format(format, std::forward<Args>(args)...));
  }

 private:
  template <class T>
  [[nodiscard]] T binary() {
    begin_ = text_.input().offset();
    T value = {};
    if (!load(text_.input(), std::endian::big, value)) malformed("the file ends here");
    return value;
  }

  [[nodiscard]] std::string_view text() {
    const auto token = text_.token();
    if (token.empty()) malformed("the file ends here");
    return token;
  }

  Text text_;
  bool is_binary_ = false;
  uint64_t begin_ = 0;  // of the last value of a binary file, or of the line before it
};

class VtkReader {
 public:
  VtkReader(InputBuffer& input, const ReaderOptions& options)
      : values_(input),
        has_offsets_(read_header()),
        vertices_(find_points()),
        type_(values_.word()),
        builder_(input, options, declared()) {}

  Mesh read() {
    if (type_ == "double") {
      read_points<double>();
    } else {
      read_points<float>();
    }
    for (std::string word = values_.word(); !word.empty() && !word.ends_with("_data"); word = values_.word()) {
      read_section(word);
    }
    if (need_types_) values_.malformed("the cells have no types, expected CELL_TYPES");
    return builder_.finish(Format::Vtk);
  }

 private:
  /// Returns whether cells have offsets.
  bool read_header() {
    values_.skip_mark();
    const std::string version = values_.word();
    if (version.find_first_of("12345") != 0)
      values_.malformed("expected a version from 1 to 5, found {}", quote(version));
    values_.skip_line();  // a title
    const std::string encoding = values_.word();
    if (encoding != "ascii" && encoding != "binary") {
      values_.malformed("expected ASCII or BINARY, found {}", quote(encoding));
    }
    expect("dataset");
    const std::string set = values_.word();
    if (set != "polydata" && set != "unstructured_grid") {
      values_.fail(ErrorCode::UnsupportedFormat,
                   fmt::format("{} is not supported, expected POLYDATA or UNSTRUCTURED_GRID", quote(set)));
    }
    values_.set_binary(encoding == "binary");
    return version.starts_with('5');
  }

  void expect(std::string_view word) {
    const std::string found = values_.word();
    if (found != word) values_.malformed("expected {}, found {}", word, quote(found));
  }

  uint64_t find_points() {
    for (std::string word = values_.word(); word != "points"; word = values_.word()) {
      if (!skip_section(word)) values_.malformed("expected POINTS, found {}", quote(word));
    }
    const uint64_t points = values_.count("points");
    check_vertex_count(points, values_.file(), values_.location());
    return points;
  }

  [[nodiscard]] Declared declared() const {
    if (type_ == "double") return Declared::Double;
    if (type_ == "float") return values_.are_binary() ? Declared::Float : Declared::FloatInText;
    values_.fail(ErrorCode::UnsupportedFormat,
                 fmt::format("points of type {} are not supported, expected float or double", quote(type_)));
  }

  template <class Real>
  void read_points() {
    values_.begin_numbers(3 * vertices_, sizeof(Real), "coordinates");
    builder_.positions.reserve(std::min(vertices_, values_.most_numbers(sizeof(Real))));
    for (uint64_t i = 0; i < 3 * vertices_; ++i) {
      if (const auto problem = values_.append_to<Real>(builder_.positions)) {
        values_.malformed("point {}, {} {}", i / 3, axis(i), *problem);
      }
      if (i % 3 == 2) builder_.positions.end_vertex(values_.location());
    }
  }

  void read_section(const std::string& word) {
    if (skip_section(word)) return;
    if (word == "cell_types") return check_types();
    const bool are_faces = word == "polygons" || word == "cells";
    if (!are_faces && word != "vertices" && word != "lines" && word != "triangle_strips") {
      values_.malformed("expected POLYGONS or another section of cells, found {}", quote(word));
    }
    const uint64_t first = values_.count("cells");
    const uint64_t second = values_.count("numbers");
    if (!are_faces && (has_offsets_ ? second : first) != 0) {
      values_.fail(ErrorCode::UnsupportedFormat, fmt::format("{} are not supported, expected only POLYGONS", word));
    }
    if (has_offsets_) {
      read_arrays(first, second);
    } else {
      read_lists(first, second);
    }
    need_types_ = word == "cells" && builder_.faces.size() != 0;
  }

  /// What may stand anywhere.
  bool skip_section(const std::string& word) {
    if (word == "metadata") {
      values_.skip_paragraph();
    } else if (word == "field") {
      static_cast<void>(values_.word());
      for (uint64_t left = values_.count("arrays"); left != 0;) left -= skip_array() ? 1U : 0U;
    } else {
      return false;
    }
    return true;
  }

  /// Of a field: false for what describes the array before.
  bool skip_array() {
    const std::string name = values_.word();
    if (name == "metadata") return !skip_section(name);
    const uint64_t components = values_.count("components");
    const uint64_t rows = values_.count("rows");
    const std::string type = values_.word();
    const std::size_t bytes = size_of_type(type);
    if (bytes == 0 && type != "string") {
      values_.fail(ErrorCode::UnsupportedFormat, fmt::format("values of type {} are not supported", quote(type)));
    }
    constexpr uint64_t kMost = uint64_t{1} << 31U;  // of either, so that the product fits
    if (components >= kMost || rows >= kMost) values_.malformed("{} by {} values are too many", components, rows);
    if (bytes == 0) {
      values_.skip_strings(components * rows);
      return true;
    }
    values_.begin_numbers(components * rows, bytes, "values");
    values_.skip(components * rows, bytes);
    return true;
  }

  /// `numbers`: of all cells, the number of corners of each and the corners.
  void read_lists(uint64_t cells, uint64_t numbers) {
    constexpr std::size_t kBytes = sizeof(std::int32_t);
    values_.begin_numbers(numbers, kBytes, "numbers of cells");
    builder_.faces.reserve_corners(std::min(numbers - std::min(cells, numbers), values_.most_numbers(kBytes)));
    for (uint64_t cell = 0; cell < cells; ++cell) {
      if (numbers == 0) values_.malformed("{} of {} cells are in the numbers that are declared", cell, cells);
      const std::int64_t corners = values_.integer(kBytes);
      --numbers;
      if (corners < 0 || static_cast<uint64_t>(corners) > numbers) {
        values_.malformed("face {} has {} corners, but {} numbers are left", cell, corners, numbers);
      }
      numbers -= static_cast<uint64_t>(corners);
      for (std::int64_t i = 0; i < corners; ++i) append_corner(values_.integer(kBytes), cell);
      builder_.faces.end_face(static_cast<uint64_t>(corners));
    }
    if (numbers != 0) values_.malformed("{} more numbers than the {} faces have", numbers, cells);
  }

  void read_arrays(uint64_t offsets, uint64_t corners) {
    const std::size_t offset_bytes = begin_array("offsets", offsets);
    uint64_t last = 0;
    for (uint64_t i = 0; i < offsets; ++i) {
      const std::int64_t offset = values_.integer(offset_bytes);
      const bool is_valid = i == 0 ? offset == 0 : offset >= 0 && last <= static_cast<uint64_t>(offset);
      if (!is_valid || static_cast<uint64_t>(offset) > corners) {
        values_.malformed("offset {} = {}, expected 0 first, then ascending values up to {}", i, offset, corners);
      }
      if (i != 0) builder_.faces.end_face(static_cast<uint64_t>(offset) - last);
      last = static_cast<uint64_t>(offset);
    }
    if (last != corners) values_.malformed("the last offset is {}, expected {}", last, corners);
    const std::size_t corner_bytes = begin_array("connectivity", corners);
    builder_.faces.reserve_corners(std::min(corners, values_.most_numbers(corner_bytes)));
    for (uint64_t i = 0; i < corners; ++i) append_corner(values_.integer(corner_bytes), std::nullopt);
  }

  /// Returns the size of a number.
  std::size_t begin_array(std::string_view name, uint64_t numbers) {
    std::string found = values_.word();
    while (skip_section(found)) found = values_.word();
    if (found != name) values_.malformed("expected {}, found {}", name, quote(found));
    const std::string type = values_.word();
    const std::size_t bytes = size_of_type(type);
    if (bytes < sizeof(std::int32_t) || type == "float" || type == "double") {
      values_.malformed("{} of type {}, expected vtktypeint64 or vtktypeint32", name, quote(type));
    }
    values_.begin_numbers(numbers, bytes, name);
    return bytes;
  }

  void append_corner(std::int64_t vertex, std::optional<uint64_t> face) {
    if (vertex < 0 || static_cast<uint64_t>(vertex) >= vertices_) {
      const auto corner = builder_.faces.corners().size();
      const std::string where = face ? fmt::format("face {}", *face) : fmt::format("corner {}", corner);
      values_.malformed("{} names vertex {}, but there are {} vertices", where, vertex, vertices_);
    }
    builder_.faces.append_corner(static_cast<std::uint32_t>(vertex));
  }

  /// Of the cells of a grid.
  void check_types() {
    constexpr std::array kFaces{5, 7, 9};  // triangle, polygon, quad
    const uint64_t cells = values_.count("cells");
    if (cells != builder_.faces.size()) values_.malformed("{} types of {} cells", cells, builder_.faces.size());
    need_types_ = false;
    values_.begin_numbers(cells, sizeof(std::int32_t), "types of cells");
    for (uint64_t cell = 0; cell < cells; ++cell) {
      const std::int64_t type = values_.integer(sizeof(std::int32_t));
      if (std::find(kFaces.begin(), kFaces.end(), type) != kFaces.end()) continue;
      values_.fail(ErrorCode::UnsupportedFormat,
                   fmt::format("cell {} has type {}, expected a surface: triangles (5), polygons (7) and quads (9)",
                               cell, type));
    }
  }

  VtkValues values_;
  bool has_offsets_;
  uint64_t vertices_;
  std::string type_;
  MeshBuilder builder_;
  bool need_types_ = false;  // cells of a grid, which may be solids, without types so far
};

}  // namespace

Mesh read_vtk(InputBuffer& input, const ReaderOptions& options) { return VtkReader(input, options).read(); }

}  // namespace meshhood::inline v0_1::io
