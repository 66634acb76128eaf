// SPDX-License-Identifier: MIT
#include "io/ply_layout.h"

#include <algorithm>

#include "io/number.h"

namespace meshhood::io {
namespace {

using std::uint64_t;

constexpr std::string_view kBlanks = " \t\v\f\r\n";
constexpr std::string_view kLineEnds = kBlanks.substr(4);
constexpr std::string_view kBlanksInLine = kBlanks.substr(0, 4);

// Passes rows, without regard to their values.
class RowWalk {
 public:
  RowWalk(std::string_view text, PlyLayout layout) : text_(text), are_lines_(layout == PlyLayout::Lines) { end_row(); }

  bool pass_rows(const PlyElement& element, uint64_t count) {
    if (element.properties.empty()) return true;
    while (count != 0 && pass_row(element)) --count;
    return count == 0;
  }

  [[nodiscard]] bool is_over() const { return text_.find_first_not_of(kBlanks) == std::string_view::npos; }

 private:
  bool pass_row(const PlyElement& element) {
    skip(kBlanks);
    for (const auto& property : element.properties) {
      const bool may_lack =
          property.is_list && &property != element.properties.data() && !element.has_corners(property);
      if (!(may_lack && is_at_line_end()) && !pass(property)) return false;
    }
    end_row();
    return true;
  }

  bool pass(const PlyProperty& property) {
    if (!property.is_list) return !token().empty();
    auto left = parse_integer(token()).value_or(-1);
    while (left > 0 && !token().empty()) --left;
    return left == 0;
  }

  void end_row() {
    if (are_lines_) text_.remove_prefix(std::min(text_.find_first_of(kLineEnds), text_.size()));
  }

  // Empty at the end: of the row, if rows are lines.
  std::string_view token() {
    skip(are_lines_ ? kBlanksInLine : kBlanks);
    const auto token = text_.substr(0, text_.find_first_of(kBlanks));
    text_.remove_prefix(token.size());
    return token;
  }

  [[nodiscard]] bool is_at_line_end() const {
    const auto next = text_.find_first_not_of(kBlanksInLine);
    return next == std::string_view::npos || kLineEnds.find(text_[next]) != std::string_view::npos;
  }

  void skip(std::string_view blanks) { text_.remove_prefix(std::min(text_.find_first_not_of(blanks), text_.size())); }

  std::string_view text_;
  bool are_lines_;
};

}  // namespace

bool fits(const PlyRest& rest, PlyLayout layout) {
  RowWalk walk(rest.text, layout);
  uint64_t rows = rest.rows;
  const PlyElement* const end = rest.header.elements.data() + rest.header.elements.size();
  for (const PlyElement* element = &rest.element; element != end; ++element) {
    if (element != &rest.element) rows = element->count;
    if (!walk.pass_rows(*element, rows)) return rest.is_cut && walk.is_over();
  }
  return walk.is_over();
}

}  // namespace meshhood::io
