// SPDX-License-Identifier: MIT
#include "io/stl_text.h"

#include <algorithm>
#include <limits>
#include <string_view>

#include "io/float_keeps.h"
#include "io/plain_rows.h"
#include "io/plain_text.h"
#include "io/text.h"

namespace meshhood::inline v0_1::io {
namespace {

using std::uint64_t;

bool is_word(std::string_view token, std::string_view lower_case) {
  return std::equal(token.begin(), token.end(), lower_case.begin(), lower_case.end(),
                    [](char a, char b) { return (('A' <= a && a <= 'Z') ? a - 'A' + 'a' : a) == b; });
}

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
    end_loop(count, location);
  }

  // Not before the third: a facet of fewer vertices is left out.
  void append_first_three() {
    for (const auto& corner : first_) weld_.append(corner);
  }

  void end_loop(uint64_t count, const Location& location) {
    if (count < 3) {
      builder_.warnings.add("facets of fewer than three vertices are left out", location);
    } else if (count == 3) {
      append_triangle(first_, location, builder_, weld_);
    } else {
      builder_.warnings.add("facets of more than three vertices", location);
      builder_.faces.end_face(count);
    }
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

}  // namespace

template <class Real>
void read_stl_text(InputBuffer& input, const ReaderOptions& options, MeshBuilder& builder, Welder<Real>& weld) {
  StlText<Real>(input, options, builder, weld).read();
}

template void read_stl_text(InputBuffer& input, const ReaderOptions& options, MeshBuilder& builder,
                            Welder<float>& weld);
template void read_stl_text(InputBuffer& input, const ReaderOptions& options, MeshBuilder& builder,
                            Welder<double>& weld);

}  // namespace meshhood::inline v0_1::io
