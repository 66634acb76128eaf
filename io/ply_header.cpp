// SPDX-License-Identifier: MIT
#include "io/ply_header.h"

#include <array>
#include <set>
#include <utility>

#include "io/number.h"
#include "io/text.h"

namespace meshhood::inline v0_1::io {
namespace {

// Keeps a forged header from filling the memory with properties.
constexpr std::uint64_t kLongestHeader = std::uint64_t{16} << 20;

/// A type by its two names.
struct NamedType {
  std::string_view name;
  std::string_view name_with_bits;
  PlyType type;
};

constexpr std::array<NamedType, 8> kTypes = {{{"char", "int8", PlyType::Int8},
                                              {"uchar", "uint8", PlyType::Uint8},
                                              {"short", "int16", PlyType::Int16},
                                              {"ushort", "uint16", PlyType::Uint16},
                                              {"int", "int32", PlyType::Int32},
                                              {"uint", "uint32", PlyType::Uint32},
                                              {"float", "float32", PlyType::Float32},
                                              {"double", "float64", PlyType::Float64}}};

// The byte that ends the header lines. A CR before an LF counts as a blank.
char line_end_of(InputBuffer& input) {
  const auto head = input.ahead(256);
  const auto end = head.find_first_of("\r\n");
  const bool only_cr = end != std::string_view::npos && head[end] == '\r' && !head.substr(end).starts_with("\r\n");
  return only_cr ? '\r' : '\n';
}

class HeaderParser {
 public:
  explicit HeaderParser(InputBuffer& input) : text_(input, {.line_end = line_end_of(input)}) {}

  PlyHeader parse() {
    if (!text_.next_line() || text_.token_on_line() != "ply") text_.malformed("expected 'ply'");
    while (parse_line()) {
      if (text_.input().offset() > kLongestHeader)
        text_.malformed("the header is longer than {} bytes", kLongestHeader);
    }
    if (!has_format_) text_.malformed("the header has no line 'format'");
    text_.leave_line();
    header_.lines = text_.location().line;
    return std::move(header_);
  }

 private:
  // False after `end_header`.
  bool parse_line() {
    if (!text_.next_line()) text_.malformed("the file ends before 'end_header'");
    const auto keyword = text_.token_on_line();
    if (keyword == "end_header") return false;
    if (keyword == "comment" || keyword == "obj_info" || keyword.empty()) {
      text_.skip_line();
    } else if (keyword == "format") {
      parse_format();
    } else if (keyword == "element") {
      parse_element();
    } else if (keyword == "property") {
      parse_property();
    } else {
      // Not skipped: it may be a misspelt line that changes the layout of the values.
      text_.malformed("expected 'element', 'property', 'comment' or 'end_header', found {}", quote(keyword));
    }
    if (!text_.at_line_end()) text_.malformed("unexpected {}", quote(text_.token_on_line()));
    return true;
  }

  void parse_format() {
    if (std::exchange(has_format_, true)) text_.malformed("a second line 'format'");
    const auto encoding = text_.token_on_line();
    if (encoding == "ascii") {
      header_.encoding = PlyEncoding::Ascii;
    } else if (encoding == "binary_little_endian") {
      header_.encoding = PlyEncoding::LittleEndian;
    } else if (encoding == "binary_big_endian") {
      header_.encoding = PlyEncoding::BigEndian;
    } else {
      unsupported("PLY encoding", encoding);
    }
    const auto version = text_.token_on_line();
    if (version != "1.0") unsupported("PLY version", version);
  }

  void parse_element() {
    const std::string name(word("the name of an element"));
    if (!names_.insert(name).second) text_.malformed("a second element {}", quote(name));
    const auto digits = word("a count");
    const auto count = parse_count(digits);
    if (!count) text_.malformed("expected the number of elements {}, found {}", quote(name), quote(digits));
    header_.elements.push_back({name, *count, {}, text_.location()});
  }

  void parse_property() {
    if (header_.elements.empty()) text_.malformed("a property before the first element");
    PlyProperty property;
    auto type_name = word("a type");
    if (type_name == "list") {
      property.is_list = true;
      property.count_type = type(word("a type"));
      if (!is_integer(property.count_type)) text_.malformed("the length of a list must have an integer type");
      type_name = word("a type");
    }
    property.type = type(type_name);
    property.name = word("the name of a property");
    header_.elements.back().properties.push_back(std::move(property));
  }

  std::string_view word(std::string_view what) {
    const auto token = text_.token_on_line();
    if (token.empty()) text_.malformed("expected {}", what);
    return token;
  }

  PlyType type(std::string_view name) {
    for (const NamedType& known : kTypes) {
      if (name == known.name || name == known.name_with_bits) return known.type;
    }
    unsupported("property type", name);
  }

  [[noreturn]] void unsupported(std::string_view what, std::string_view found) {
    text_.fail(ErrorCode::UnsupportedFormat, fmt::format("{} {} is not supported", what, quote(found)));
  }

  Text text_;
  PlyHeader header_;
  std::set<std::string> names_;  // of the elements; a set, because a header may have a million
  bool has_format_ = false;
};

}  // namespace

PlyHeader read_ply_header(InputBuffer& input) { return HeaderParser(input).parse(); }

}  // namespace meshhood::inline v0_1::io
