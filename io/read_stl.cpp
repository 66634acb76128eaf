// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "io/binary.h"
#include "io/float_keeps.h"
#include "io/mesh_builder.h"
#include "io/plain_rows.h"
#include "io/plain_text.h"
#include "io/readers.h"
#include "io/text.h"
#include "io/welder.h"

// A file of the size of a binary STL is binary, even if it begins with "solid", as many do. In a longer one, each facet
// is followed by as many bytes as its last two say; in others, programs keep a color there.

namespace meshhood::inline v0_1::io {
namespace {

using std::uint64_t;

constexpr std::size_t kHeaderBytes = 84;
constexpr std::size_t kFacetBytes = 50;
constexpr std::size_t kNormalBytes = 12;

template <class T>
T number_in(std::string_view bytes, std::size_t place) {
  return number_at<T>(bytes.substr(place).data(), std::endian::little);
}

std::uint32_t facet_count(std::string_view header) { return number_in<std::uint32_t>(header, kHeaderBytes - 4); }

uint64_t binary_size(std::string_view header) { return kHeaderBytes + kFacetBytes * uint64_t{facet_count(header)}; }

bool is_text(std::string_view bytes) {
  return std::all_of(bytes.begin(), bytes.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte >= 0x20 || ('\t' <= c && c <= '\r');
  });
}

std::string why_not_binary(InputBuffer& input) {
  const auto header = input.ahead(kHeaderBytes);
  if (header.size() < kHeaderBytes) return "it is not a binary STL, which has at least 84 bytes";
  return fmt::format("it is not a binary STL, which would have {} bytes for the {} facets of its header",
                     binary_size(header), facet_count(header));
}

// Appends a facet of an ASCII or binary file.
template <class Real>
void append_triangle(const std::array<std::array<Real, 3>, 3>& corners, const Location& location, MeshBuilder& builder,
                     Welder<Real>& weld) {
  const auto& [a, b, c] = corners;
  if (a == b || b == c || c == a) builder.warnings.add("facets in which two corners coincide", location);
  for (const auto& corner : corners) weld.append(corner);
  builder.faces.end_face(3);
}

template <class Real>
class BinaryStl {
 public:
  BinaryStl(InputBuffer& input, MeshBuilder& builder, Welder<Real>& welder)
      : input_(input), builder_(builder), welder_(welder) {}

  void read() {
    const auto facets = facet_count(input_.ahead(kHeaderBytes));
    input_.skip(kHeaderBytes);
    was_size_known_ = input_.left().has_value();
    are_followed_ = input_.left().value_or(0) > kFacetBytes * uint64_t{facets};
    // A closed surface has half as many vertices as triangles. The file has as many bytes as its header says, if the
    // number is known.
    if (const auto left = input_.left()) welder_.expect(static_cast<std::size_t>(*left / kFacetBytes / 2));
    for (std::uint32_t facet = 0; facet < facets; ++facet) read_facet(facet, facets);
    if (!input_.ahead(1).empty()) judge_rest(facets);
  }

 private:
  using Corners = std::array<typename Welder<Real>::Point, 3>;

  void read_facet(std::uint32_t facet, std::uint32_t facets) {
    const auto bytes = input_.ahead(kFacetBytes);
    if (bytes.size() < kFacetBytes) {
      fail_at(input_.name(), {.byte = input_.offset()}, ErrorCode::MalformedFile,
              fmt::format("the file ends in facet {} of {}, {} facets are missing", facet, facets, facets - facet));
    }
    Corners corners;
    bool are_valid = true;
    for (std::size_t i = 0; i < 9; ++i) {
      const float number = coordinate(bytes, i);
      corners[i / 3][i % 3] = number;
      are_valid = are_valid && std::isfinite(number);
    }
    if (!are_valid) refuse(bytes, facet);
    append_triangle(corners, {.byte = input_.offset()}, builder_, welder_);
    const std::size_t payload = number_in<std::uint16_t>(bytes, kFacetBytes - 2);
    if (payload != 0) has_payload_ = true;
    input_.skip(kFacetBytes);
    if (payload != 0 && are_followed_) skip_payload(payload, facet);
  }

  void skip_payload(std::size_t bytes, std::uint32_t facet) {
    builder_.warnings.add("facets followed by bytes of their own", {.byte = input_.offset()});
    if (input_.ahead(bytes).size() < bytes) {
      fail_at(input_.name(), {.byte = input_.offset()}, ErrorCode::MalformedFile,
              fmt::format("facet {} says that {} bytes follow, and the file is shorter", facet, bytes));
    }
    input_.skip(bytes);
  }

  // Without facets, or if bytes may follow each, the rest may be part of the mesh.
  void judge_rest(std::uint32_t facets) {
    const Location location{.byte = input_.offset()};
    if (facets != 0 && !has_payload_) return builder_.warnings.add("bytes after the last facet", location);
    fail_at(input_.name(), location, ErrorCode::MalformedFile,
            fmt::format("bytes after the last of {} facets, expected {}{}", facets,
                        facets == 0 ? "the number of facets in the header" : "as many as the facets say", advice()));
  }

  /// Without the size, as from a pipe, bytes after a facet are not told from a color.
  [[nodiscard]] std::string_view advice() const {
    return has_payload_ && !was_size_known_
               ? "; facets followed by bytes are not read from a pipe: store them in a file"
               : "";
  }

  static float coordinate(std::string_view facet, std::size_t i) {
    return number_in<float>(facet, kNormalBytes + 4 * i);
  }

  [[noreturn]] void refuse(std::string_view bytes, std::uint32_t facet) const {
    std::size_t i = 0;
    while (std::isfinite(coordinate(bytes, i))) ++i;
    fail_at(input_.name(), {.byte = input_.offset() + kNormalBytes + 4 * i}, ErrorCode::MalformedFile,
            fmt::format("facet {}, vertex {}, {} is not finite{}", facet, i / 3, axis(i), advice()));
  }

  InputBuffer& input_;
  MeshBuilder& builder_;
  Welder<Real>& welder_;
  bool was_size_known_ = false;
  bool are_followed_ = false;  // by bytes that belong to them
  bool has_payload_ = false;   // a facet says so, or has a color
};

bool is_word(std::string_view token, std::string_view word) { return lower_case(std::string(token)) == word; }

// A plain facet: seven lines of lower-case words and single blanks, three corners at different positions.
struct FacetRow {
  static constexpr uint64_t kLines = 7;
  static constexpr std::string_view kInLastLine = "endfacet";

  template <class Real>
  const char* take(const char* at, const char* end, PlainBlock<Real>& block) const {
    std::array<typename Welder<Real>::Point, 3> facet = {};
    at = take_words(at, end, "facet normal ");
    for (int i = 0; i < 3; ++i) at = plain::skip_token(at);
    at = take_line(plain::take_line_end(at), end, "outer loop");
    for (auto& corner : facet) {
      at = take_words(at, end, "vertex ");
      for (Real& coordinate : corner) at = plain::take_coordinate(at, end, coordinate, block.float_keeps);
      at = plain::take_line_end(at);
      block.positions.insert(block.positions.end(), corner.begin(), corner.end());
    }
    at = take_line(take_line(at, end, "endloop"), end, "endfacet");
    const auto& [a, b, c] = facet;
    return at == nullptr || a == b || b == c || c == a ? nullptr : at;
  }

 private:
  static const char* take_words(const char* at, const char* end, std::string_view words) {
    if (at == nullptr || at == end) return nullptr;
    at = plain::skip_blanks(at);
    const std::string_view rest(at, static_cast<std::size_t>(end - at));
    return rest.starts_with(words) ? at + words.size() : nullptr;
  }

  static const char* take_line(const char* at, const char* end, std::string_view words) {
    return plain::take_line_end(take_words(at, end, words));
  }
};

// All facets of a text, of any number of solids and in any letter case. A solid may be empty. `end facet` as two words
// is read with a warning. The format allows only triangles: a facet of more vertices is kept as a polygon, so that no
// vertex is lost, and one of fewer is left out, both with a warning.
template <class Real>
class StlText {
 public:
  StlText(InputBuffer& input, const ReaderOptions& options, MeshBuilder& builder, Welder<Real>& weld)
      : text_(input, {}), plain_(text_, options, {}, builder.positions.are_open()), builder_(builder), weld_(weld) {}

  void read() {
    if (!is_word(text_.token(), "solid")) text_.malformed("expected 'solid'");
    text_.skip_line();
    for (;;) {
      take_plain_facets();
      const auto token = keyword();
      if (token.empty()) break;
      read_item(token);
    }
    // A text that only begins with "solid" is not an empty mesh.
    if (in_solid_ && facets_ == 0) text_.malformed("expected 'facet' or 'endsolid', but the file ends");
    if (in_solid_) builder_.warnings.add("no 'endsolid' at the end", text_.location());
  }

 private:
  void take_plain_facets() {
    plain_.take(std::numeric_limits<uint64_t>::max(), [this](const PlainBlock<Real>& block) {
      const auto& xyz = block.positions;
      for (std::size_t i = 0; i < xyz.size(); i += 3) weld_.append({xyz[i], xyz[i + 1], xyz[i + 2]});
      for (std::size_t i = 0; i < block.rows; ++i) builder_.faces.end_face(3);
      builder_.positions.note(block.float_keeps);
      facets_ += block.rows;
      return true;
    });
  }

  // The next token, with `end loop` as `endloop`.
  std::string_view keyword() {
    const auto token = text_.token();
    if (!is_word(token, "end")) return token;
    builder_.warnings.add("'end' is a word of its own", text_.location());
    const auto word = text_.token();
    for (const std::string_view known : {"endloop", "endfacet", "endsolid"}) {
      if (is_word(word, known.substr(3))) return known;
    }
    text_.malformed("expected 'loop', 'facet' or 'solid' after 'end', found {}", quote(word));
  }

  void read_item(std::string_view token) {
    if (is_word(token, "facet")) return read_facet();
    in_solid_ = is_word(token, "solid");
    if (!in_solid_ && !is_word(token, "endsolid")) {
      text_.malformed("expected 'facet', 'endsolid' or 'solid', found {}", quote(token));
    }
    text_.skip_line();  // the name
  }

  void read_facet() {
    const Location location = text_.location();
    auto token = text_.token();
    if (is_word(token, "normal")) {
      for (int i = 0; i < 3; ++i) text_.token();
      token = text_.token();
    }
    check(token, "outer");
    check(text_.token(), "loop");
    read_loop(location);
    check(keyword(), "endfacet");
    ++facets_;
  }

  void read_loop(const Location& location) {
    uint64_t count = 0;
    for (auto token = keyword(); !is_word(token, "endloop"); token = keyword()) {
      check(token, "vertex");
      const auto corner = read_corner(count);
      if (count == 3) append_first_three();
      if (count >= 3) weld_.append(corner);
      if (count < 3) first_[count] = corner;
      ++count;
    }
    if (count == 3) return append_triangle(first_, location, builder_, weld_);
    builder_.warnings.add(
        count < 3 ? "facets of fewer than three vertices are left out" : "facets of more than three vertices",
        location);
    if (count > 3) builder_.faces.end_face(count);
  }

  // Not before there is a fourth: a facet of fewer than three vertices is left out.
  void append_first_three() {
    for (const auto& corner : first_) weld_.append(corner);
  }

  typename Welder<Real>::Point read_corner(uint64_t count) {
    typename Welder<Real>::Point corner;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto token = text_.token();
      if (const auto problem = to_coordinate(token, corner[i])) {
        text_.malformed("facet {}, vertex {}, {} = {} {}", facets_, count, axis(i), quote(token), *problem);
      }
      if (builder_.positions.are_open()) builder_.positions.note(float_keeps(token, corner[i]));
    }
    return corner;
  }

  void check(std::string_view token, std::string_view expected) const {
    if (is_word(token, expected)) return;
    if (token.empty()) text_.malformed("facet {}: expected '{}', but the file ends", facets_, expected);
    text_.malformed("facet {}: expected '{}', found {}", facets_, expected, quote(token));
  }

  Text text_;
  PlainRows<Real, FacetRow> plain_;
  MeshBuilder& builder_;
  Welder<Real>& weld_;
  std::array<typename Welder<Real>::Point, 3> first_ = {};
  uint64_t facets_ = 0;
  bool in_solid_ = true;
};

// Reserves memory for the largest possible number of corners, each with its own vertex.
void reserve(MeshBuilder& builder, const InputBuffer& input, bool binary) {
  constexpr uint64_t kLeastTextOfVertex = 13;  // "vertex 0 0 0 "
  const auto left = input.left();
  if (!left) return;
  const auto corners = binary ? 3 * (*left / kFacetBytes) : *left / kLeastTextOfVertex;
  builder.positions.reserve(corners);
  builder.faces.reserve_corners(corners);
}

// Whether vertices at different positions are so as floats.
bool differ_as_floats(const std::vector<double>& positions, const std::string& file) {
  std::vector<float> floats;
  std::vector<std::uint32_t> ids;
  Welder<float> welder(floats, ids, file);
  welder.expect(positions.size() / 3);
  for (std::size_t i = 0; i < positions.size(); i += 3) {
    welder.append(
        {static_cast<float>(positions[i]), static_cast<float>(positions[i + 1]), static_cast<float>(positions[i + 2])});
  }
  return floats.size() == positions.size();
}

/// Calls `read`. If the file may be text or binary, the error names both reasons; without exceptions, only that of the
/// text.
template <class F>
void read_or_explain([[maybe_unused]] bool may_be_either, [[maybe_unused]] const std::string& not_binary, F&& read) {
#if defined(__cpp_exceptions)
  try {
    read();
  } catch (const Error& error) {
    if (!may_be_either) throw;
    raise(error.code(), fmt::format("{}; and {}", error.what(), not_binary));
  }
#else
  read();
#endif
}

}  // namespace

bool has_binary_stl_size(InputBuffer& input) {
  const auto header = input.ahead(kHeaderBytes);
  return header.size() >= kHeaderBytes && input.left() == binary_size(header);
}

bool is_binary_stl(InputBuffer& input) {
  if (has_binary_stl_size(input)) return true;
  const auto header = input.ahead(kHeaderBytes).substr(0, kHeaderBytes);
  if (header.size() < kHeaderBytes || is_text(header)) return false;
  const auto left = input.left();
  return !left || *left >= binary_size(header);
}

Mesh read_stl(InputBuffer& input, const ReaderOptions& options) {
  const bool binary = is_binary_stl(input);
  const bool may_be_either = !binary && !is_text(input.ahead(kHeaderBytes).substr(0, kHeaderBytes));
  const std::string not_binary = binary ? "" : why_not_binary(input);
  MeshBuilder builder(input, options, binary ? Declared::Float : Declared::Nothing);
  reserve(builder, input, binary);
  const auto read_soup = [&]<class Real>(std::vector<Real>& positions) {
    Welder<Real> welder(positions, builder.faces.corners(), input.name());
    binary ? BinaryStl<Real>(input, builder, welder).read() : StlText<Real>(input, options, builder, welder).read();
  };
  read_or_explain(may_be_either, not_binary, [&] { std::visit(read_soup, builder.positions.values()); });
  if (builder.positions.are_open()) {
    builder.positions.note(differ_as_floats(std::get<std::vector<double>>(builder.positions.values()), input.name()));
  }
  return builder.finish(Format::Stl);
}

}  // namespace meshhood::inline v0_1::io
