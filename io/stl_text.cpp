// SPDX-License-Identifier: MIT
#include "io/stl_text.h"

#include <algorithm>
#include <limits>
#include <string_view>

#include "io/float_keeps.h"
#include "io/plain_rows.h"
#include "io/plain_stl.h"
#include "io/text.h"

namespace meshhood::io {
namespace {

using std::uint64_t;

bool is_word(std::string_view token, std::string_view lower_case) {
  return std::equal(token.begin(), token.end(), lower_case.begin(), lower_case.end(),
                    [](char a, char b) { return (('A' <= a && a <= 'Z') ? a - 'A' + 'a' : a) == b; });
}

template <class Real>
class StlText {
 public:
  StlText(InputBuffer& input, const ReaderOptions& options, MeshBuilder& builder, VertexWelder<Real>& weld)
      : text_(input, {}),
        plain_(text_, options, PlainStl<Real>(builder.positions.are_open())),
        builder_(builder),
        weld_(weld) {}

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
    plain_.take(std::numeric_limits<uint64_t>::max(), [this](const PlainStl<Real>& rows) {
      for (const auto& corners : rows.facets()) {
        for (const auto& corner : corners) weld_.append(corner);
        builder_.faces.end_face(3);
      }
      builder_.positions.note(rows.float_keeps());
      facets_ += rows.size();
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

  typename VertexWelder<Real>::Point read_corner(uint64_t count) {
    typename VertexWelder<Real>::Point corner;
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
  PlainRows<PlainStl<Real>> plain_;
  MeshBuilder& builder_;
  VertexWelder<Real>& weld_;
  std::array<typename VertexWelder<Real>::Point, 3> first_ = {};
  uint64_t facets_ = 0;
  bool in_solid_ = true;
};

}  // namespace

template <class Real>
void read_stl_text(InputBuffer& input, const ReaderOptions& options, MeshBuilder& builder, VertexWelder<Real>& weld) {
  StlText<Real>(input, options, builder, weld).read();
}

template void read_stl_text(InputBuffer& input, const ReaderOptions& options, MeshBuilder& builder,
                            VertexWelder<float>& weld);
template void read_stl_text(InputBuffer& input, const ReaderOptions& options, MeshBuilder& builder,
                            VertexWelder<double>& weld);

}  // namespace meshhood::io
