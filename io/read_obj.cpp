// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <limits>

#include "io/mesh_builder.h"
#include "io/number.h"
#include "io/plain_rows.h"
#include "io/plain_text.h"
#include "io/readers.h"
#include "io/text.h"

// Only `v` and `f` are read. All other statements are skipped, also those that name a file or a program to run
// (`mtllib`, `call`, `csh`). Unknown statements, and those that would add geometry, are counted as warnings.

namespace meshhood::inline v0_1::io {
namespace {

using std::uint64_t;

constexpr std::array<std::string_view, 18> kAttributes = {
    "bevel", "c_interp", "ctech",      "d_interp", "g",         "lod",    "maplib", "mg", "mtllib",
    "o",     "s",        "shadow_obj", "stech",    "trace_obj", "usemap", "usemtl", "vn", "vt"};

constexpr std::array<std::string_view, 24> kOtherGeometry = {
    "bmat", "bsp",  "bzp", "call", "cdc",  "cdp", "con",  "csh", "cstype", "curv", "curv2", "deg",
    "end",  "hole", "l",   "p",    "parm", "res", "scrv", "sp",  "step",   "surf", "trim",  "vp"};

template <class Words>
bool contains(const Words& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// A plain row: a vertex of three coordinates with or without a color, a face whose indices are positive, a texture
// coordinate or a normal.
struct ObjRow {
  static constexpr uint64_t kLines = 1;
  static constexpr std::string_view kInLastLine{};

  template <class Real>
  const char* take(const char* row, const char* end, PlainBlock<Real>& block) const {
    if (row[0] == 'v' && plain::is_blank(row[1])) return take_vertex(row + 1, end, block);
    if (row[0] == 'f' && plain::is_blank(row[1])) return take_face(row + 1, block.vertex_count(), block);
    const bool is_other = row[0] == 'v' && (row[1] == 't' || row[1] == 'n') && plain::is_blank(row[2]);
    return is_other ? skip_numbers(row + 2) : nullptr;
  }

 private:
  template <class Real>
  static const char* take_vertex(const char* at, const char* end, PlainBlock<Real>& block) {
    std::array<Real, 3> position = {};
    for (Real& coordinate : position) at = plain::take_coordinate(at, end, coordinate, block.float_keeps);
    block.positions.insert(block.positions.end(), position.begin(), position.end());
    const char* const after = plain::take_line_end(at);
    if (after != nullptr) return after;
    double color = 0;
    for (int i = 0; i < 3; ++i) at = plain::take_number(at, end, color);
    return plain::take_line_end(at);
  }

  template <class Real>
  static const char* take_face(const char* at, std::size_t vertices, PlainBlock<Real>& block) {
    for (std::size_t corners = 1;; ++corners) {
      std::uint32_t index = 0;
      at = take_corner(plain::skip_blanks(at), index);
      if (at == nullptr || index == 0) return nullptr;
      block.faces.append_corner(index - 1);
      if (index > vertices) block.most_missing = std::max(block.most_missing, index - vertices);
      if (const char* const after = plain::take_line_end(at)) {
        block.faces.end_face(corners);
        return after;
      }
    }
  }

  // `v`, `v/vt`, `v//vn` or `v/vt/vn`.
  static const char* take_corner(const char* at, std::uint32_t& index) {
    at = plain::take_digits(at, index);
    for (int i = 0; i < 2 && at != nullptr && *at == '/'; ++i) {
      ++at;
      std::uint32_t other = 0;
      if (plain::is_digit(*at)) at = plain::take_digits(at, other);
    }
    return at != nullptr && plain::ends_token(at) ? at : nullptr;
  }

  static const char* skip_numbers(const char* at) {
    const auto may_be_in_number = [](char c) {
      return plain::is_blank(c) || plain::is_digit(c) || c == '.' || c == '-' || c == '+' || c == 'e' || c == 'E';
    };
    while (may_be_in_number(*at)) ++at;
    return plain::take_line_end(at);
  }
};

class ObjReader {
 public:
  ObjReader(InputBuffer& input, const ReaderOptions& options)
      : text_(input, {.hash_comments = true}), builder_(input, options, Declared::Nothing), options_(options) {}

  Mesh read() {
    builder_.positions.are_double() ? read_all<double>() : read_all<float>();
    if (unknown_ != 0 && !is_obj_) text_.malformed("the file has no OBJ statement");
    check_forward_reference();
    return builder_.finish(Format::Obj);
  }

 private:
  template <class Real>
  void read_all() {
    PlainRows<Real, ObjRow> plain(text_, options_, {}, builder_.positions.are_open());
    constexpr auto kAny = std::numeric_limits<uint64_t>::max();
    do {
      plain.take(kAny, [this](const PlainBlock<Real>& block) { return append(block); });
    } while (read_line());
  }

  bool read_line() {
    if (!text_.next_line()) return false;
    read_statement(text_.token_on_continued_line());
    return true;
  }

  template <class Real>
  bool append(const PlainBlock<Real>& block) {
    const auto before = builder_.positions.vertex_count();
    if (block.most_missing > before || before + block.vertex_count() > kMaxVertices) return false;
    is_obj_ = true;
    builder_.positions.append(block);
    builder_.faces.append(block.faces);
    return true;
  }

  void read_statement(std::string_view keyword) {
    if (keyword.empty()) return;
    is_obj_ = is_obj_ || is_obj_statement(keyword);
    if (keyword == "v") return read_vertex();
    if (keyword == "f") return read_face();
    if (contains(kOtherGeometry, keyword)) {
      builder_.warnings.add(fmt::format("'{}' statements are not read", keyword), text_.location());
    } else if (!contains(kAttributes, keyword)) {
      ++unknown_;
      builder_.warnings.add("unknown statements", text_.location());
    }
    while (!text_.token_on_continued_line().empty()) {
    }
  }

  // x y z, then optionally a weight, a color or both. Two coordinates are refused: a lost number is likelier than z =
  // 0.
  void read_vertex() {
    const auto vertex = builder_.positions.vertex_count();
    check_vertex_count(vertex + 1, text_.input().name(), text_.location());
    for (int i = 0; i < 3; ++i) read_coordinate(vertex);
    builder_.positions.end_vertex(text_.location());
    std::array<double, 4> rest = {};
    std::size_t count = 0;
    for (auto token = text_.token_on_continued_line(); !token.empty(); token = text_.token_on_continued_line()) {
      const auto number = parse_real<double>(token);
      if (!number) text_.malformed("vertex {}: {} is not a number", vertex + 1, quote(token));
      if (count == rest.size()) text_.malformed("vertex {} has more than 7 numbers", vertex + 1);
      rest[count++] = *number;
    }
    const bool has_weight = count == 1 || count == 4;
    if (has_weight && rest[0] != 1.0) builder_.warnings.add("weights other than 1 are not used", text_.location());
  }

  void read_coordinate(uint64_t vertex) {
    const char name = axis(builder_.positions.scalar_count());
    const auto token = text_.token_on_continued_line();
    if (token.empty()) text_.malformed("vertex {} has no {}, expected x y z", vertex + 1, name);
    const auto problem = builder_.positions.append(token);
    if (problem) text_.malformed("vertex {}, {} = {} {}", vertex + 1, name, quote(token), *problem);
  }

  void read_face() {
    uint64_t corners = 0;
    for (auto token = text_.token_on_continued_line(); !token.empty(); token = text_.token_on_continued_line()) {
      builder_.faces.append_corner(resolve_corner(token, corners++));
    }
    if (corners == 0) {
      builder_.warnings.add("faces without corners are left out", text_.location());
    } else {
      builder_.faces.end_face(corners);
    }
  }

  // The vertex of `v`, `v/vt`, `v//vn` or `v/vt/vn`.
  std::uint32_t resolve_corner(std::string_view token, uint64_t corner) {
    const auto slash = token.find('/');
    const auto index = parse_integer(token.substr(0, slash));
    const bool rest_is_good = slash == std::string_view::npos || are_attribute_indices(token.substr(slash + 1));
    if (!index || !rest_is_good) {
      text_.malformed("face {}, corner {}: {} is not a vertex index", builder_.faces.size() + 1, corner + 1,
                      quote(token));
    }
    return resolve(*index, corner);
  }

  // `vt`, `/vn` or `vt/vn`; either may be missing.
  static bool are_attribute_indices(std::string_view rest) {
    const auto slash = rest.find('/');
    const auto is_index = [](std::string_view part) { return part.empty() || parse_integer(part).has_value(); };
    return is_index(rest.substr(0, slash)) && (slash == std::string_view::npos || is_index(rest.substr(slash + 1)));
  }

  // Positive indices count from 1, negative ones backwards from the last vertex.
  std::uint32_t resolve(std::int64_t index, uint64_t corner) {
    const auto declared = static_cast<std::int64_t>(builder_.positions.vertex_count());
    const bool names_one = index > 0 || (index < 0 && index >= -declared);
    if (!names_one || index > static_cast<std::int64_t>(kMaxVertices)) {
      refuse(text_.location(), builder_.faces.size(), corner, index);
    }
    if (index > declared && index > forward_.index) forward_ = {index, builder_.faces.size(), corner, text_.location()};
    return static_cast<std::uint32_t>(index > 0 ? index - 1 : declared + index);
  }

  // A face may precede its vertices, so the check is possible only at the end.
  void check_forward_reference() const {
    const auto declared = static_cast<std::int64_t>(builder_.positions.vertex_count());
    if (forward_.index > declared) refuse(forward_.location, forward_.face, forward_.corner, forward_.index);
  }

  [[noreturn]] void refuse(const Location& location, uint64_t face, uint64_t corner, std::int64_t index) const {
    fail_at(text_.input().name(), location, ErrorCode::MalformedFile,
            fmt::format("face {}, corner {} = {}, but there are {} vertices", face + 1, corner + 1, index,
                        builder_.positions.vertex_count()));
  }

  // The largest index so far of a vertex that was not declared before the face.
  struct ForwardReference {
    std::int64_t index = 0;
    uint64_t face = 0;
    uint64_t corner = 0;
    Location location;
  };

  Text text_;
  MeshBuilder builder_;
  const ReaderOptions& options_;
  ForwardReference forward_;
  uint64_t unknown_ = 0;
  bool is_obj_ = false;
};

}  // namespace

bool is_obj_statement(std::string_view word) {
  return word == "v" || word == "f" || contains(kAttributes, word) || contains(kOtherGeometry, word);
}

Mesh read_obj(InputBuffer& input, const ReaderOptions& options) { return ObjReader(input, options).read(); }

}  // namespace meshhood::inline v0_1::io
