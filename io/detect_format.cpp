// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>
#include <optional>
#include <span>

#include "meshhood/serialize.h"

#include "io/place.h"
#include "io/readers.h"

namespace meshhood::io {
namespace {

constexpr std::size_t kHead = std::size_t{1} << 16;
constexpr std::size_t kIndexMark = 8;

std::string lower_case(std::string text) {
  for (char& c : text) {
    if ('A' <= c && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

bool begins_index(Input& input) { return meshhood::is_index(std::as_bytes(std::span(input.ahead(kIndexMark)))); }

std::optional<Format> format_of_ending(const std::string& name) {
  const auto ending = lower_case(std::filesystem::path(name).extension().string());
  if (ending == ".ply") return Format::Ply;
  if (ending == ".obj") return Format::Obj;
  if (ending == ".off") return Format::Off;
  if (ending == ".stl") return Format::Stl;
  return std::nullopt;
}

void take_byte_order_mark(Input& input) {
  const auto head = input.ahead(3);
  if (head.starts_with("\xef\xbb\xbf")) input.skip(3);
  if (head.starts_with("\xff\xfe") || head.starts_with("\xfe\xff")) {
    raise(ErrorCode::UnsupportedFormat, input.name() + ": UTF-16 text is not read, only UTF-8 and ASCII");
  }
}

// The first word that is in no comment; empty where the head has none.
std::string_view first_word(std::string_view head) {
  constexpr std::string_view kBlanks = " \t\v\f\r\n";
  for (;;) {
    head.remove_prefix(std::min(head.find_first_not_of(kBlanks), head.size()));
    if (!head.starts_with('#')) return head.substr(0, head.find_first_of(kBlanks));
    head.remove_prefix(std::min(head.find_first_of("\r\n"), head.size()));
  }
}

// A keyword and something behind it. A letter alone is no evidence.
bool begins_obj(std::string_view head, std::string_view word) {
  const auto behind = static_cast<std::size_t>(word.data() - head.data()) + word.size();
  return is_obj_statement(word) && behind < head.size() && (head[behind] == ' ' || head[behind] == '\t');
}

std::optional<Format> format_of_content(Input& input) {
  if (has_binary_stl_size(input)) return Format::Stl;
  const auto head = input.ahead(kHead);
  const auto word = first_word(head);
  if (word == "ply") return Format::Ply;
  if (lower_case(std::string(word)) == "solid") return Format::Stl;
  if (is_off_keyword(word)) return Format::Off;
  if (begins_obj(head, word)) return Format::Obj;
  return std::nullopt;
}

}  // namespace

Format detect_format(Input& input, const std::string& name) {
  take_byte_order_mark(input);
  const auto ending = format_of_ending(name);
  if (begins_index(input)) {
    raise(ErrorCode::UnsupportedFormat, input.name() + ": an index, where a mesh was expected");
  }
  if (input.ahead(1).empty()) {
    // Of the four only an OBJ file may be empty: it is a mesh of no vertices.
    if (ending == Format::Obj) return Format::Obj;
    raise(ErrorCode::MalformedFile, input.name() + ": the file is empty");
  }
  const auto format = format_of_content(input);
  if (format) return *format;
  if (ending) return *ending;
  raise(ErrorCode::UnsupportedFormat, input.name() + ": neither PLY, OBJ, OFF nor STL, by its first bytes or its name");
}

}  // namespace meshhood::io
