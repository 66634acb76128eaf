// SPDX-License-Identifier: MIT
#include "io/npz_writer.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <functional>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace meshhood::inline v0_1::io {

void NpzWriter::begin_member(std::string_view name, std::string_view type, std::string_view shape,
                             std::uint64_t bytes) {
  assert(bytes_left_ == 0);
  const std::string head = npy_header(type, shape);
  zip_.begin(fmt::format("{}.npy", name), head.size() + bytes);
  zip_.write(head);
  bytes_left_ = bytes;
}

void NpzWriter::begin_array(std::string_view name, std::string_view type, std::span<const std::uint64_t> shape,
                            std::size_t item) {
  const std::uint64_t count = std::accumulate(shape.begin(), shape.end(), std::uint64_t{1}, std::multiplies<>());
  const std::string lengths = fmt::format("({}{})", fmt::join(shape, ", "), shape.size() == 1 ? "," : "");
  begin_member(name, type, lengths, count * item);
}

void NpzWriter::write(std::string_view bytes) {
  assert(bytes.size() <= bytes_left_);
  bytes_left_ -= bytes.size();
  zip_.write(bytes);
}

void NpzWriter::add_text(std::string_view name, std::string_view text) {
  begin_member(name, fmt::format("|S{}", text.size()), "()", text.size());
  write(text);
}

void NpzWriter::add_texts(std::string_view name, std::span<const std::string> texts) {
  std::size_t longest = 1;
  for (const std::string& text : texts) longest = std::max(longest, text.size());
  std::vector<char32_t> characters;  // NumPy stores all of them in 32 bits, in the byte order of the header
  for (const std::string& text : texts) {
    characters.insert(characters.end(), text.begin(), text.end());
    characters.resize(characters.size() + longest - text.size());
  }
  const char order = std::endian::native == std::endian::little ? '<' : '>';
  const std::uint64_t bytes = characters.size() * sizeof(char32_t);
  begin_member(name, fmt::format("{}U{}", order, longest), fmt::format("({},)", texts.size()), bytes);
  append(std::span<const char32_t>(characters));
}

void NpzWriter::add_ones(std::string_view name, std::uint64_t count) {
  assert(bytes_left_ == 0);
  zip_.add_run(fmt::format("{}.npy", name), npy_header(npy_type<bool>(), fmt::format("({},)", count)), '\1', count);
}

void NpzWriter::commit() {
  assert(bytes_left_ == 0);
  zip_.commit();
}

}  // namespace meshhood::inline v0_1::io
