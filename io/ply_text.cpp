// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "io/number.h"
#include "io/plain_elements.h"
#include "io/plain_rows.h"
#include "io/ply_values.h"
#include "io/text.h"

namespace meshhood::inline v0_1::io {
namespace {

bool is_in_range(std::int64_t value, PlyType type) {
  const auto most = static_cast<std::int64_t>(largest(type));
  return (is_signed(type) ? -most - 1 : 0) <= value && value <= most;
}

/// Rows that are a line each. `append` receives them in blocks.
template <class Real, class Row, class Append>
PlyRows text_rows(Text& text, const ReaderOptions& options, const Row& row, Append append) {
  const auto plain = std::make_shared<PlainRows<Real, Row>>(text, options, row);
  return [plain, append](std::uint64_t most) {
    std::uint64_t taken = 0;
    plain->take(most, [&](const PlainBlock<Real>& block) {
      append(block);
      taken += block.rows;
      return true;
    });
    return taken;
  };
}

/// How the rows of a PLY file in text lie in its lines. Writers put each row into a line of its own, but the format
/// does not require that.
enum class PlyLayout {
  Undecided,  ///< every row so far has ended with a line
  Lines,      ///< a row is a line, and may be followed by more numbers in it
  Running,    ///< line ends are blanks
};

constexpr std::string_view kLineBreaks = kBlanks.substr(4);
constexpr std::string_view kBlanksInLine = kBlanks.substr(0, 4);

// Passes rows, without regard to their values.
class RowWalk {
 public:
  RowWalk(std::string_view text, PlyLayout layout) : text_(text), are_lines_(layout == PlyLayout::Lines) {}

  // The rows from `row` on. Those before have no further numbers.
  bool pass_rows(const PlyElement& element, std::uint64_t row) {
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
    std::uint64_t further = 0;
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
  std::uint64_t further_ = 0;      // numbers after each row of the element
  bool is_further_known_ = false;  // else the next row tells
};

/// Whether the text, up to the end of the file, consists of exactly the rows from row `row` of `element` on, which is
/// in the header. With `Lines`, each must have a line of its own. A writer that adds numbers to a row adds as many to
/// each row of the element, so that one row with more numbers proves nothing.
bool fits(std::string_view text, const PlyHeader& header, const PlyElement& element, std::uint64_t row,
          PlyLayout layout) {
  RowWalk walk(text, layout);
  const PlyElement* const end = header.elements.data() + header.elements.size();
  for (const PlyElement* next = &element; next != end; ++next) {
    if (!walk.pass_rows(*next, next == &element ? row : 0)) return false;
  }
  return walk.is_over();
}

class TextValues final : public PlyValues {
 public:
  TextValues(InputBuffer& input, const PlyHeader& header, ReaderOptions options)
      : text_(input, {.lines_before = header.lines}), header_(header), options_(std::move(options)) {}

  PlyRows vertex_rows(const PlyElement& element, const std::array<std::size_t, 3>& axes,
                      Positions& positions) override {
    if (!are_single(element.properties)) return {};
    const VertexRow row{element.properties.size(), axes};
    const auto append = [&positions](const auto& block) { positions.append(block); };
    if (positions.are_double()) return text_rows<double>(text_, options_, row, append);
    return text_rows<float>(text_, options_, row, append);
  }

  PlyRows face_rows(const PlyElement& element, std::size_t list, std::uint64_t vertices, Faces& faces) override {
    const std::span<const PlyProperty> properties = element.properties;
    if (!are_single(properties.first(list)) || !are_single(properties.subspan(list + 1))) return {};
    const FaceRow row{.before = list,
                      .after = properties.size() - list - 1,
                      .most_count = largest(properties[list].count_type),
                      .end = std::min(vertices, largest(properties[list].type) + 1)};
    return text_rows<float>(text_, options_, row, [&faces](const auto& block) { faces.append(block.faces); });
  }

  Problem take_coordinate(PlyType /*type*/, Positions& positions) override {
    const auto token = next();
    if (token.empty()) return missing();
    const auto problem = positions.append(token);
    if (!problem) return std::nullopt;
    return fmt::format("{} {}", quote(token), *problem);
  }

  Problem take_integer(PlyType type, std::int64_t& value) override {
    const auto token = next();
    if (token.empty()) return missing();
    const auto integer = parse_integer(token);
    if (!integer || !is_in_range(*integer, type))
      return fmt::format("{} is not an integer of the declared type", quote(token));
    value = *integer;
    return std::nullopt;
  }

  Problem skip(PlyType /*type*/, std::uint64_t count) override {
    for (std::uint64_t i = 0; i < count; ++i) {
      if (next().empty()) return missing();
    }
    return std::nullopt;
  }

  // A digit and a separator.
  [[nodiscard]] std::uint64_t least_bytes(PlyType /*type*/) const override { return 2; }

  // The last value needs no separator.
  [[nodiscard]] std::optional<std::uint64_t> bytes_left() const override {
    const auto left = text_.input().left();
    if (!left) return std::nullopt;
    return *left + 1;
  }

  [[nodiscard]] bool row_is_over() const override { return text_.at_line_end(); }

  bool end_row(const PlyElement& element, std::uint64_t row) override {
    const auto line = std::exchange(row_line_, 0);
    if (line != text_.location().line && long_row_.line == 0) {
      long_row_ = {line, fmt::format("{} {}", escape(element.name), row)};
    }
    if (text_.at_line_end()) return false;
    if (layout_ == PlyLayout::Undecided) layout_ = layout_after(element, row);
    if (layout_ == PlyLayout::Running) return false;
    text_.skip_line();
    return true;
  }

  [[nodiscard]] std::string hint() const override {
    if (long_row_.line != 0) return fmt::format("; {} runs on after line {}", long_row_.name, long_row_.line);
    const bool runs_on = row_line_ != 0 && row_line_ != text_.location().line;
    return runs_on ? fmt::format("; the row runs on after line {}", row_line_) : "";
  }

  bool anything_left() override { return !text_.token().empty(); }
  [[nodiscard]] Location location() const override { return text_.location(); }

 private:
  // The next value; empty at the end of the file, or of a row that is a line.
  std::string_view next() {
    if (row_line_ != 0) return layout_ == PlyLayout::Lines ? text_.token_on_line() : text_.token();
    const auto token = text_.token();
    row_line_ = text_.location().line;
    return token;
  }

  Problem missing() { return std::string(text_.input().ahead(1).empty() ? kFileEnds : kLineEnds); }

  // Decided at the first row that ends within a line. In a text that is too long to be searched, rows are lines if all
  // were so far.
  PlyLayout layout_after(const PlyElement& element, std::uint64_t row) {
    constexpr std::size_t kFarthest = std::size_t{16} << 20;
    const bool were_lines = long_row_.line == 0;
    const auto text = text_.from_line_start(kFarthest);
    if (text.size() == kFarthest) return were_lines ? PlyLayout::Lines : PlyLayout::Running;
    // If rows are lines, one that is too short has taken numbers from the line of the next.
    const bool may_be_short = long_row_.line + 1 == text_.location().line;
    const bool are_lines =
        (were_lines || may_be_short) && fits(text, header_, element, were_lines ? row : row + 1, PlyLayout::Lines);
    const auto rest = text.substr(text_.bytes_read());
    if (!are_lines && fits(rest, header_, element, row + 1, PlyLayout::Running)) return PlyLayout::Running;
    if (were_lines) return PlyLayout::Lines;
    fail_at(text_.input().name(), {.line = long_row_.line, .column = 1}, ErrorCode::MalformedFile,
            fmt::format("{} has fewer numbers in its line than the header declares", long_row_.name));
  }

  // The first row that runs over several lines.
  struct LongRow {
    std::uint64_t line = 0;
    std::string name;
  };

  Text text_;
  const PlyHeader& header_;
  ReaderOptions options_;
  PlyLayout layout_ = PlyLayout::Undecided;
  std::uint64_t row_line_ = 0;  // where the current row begins; 0 before its first value
  LongRow long_row_;
};

}  // namespace

std::unique_ptr<PlyValues> ply_text(InputBuffer& input, const PlyHeader& header, const ReaderOptions& options) {
  return std::make_unique<TextValues>(input, header, options);
}

}  // namespace meshhood::inline v0_1::io
