// SPDX-License-Identifier: MIT
#include "io/ply_values.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "io/number.h"
#include "io/text.h"

namespace meshhood::io {
namespace {

// Calls `f` with a value of the C++ type of `type`.
template <class F>
decltype(auto) with_type(PlyType type, F&& f) {
  switch (type) {
    case PlyType::Int8: return f(std::int8_t{});
    case PlyType::Uint8: return f(std::uint8_t{});
    case PlyType::Int16: return f(std::int16_t{});
    case PlyType::Uint16: return f(std::uint16_t{});
    case PlyType::Int32: return f(std::int32_t{});
    case PlyType::Uint32: return f(std::uint32_t{});
    case PlyType::Float32: return f(float{});
    case PlyType::Float64: break;
  }
  return f(double{});
}

bool is_in_range(std::int64_t value, PlyType type) {
  return with_type(type, [value](auto example) {
    using Limits = std::numeric_limits<decltype(example)>;
    if constexpr (!Limits::is_integer) return false;
    return static_cast<std::int64_t>(Limits::lowest()) <= value && value <= static_cast<std::int64_t>(Limits::max());
  });
}

class TextValues final : public PlyValues {
 public:
  TextValues(InputBuffer& input, const PlyHeader& header, ReaderOptions options)
      : text_(input, {.lines_before = header.lines}), options_(std::move(options)) {}

  std::unique_ptr<PlyRows> vertex_rows(const PlyElement& element, const std::array<std::size_t, 3>& axes,
                                       Positions& positions) override {
    return io::vertex_rows(text_, options_, element, axes, positions);
  }

  std::unique_ptr<PlyRows> face_rows(const PlyElement& element, std::size_t list, std::uint64_t vertices,
                                     Faces& faces) override {
    return io::face_rows(text_, options_, element, list, vertices, faces);
  }

  Problem take_coordinate(PlyType /*type*/, Positions& positions) override {
    const auto token = text_.token();
    if (token.empty()) return std::string(kFileEnds);
    const auto problem = positions.append(token);
    if (!problem) return std::nullopt;
    return fmt::format("{} {}", quote(token), *problem);
  }

  Problem take_integer(PlyType type, std::int64_t& value) override {
    const auto token = text_.token();
    if (token.empty()) return std::string(kFileEnds);
    const auto integer = parse_integer(token);
    if (!integer || !is_in_range(*integer, type))
      return fmt::format("{} is not an integer of the declared type", quote(token));
    value = *integer;
    return std::nullopt;
  }

  Problem skip(PlyType /*type*/, std::uint64_t count) override {
    for (std::uint64_t i = 0; i < count; ++i) {
      if (text_.token().empty()) return std::string(kFileEnds);
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
  bool anything_left() override { return !text_.token().empty(); }
  [[nodiscard]] Location location() const override { return text_.location(); }

 private:
  Text text_;
  ReaderOptions options_;
};

/// Reads the next value; false at the end of the file.
template <class T>
bool load(InputBuffer& input, bool swaps, T& value) {
  const auto bytes = input.ahead(sizeof(T));
  if (bytes.size() < sizeof(T)) return false;
  std::array<char, sizeof(T)> raw;
  std::copy_n(bytes.begin(), sizeof(T), raw.begin());
  if (swaps) std::reverse(raw.begin(), raw.end());
  std::memcpy(&value, raw.data(), sizeof(T));
  input.skip(sizeof(T));
  return true;
}

class BinaryValues final : public PlyValues {
 public:
  BinaryValues(InputBuffer& input, bool big_endian, ReaderOptions options)
      : input_(input), options_(std::move(options)), swaps_(big_endian != (std::endian::native == std::endian::big)) {}

  std::unique_ptr<PlyRows> vertex_rows(const PlyElement& element, const std::array<std::size_t, 3>& axes,
                                       Positions& positions) override {
    return swaps_ ? nullptr : io::vertex_rows(input_, options_, element, axes, positions);
  }

  std::unique_ptr<PlyRows> face_rows(const PlyElement& element, std::size_t list, std::uint64_t vertices,
                                     Faces& faces) override {
    return swaps_ ? nullptr : io::face_rows(input_, options_, element, list, vertices, faces);
  }

  Problem take_coordinate(PlyType type, Positions& positions) override {
    begin_ = input_.offset();
    return with_type(type, [&](auto example) -> Problem {
      if (!load(input_, swaps_, example)) return std::string(kFileEnds);
      const auto problem = positions.append(static_cast<double>(example));
      if (!problem) return std::nullopt;
      return std::string(*problem);
    });
  }

  Problem take_integer(PlyType type, std::int64_t& value) override {
    begin_ = input_.offset();
    return with_type(type, [&](auto example) -> Problem {
      if (!load(input_, swaps_, example)) return std::string(kFileEnds);
      value = static_cast<std::int64_t>(+example);
      return std::nullopt;
    });
  }

  Problem skip(PlyType type, std::uint64_t count) override {
    constexpr std::uint64_t kStep = std::uint64_t{1} << 16;
    begin_ = input_.offset();
    for (std::uint64_t left = count * size_of(type); left != 0;) {
      const auto step = static_cast<std::size_t>(std::min(left, kStep));
      if (input_.ahead(step).size() < step) return std::string(kFileEnds);
      input_.skip(step);
      left -= step;
    }
    return std::nullopt;
  }

  [[nodiscard]] std::uint64_t least_bytes(PlyType type) const override { return size_of(type); }
  [[nodiscard]] std::optional<std::uint64_t> bytes_left() const override { return input_.left(); }
  [[nodiscard]] bool row_is_over() const override { return false; }

  bool anything_left() override {
    begin_ = input_.offset();
    return !input_.ahead(1).empty();
  }

  [[nodiscard]] Location location() const override { return {.byte = begin_}; }

 private:
  InputBuffer& input_;
  ReaderOptions options_;
  bool swaps_;
  std::uint64_t begin_ = 0;
};

}  // namespace

std::unique_ptr<PlyValues> ply_values(InputBuffer& input, const PlyHeader& header, const ReaderOptions& options) {
  if (header.encoding == PlyEncoding::Ascii) return std::make_unique<TextValues>(input, header, options);
  return std::make_unique<BinaryValues>(input, header.encoding == PlyEncoding::BigEndian, options);
}

}  // namespace meshhood::io
