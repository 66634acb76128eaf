// SPDX-License-Identifier: MIT
#include "io/ply_layout.h"

#include <algorithm>
#include <utility>

#include "io/number.h"
#include "io/text.h"

namespace meshhood::inline v0_1::io {
namespace {

using std::uint64_t;

constexpr std::string_view kLineBreaks = kBlanks.substr(4);
constexpr std::string_view kBlanksInLine = kBlanks.substr(0, 4);

// Passes rows, without regard to their values.
class RowWalk {
 public:
  RowWalk(std::string_view text, PlyLayout layout) : text_(text), are_lines_(layout == PlyLayout::Lines) {}

  // The rows from `row` on. Those before have no further numbers.
  bool pass_rows(const PlyElement& element, uint64_t row) {
    if (element.properties.empty()) return true;
    is_further_known_ = row != 0 || element.count <= 1;
    further_ = 0;
    while (row != element.count && pass_row(element)) ++row;
    return row == element.count;
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
    return end_row();
  }

  bool pass(const PlyProperty& property) {
    if (!property.is_list) return !token().empty();
    auto left = parse_integer(token()).value_or(-1);
    while (left > 0 && !token().empty()) --left;
    return left == 0;
  }

  bool end_row() {
    if (!are_lines_) return true;
    uint64_t further = 0;
    while (!token().empty()) ++further;
    if (!std::exchange(is_further_known_, true)) further_ = further;
    return further_ == further;
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
    return next == std::string_view::npos || kLineBreaks.find(text_[next]) != std::string_view::npos;
  }

  void skip(std::string_view blanks) { text_.remove_prefix(std::min(text_.find_first_not_of(blanks), text_.size())); }

  std::string_view text_;
  bool are_lines_;
  uint64_t further_ = 0;           // numbers after each row of the element
  bool is_further_known_ = false;  // else the next row tells
};

}  // namespace

bool fits(const PlyRest& rest, PlyLayout layout) {
  RowWalk walk(rest.text, layout);
  const PlyElement* const end = rest.header.elements.data() + rest.header.elements.size();
  for (const PlyElement* element = &rest.element; element != end; ++element) {
    if (!walk.pass_rows(*element, element == &rest.element ? rest.row : 0)) return false;
  }
  return walk.is_over();
}

}  // namespace meshhood::inline v0_1::io
