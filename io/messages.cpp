// SPDX-License-Identifier: MIT
#include "io/messages.h"

#include <system_error>

#include <fmt/format.h>

namespace meshhood::inline v0_1::io {
namespace {

struct Character {
  char32_t code;
  std::size_t length;  // in bytes; 0 where the text is not UTF-8
};

Character first_character(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < length) return {0, 0};
  char32_t code = lead & (0xffU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0U) != 0x80) return {0, 0};
    code = (code << 6U) | (byte(i) & 0x3fU);
  }
  const bool is_overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  const bool is_surrogate = 0xd800 <= code && code <= 0xdfff;
  if (is_overlong || is_surrogate || code > 0x10ffff) return {0, 0};
  return {code, length};
}

bool controls_terminal(char32_t code) {
  const auto in = [code](char32_t first, char32_t last) { return first <= code && code <= last; };
  return code < 0x20 || in(0x7f, 0x9f) || in(0x2028, 0x202e) || in(0x2066, 0x2069);
}

void append_escaped(std::string& result, std::string_view bytes) {
  for (const char c : bytes) result += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
}

std::string description(int error_number) { return std::generic_category().message(error_number); }

}  // namespace

std::string Location::suffix() const {
  return line == 0 ? fmt::format("@{}", byte) : fmt::format(":{}:{}", line, column);
}

std::string Location::in_words() const {
  return line == 0 ? fmt::format("byte {}", byte) : fmt::format("line {}", line);
}

void fail_at(const std::string& file, const Location& location, ErrorCode code, std::string_view message) {
  raise(code, fmt::format("{}{}: {}", file, location.suffix(), message));
}

void raise_io(const std::filesystem::path& path, int error_number, std::string_view message) {
  const std::string name = path.string();
  raise(ErrorCode::IoFailure, fmt::format("{}: {}", printable_name(name), message), name, error_number);
}

void raise_errno(const std::filesystem::path& path, int error_number, std::string_view action) {
  const std::string reason = description(error_number);
  raise_io(path, error_number, action.empty() ? reason : fmt::format("cannot {}: {}", action, reason));
}

void report(const Progress& progress, std::size_t done, std::size_t total, const std::string& file) {
  if (progress && !progress(done, total)) raise(ErrorCode::Cancelled, printable_name(file) + ": cancelled");
}

std::string printable_name(std::string_view name) {
  std::string result;
  while (!name.empty()) {
    const auto [code, length] = first_character(name);
    const std::string_view character = name.substr(0, length == 0 ? 1 : length);
    if (length == 0 || controls_terminal(code)) {
      append_escaped(result, character);
    } else {
      result += character;
    }
    name.remove_prefix(character.size());
  }
  return result;
}

std::string escape(std::string_view text) {
  constexpr std::size_t kLongest = 64;
  std::string result;
  for (const char c : text.substr(0, kLongest)) {
    if (' ' <= c && c <= '~' && c != '\\') {
      result += c;
    } else {
      append_escaped(result, {&c, 1});
    }
  }
  return text.size() > kLongest ? result + "..." : result;
}

std::string quote(std::string_view text) { return "'" + escape(text) + "'"; }

}  // namespace meshhood::inline v0_1::io
