// SPDX-License-Identifier: MIT
#include "vertex_files.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "meshhood/error.h"

#include "io/binary.h"
#include "io/byte_source.h"
#include "io/input_buffer.h"
#include "io/mesh_io.h"
#include "io/messages.h"
#include "io/npy.h"
#include "io/number.h"
#include "io/text.h"
#include "options.h"
#include "output.h"
#include "system.h"

namespace meshhood::cli {
namespace {

[[noreturn]] void fail(const io::InputBuffer& input, std::string_view message) {
  wrong_option("{}: {}", input.name(), message);
}

/// Any number of rows is right if `vertices` has none.
void check_rows(const io::InputBuffer& input, std::uint64_t rows, std::optional<std::size_t> vertices) {
  if (!vertices || rows == *vertices) return;
  fail(input, fmt::format("{} rows of values, expected {}, one for each vertex", rows, *vertices));
}

void refuse_xml(io::InputBuffer& input) {
  if (!input.ahead(1).starts_with('<')) return;
  fail(input,
       "is XML, expected numbers; numpy.savetxt(\"values.txt\", nibabel.load(FILE).agg_data()) writes those of "
       "GIFTI");
}

/// Opens a file and calls `read(input)`. A malformed one is a wrong option, not a wrong mesh.
template <class Read>
auto read_file(const std::string& file, Read&& read) {
  io::FileSource source(path_of(file));
  io::InputBuffer input(source, file, io::ReadOptions{}.max_bytes);
  try {
    io::take_byte_order_mark(input);
    refuse_xml(input);
    return read(input);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::MalformedFile && error.code() != ErrorCode::UnsupportedFormat) throw;
    raise(ErrorCode::InvalidOption, error.what());
  }
}

/// Whole numbers may have an exponent: R writes 1e+05, and NumPy 1.000000000000000000e+05.
VertexId parse_vertex(const io::Text& text, std::string_view token, std::size_t vertices) {
  const double vertex = io::parse_real<double>(token).value_or(-1);
  if (vertex >= 0 && vertex < static_cast<double>(vertices) && vertex == std::floor(vertex)) {
    return static_cast<VertexId>(vertex);
  }
  const std::string expected =
      vertices == 0 ? "no vertex: the mesh has none" : fmt::format("a vertex from 0 to {}", vertices - 1);
  text.fail(ErrorCode::InvalidOption, fmt::format("{}, expected {}", io::quote(token), expected));
}

/// A number of a line; none at its end.
std::optional<double> next_number(io::Text& text) {
  const std::string_view token = text.token_on_line();
  if (token.empty()) return std::nullopt;
  const std::optional<double> number = parse_number(token);
  if (number) return number;
  text.fail(ErrorCode::InvalidOption, fmt::format("{}, expected a number in the range of double", io::quote(token)));
}

Channels read_text(io::InputBuffer& input, std::optional<std::size_t> vertices) {
  io::Text text(input, {.hash_comments = true});
  Channels values;
  std::size_t rows = 0;
  while (text.next_line()) {
    std::size_t count = 0;
    for (; const std::optional<double> number = next_number(text); ++count) values.numbers.push_back(*number);
    if (count == 0) continue;
    if (rows++ == 0) values.channels = count;
    if (count != values.channels) {
      text.fail(ErrorCode::InvalidOption, fmt::format("{} numbers on a line, expected {}", count, values.channels));
    }
    if (vertices && rows > *vertices) check_rows(input, rows, vertices);
  }
  check_rows(input, rows, vertices);
  if (values.channels == 0) values.channels = 1;  // of no vertices
  return values;
}

template <class T>
double number_at(const char* bytes, std::endian order) {
  return static_cast<double>(io::number_at<T>(bytes, order));
}

/// How to read a number of a type of NumPy.
struct NumberType {
  char kind;
  std::size_t bytes;
  double (*read)(const char* bytes, std::endian order);
};

constexpr std::array kNumberTypes{
    NumberType{'f', 8, number_at<double>},        NumberType{'f', 4, number_at<float>},
    NumberType{'i', 8, number_at<std::int64_t>},  NumberType{'i', 4, number_at<std::int32_t>},
    NumberType{'i', 2, number_at<std::int16_t>},  NumberType{'i', 1, number_at<std::int8_t>},
    NumberType{'u', 8, number_at<std::uint64_t>}, NumberType{'u', 4, number_at<std::uint32_t>},
    NumberType{'u', 2, number_at<std::uint16_t>}, NumberType{'u', 1, number_at<std::uint8_t>},
    NumberType{'b', 1, number_at<std::uint8_t>},
};

const NumberType& number_type(const io::InputBuffer& input, const io::NpyHeader& header) {
  for (const NumberType& type : kNumberTypes) {
    if (type.kind == header.kind && type.bytes == header.item) return type;
  }
  fail(input, fmt::format("values of type {}{}, expected floats of 4 or 8 bytes, integers or bools", header.kind,
                          header.item));
}

Channels read_numpy(io::InputBuffer& input, std::optional<std::size_t> vertices) {
  const io::NpyHeader header = io::parse_npy_header(input.ahead(io::kNpyHeadBytes), input.name());
  if (header.shape.size() != 1 && header.shape.size() != 2) {
    fail(input, fmt::format("an array of {} dimensions, expected one or two", header.shape.size()));
  }
  check_rows(input, header.shape.front(), vertices);
  const NumberType& type = number_type(input, header);
  Channels values{{}, header.shape.size() == 2 ? header.shape.back() : 1};
  if (values.channels == 0) fail(input, "the array has no columns, expected at least one");
  if (header.fortran_order && values.channels > 1) fail(input, "the array is in Fortran order, expected C order");
  input.skip(header.bytes);
  for (std::uint64_t row = 0; row < header.shape.front(); ++row) {
    for (std::uint64_t channel = 0; channel < values.channels; ++channel) {
      const std::string_view number = input.ahead(type.bytes);
      if (number.size() < type.bytes) fail(input, fmt::format("the file ends within row {}", row));
      values.numbers.push_back(type.read(number.data(), header.order));
      input.skip(type.bytes);
    }
  }
  if (!input.ahead(1).empty()) fail(input, "bytes after the array");
  return values;
}

std::vector<std::uint8_t> read_mask(const std::string& file, const Input& input) {
  if (file.empty()) return {};
  std::vector<std::uint8_t> mask(input.vertex_count());
  const std::vector<VertexId> list = read_vertex_list(file, mask.size());
  if (list.size() == mask.size() && list.size() > 2 && std::ranges::max(list) <= 1) {
    wrong_option(
        "{}: {} numbers 0 or 1, expected the vertices of the mask, one in each "
        "line",
        printable_name(file), list.size());
  }
  for (const VertexId v : list) mask[input.welding().kept(v)] = 1;
  return mask;
}

}  // namespace

std::vector<VertexId> read_vertex_list(const std::string& file, std::size_t vertices, std::size_t columns) {
  return read_file(file, [&](io::InputBuffer& input) {
    io::Text text(input, {.hash_comments = true});
    std::vector<VertexId> list;
    bool may_be_name = true;  // of a column of `pair_names`
    while (text.next_line()) {
      std::string_view token = text.token_on_line();
      if (token.empty() || (std::exchange(may_be_name, false) && (token == "vertex" || token == "neighbor"))) continue;
      for (std::size_t column = 0; column < columns; ++column, token = text.token_on_line()) {
        list.push_back(parse_vertex(text, token, vertices));
      }
      if (!token.empty()) {
        text.fail(ErrorCode::InvalidOption, fmt::format("{}, expected the end of the line", io::quote(token)));
      }
    }
    return list;
  });
}

Channels read_channels(const std::string& file, std::optional<std::size_t> vertices) {
  return read_file(file, [&](io::InputBuffer& input) {
    return io::is_npy(input.ahead(io::kNpyHeadBytes)) ? read_numpy(input, vertices) : read_text(input, vertices);
  });
}

std::vector<SpacePoint> read_points(const std::string& file) {
  constexpr std::size_t kAxes = 3;
  const Channels read = read_channels(file, std::nullopt);
  if (read.channels != kAxes && (!read.numbers.empty() || read.channels > 1)) {
    wrong_option("{}: {} numbers for each point, expected {}", printable_name(file), read.channels, kAxes);
  }
  constexpr double kMost = 0x1p500;
  std::vector<SpacePoint> points(read.numbers.size() / kAxes);
  for (std::size_t i = 0; i < read.numbers.size(); ++i) {
    if (!(std::abs(read.numbers[i]) <= kMost)) {
      wrong_option("{}: row {}: coordinate {} is {}, expected a finite number of magnitude up to 2^500",
                   printable_name(file), i / kAxes, i % kAxes, read.numbers[i]);
    }
    points[i / kAxes][i % kAxes] = read.numbers[i];
  }
  return points;
}

std::vector<double> read_channel(const std::string& file, std::size_t vertices, std::string_view values) {
  Channels read = read_channels(file, vertices);
  if (read.channels == 1) return std::move(read.numbers);
  wrong_option("{}: {} {} for each vertex, expected one", printable_name(file), read.channels, values);
}

void add_masks(CLI::App& command, MaskFiles& files) {
  add_file_option(command, "--walls", "a list of vertices that no search passes, one in each line", files.walls);
  add_file_option(command, "--ignored", "a list of vertices that a search passes but does not count", files.ignored);
}

OwnedMasks read_masks(const MaskFiles& files, const Input& input) {
  return {read_mask(files.walls, input), read_mask(files.ignored, input)};
}

}  // namespace meshhood::cli
