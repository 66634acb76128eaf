// SPDX-License-Identifier: MIT
#include "io/npy.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "meshhood/error.h"

#include "io/messages.h"
#include "io/number.h"

namespace meshhood::inline v0_1::io {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr std::string_view kHeaderBlanks = " \n";

/// The dictionary of a header: keys and values as Python prints them.
class Dictionary {
 public:
  Dictionary(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  /// The text that follows `'key':`, up to the end of the dictionary.
  [[nodiscard]] std::string_view after(std::string_view key) const {
    const auto place = text_.find(fmt::format("'{}':", key));
    if (place == std::string_view::npos) fail(key);
    const std::string_view rest = text_.substr(place + key.size() + 3);
    return rest.substr(std::min(rest.size(), rest.find_first_not_of(kHeaderBlanks)));
  }

  /// The text of a value between `open` and `close`.
  [[nodiscard]] std::string_view between(std::string_view key, char open, char close) const {
    const std::string_view value = after(key);
    const auto end = value.find(close, 1);
    if (!value.starts_with(open) || end == std::string_view::npos) fail(key);
    return value.substr(1, end - 1);
  }

  [[noreturn]] void fail(std::string_view key) const {
    raise(ErrorCode::MalformedFile, fmt::format("{}: the header of the array has no valid '{}'", file_, key));
  }

 private:
  std::string_view text_;
  const std::string& file_;
};

std::vector<std::uint64_t> parse_shape(const Dictionary& dictionary) {
  std::vector<std::uint64_t> shape;
  std::string_view rest = dictionary.between("shape", '(', ')');
  while (!rest.empty()) {
    const auto comma = std::min(rest.size(), rest.find(','));
    const std::string_view blank_before = rest.substr(0, comma);
    const std::string_view number = blank_before.substr(std::min(comma, blank_before.find_first_not_of(' ')));
    const std::optional<std::uint64_t> size = parse_count(number);
    if (!size) dictionary.fail("shape");
    shape.push_back(*size);
    rest.remove_prefix(std::min(rest.size(), comma + 1));
    rest.remove_prefix(std::min(rest.size(), rest.find_first_not_of(' ')));
  }
  return shape;
}

}  // namespace

std::string npy_header(std::string_view type, std::string_view shape) {
  constexpr std::size_t kAlignment = 64;
  constexpr std::size_t kBeforeDictionary = 10;
  std::string dictionary = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': {}, }}", type, shape);
  while ((kBeforeDictionary + dictionary.size() + 1) % kAlignment != 0) dictionary += ' ';
  dictionary += '\n';
  std::string text(kMagic);
  text += '\x01';
  text += '\0';
  text += static_cast<char>(dictionary.size() & 0xffU);
  text += static_cast<char>(dictionary.size() >> 8U);
  return text + dictionary;
}

bool is_npy(std::string_view first_bytes) { return first_bytes.starts_with(kMagic); }

NpyHeader parse_npy_header(std::string_view first_bytes, const std::string& file) {
  const auto byte = [&](std::size_t i) { return std::size_t{static_cast<unsigned char>(first_bytes[i])}; };
  if (!is_npy(first_bytes) || first_bytes.size() < 12) {
    raise(ErrorCode::MalformedFile, file + ": is not a .npy file: it does not begin as one");
  }
  if (byte(6) < 1 || byte(6) > 3) {
    raise(ErrorCode::UnsupportedFormat, fmt::format("{}: version {} of .npy is not supported", file, byte(6)));
  }
  const bool is_first = byte(6) == 1;
  const std::size_t begin = is_first ? 10 : 12;
  const std::size_t size = byte(8) | byte(9) << 8U | (is_first ? 0 : byte(10) << 16U | byte(11) << 24U);
  if (first_bytes.size() - begin < size) {
    raise(ErrorCode::MalformedFile,
          fmt::format("{}: a header of {} bytes, of which {} are there", file, size, first_bytes.size() - begin));
  }
  const Dictionary dictionary(first_bytes.substr(begin, size), file);
  const std::string_view type = dictionary.between("descr", '\'', '\'');
  const std::optional<std::uint64_t> item = parse_count(type.substr(std::min<std::size_t>(2, type.size())));
  if (type.size() < 3 || !item) {
    raise(ErrorCode::UnsupportedFormat, fmt::format("{}: values of type {}, expected numbers", file, quote(type)));
  }
  return {.bytes = begin + size,
          .kind = type[1],
          .item = static_cast<std::size_t>(*item),
          .order = type[0] == '>' ? std::endian::big : std::endian::little,
          .fortran_order = dictionary.after("fortran_order").starts_with("True"),
          .shape = parse_shape(dictionary)};
}

}  // namespace meshhood::inline v0_1::io
