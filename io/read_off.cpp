// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>

#include "io/mesh_builder.h"
#include "io/number.h"
#include "io/plain_elements.h"
#include "io/plain_rows.h"
#include "io/readers.h"
#include "io/text.h"

// `[ST][C][N]OFF` in text, with the prefixes in any order. The rest of a line after the position of a vertex or the
// corners of a face (normals, colors, texture coordinates) is skipped. Vertices of 4 or n dimensions (4OFF, nOFF) and
// `OFF BINARY` are refused. Many files of ModelNet40 lack the separator before the counts (`OFF8 6 12`), those of
// AIM@SHAPE the number of edges; they are read with a warning.
//
// Many programs write colors after the vertices of a plain OFF file, so a vertex ends with its line there too. If a
// line holds several vertices, the rest are skipped, the file ends too early and is refused.

namespace meshhood::inline v0_1::io {
namespace {

using std::uint64_t;

// "0 0 0\n" and "0\n".
constexpr uint64_t kLeastBytesOfVertex = 6;
constexpr uint64_t kLeastBytesOfFace = 2;

class OffReader {
 public:
  OffReader(InputBuffer& input, const ReaderOptions& options)
      : text_(input, {.hash_comments = true}), builder_(input, options, Declared::Nothing), options_(options) {}

  Mesh read() {
    read_keyword();
    read_counts();
    builder_.positions.are_double() ? read_vertices<double>() : read_vertices<float>();
    read_faces();
    if (!text_.token().empty()) builder_.warnings.add("data after the last face", text_.location());
    return builder_.finish(Format::Off);
  }

 private:
  void read_keyword() {
    const auto word = text_.token();
    if (!is_off_keyword(word)) text_.malformed("expected 'OFF', found {}", quote(word));
    const auto keyword = word.substr(0, word.find("OFF") + 3);
    first_count_ = word.substr(keyword.size());
    if (!first_count_.empty()) builder_.warnings.add("no blank between 'OFF' and the counts", text_.location());
    const auto dimension = keyword.find_first_of("4n");
    if (dimension != std::string_view::npos) {
      text_.fail(ErrorCode::UnsupportedFormat,
                 fmt::format("{} is not supported, expected vertices of three coordinates", quote(keyword)));
    }
    has_attributes_ = keyword != "OFF";
  }

  void read_counts() {
    vertices_ = read_count("vertices");
    const auto line = text_.location().line;
    check_bytes(vertices_, kLeastBytesOfVertex, "vertices");
    check_vertex_count(vertices_, text_.input().name(), text_.location());
    faces_ = read_count("faces");
    check_bytes(faces_, kLeastBytesOfFace, "faces");
    skip_edge_count(text_.location().line == line);
    const auto left = text_.input().left();
    if (!left) return;
    builder_.positions.reserve(vertices_);
    builder_.faces.reserve_corners(std::min(3 * faces_, *left / 2));
  }

  // The counts are a line, which may lack that of the edges. A line of a single number is no vertex, though.
  void skip_edge_count(bool are_in_line) {
    const Location faces = text_.location();
    if (are_in_line && text_.at_line_end()) {
      const bool is_missing = text_.token().empty() || !text_.at_line_end();
      text_.put_back();
      if (is_missing) return builder_.warnings.add("no number of edges", faces);
    }
    read_count("edges");
    if (are_in_line && !text_.at_line_end()) {
      text_.malformed("expected the end of the line of counts, found {}", quote(std::string(text_.token())));
    }
  }

  uint64_t read_count(std::string_view what) {
    const std::string token = first_count_.empty() ? std::string(text_.token()) : std::exchange(first_count_, {});
    if (token == "BINARY")
      text_.fail(ErrorCode::UnsupportedFormat, "'OFF BINARY' is not supported, expected OFF as text");
    const auto count = parse_count(token);
    if (!count) text_.malformed("expected the number of {}, found {}", what, quote(token));
    return *count;
  }

  // Before any allocation: the file must be long enough for the count.
  void check_bytes(uint64_t count, uint64_t least, std::string_view what) const {
    const auto left = text_.input().left();
    if (!left || count <= (*left + 1) / least) return;
    text_.malformed("{} {} take at least {} bytes each, but {} bytes are left: at least {} are missing", count, what,
                    least, *left, count - (*left + 1) / least);
  }

  template <class Real>
  void read_vertices() {
    PlainRows<Real, VertexRow> plain(text_, options_, {.values = 3, .axes = {0, 1, 2}}, builder_.positions.are_open());
    const auto append = [this](const PlainBlock<Real>& block) {
      builder_.positions.append(block);
      return true;
    };
    for (;;) {
      plain.take(vertices_ - builder_.positions.vertex_count(), append);
      const uint64_t vertex = builder_.positions.vertex_count();
      if (vertex == vertices_) return;
      read_vertex(vertex);
    }
  }

  void read_faces() {
    constexpr auto kAny = std::numeric_limits<uint64_t>::max();
    PlainRows<float, FaceRow> plain(text_, options_, {.before = 0, .after = 0, .most_count = kAny, .end = vertices_});
    const auto append = [this](const PlainBlock<float>& block) {
      builder_.faces.append(block.faces);
      return true;
    };
    for (;;) {
      plain.take(faces_ - builder_.faces.size(), append);
      if (builder_.faces.size() == faces_) return;
      read_face(builder_.faces.size());
    }
  }

  void read_vertex(uint64_t vertex) {
    for (int i = 0; i < 3; ++i) {
      const char name = axis(builder_.positions.scalar_count());
      const auto token = text_.token();
      if (token.empty()) refuse_end("vertex", vertex, vertices_);
      const auto problem = builder_.positions.append(token);
      if (problem) text_.malformed("vertex {}, {} = {} {}", vertex, name, quote(token), *problem);
    }
    builder_.positions.end_vertex(text_.location());
    if (!has_attributes_ && !text_.at_line_end()) {
      builder_.warnings.add("more than three numbers in a line of a vertex", text_.location());
      has_long_lines_ = true;
    }
    text_.skip_line();
  }

  [[noreturn]] void refuse_end(std::string_view element, uint64_t number, uint64_t count) const {
    text_.malformed("the file ends in {} {} of {}{}", element, number, count,
                    has_long_lines_ ? "; only one vertex was read from each line with more than three numbers" : "");
  }

  void read_face(uint64_t face) {
    const auto corners = read_face_integer(face, "number of corners");
    if (corners < 0) text_.malformed("face {} has {} corners, expected at least 0", face, corners);
    for (std::int64_t corner = 0; corner < corners; ++corner) {
      const auto index = read_face_integer(face, "vertex index");
      if (index < 0 || static_cast<uint64_t>(index) >= vertices_) {
        text_.malformed("face {}, corner {} = {}, but there are {} vertices", face, corner, index, vertices_);
      }
      builder_.faces.append_corner(static_cast<std::uint32_t>(index));
    }
    builder_.faces.end_face(static_cast<uint64_t>(corners));
    text_.skip_line();
  }

  std::int64_t read_face_integer(uint64_t face, std::string_view what) {
    const auto token = text_.token();
    if (token.empty()) refuse_end("face", face, faces_);
    const auto value = parse_integer(token);
    if (!value) text_.malformed("face {}: expected a {}, found {}", face, what, quote(token));
    return *value;
  }

  Text text_;
  MeshBuilder builder_;
  const ReaderOptions& options_;
  std::string first_count_;  // where it follows the keyword without a separator
  bool has_attributes_ = false;
  bool has_long_lines_ = false;
  uint64_t vertices_ = 0;
  uint64_t faces_ = 0;
};

bool take_prefix(std::string_view& word, std::string_view prefix) {
  if (!word.starts_with(prefix)) return false;
  word.remove_prefix(prefix.size());
  return true;
}

}  // namespace

bool is_off_keyword(std::string_view word) {
  std::array<std::string_view, 5> prefixes = {"ST", "C", "N", "4", "n"};
  const auto take = [&word](std::string_view& prefix) {
    const bool is_next = !prefix.empty() && take_prefix(word, prefix);
    if (is_next) prefix = {};
    return is_next;
  };
  while (std::any_of(prefixes.begin(), prefixes.end(), take)) {
  }
  return take_prefix(word, "OFF") && (word.empty() || parse_count(word));
}

Mesh read_off(InputBuffer& input, const ReaderOptions& options) { return OffReader(input, options).read(); }

}  // namespace meshhood::inline v0_1::io
