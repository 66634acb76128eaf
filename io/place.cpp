// SPDX-License-Identifier: MIT
#include "io/place.h"

#include <cstddef>

#include <fmt/format.h>

namespace meshhood::io {
namespace {

template <class Keep>
std::string escaped(std::string_view text, Keep keep) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    result += keep(byte) ? std::string(1, c) : fmt::format("\\x{:02x}", byte);
  }
  return result;
}

}  // namespace

std::string Place::suffix() const { return line == 0 ? fmt::format("@{}", byte) : fmt::format(":{}:{}", line, column); }

std::string Place::in_words() const { return line == 0 ? fmt::format("byte {}", byte) : fmt::format("line {}", line); }

void fail_at(const std::string& file, const Place& place, ErrorCode code, std::string_view message) {
  raise(code, fmt::format("{}{}: {}", file, place.suffix(), message));
}

std::string printable_name(std::string_view name) {
  return escaped(name, [](unsigned char byte) { return byte >= 0x20 && byte != 0x7f; });
}

std::string escape(std::string_view text) {
  constexpr std::size_t kLongest = 64;
  const auto printable = [](unsigned char byte) { return byte >= 0x20 && byte < 0x7f && byte != '\\'; };
  return escaped(text.substr(0, kLongest), printable) + (text.size() > kLongest ? "..." : "");
}

std::string quote(std::string_view text) { return "'" + escape(text) + "'"; }

}  // namespace meshhood::io
