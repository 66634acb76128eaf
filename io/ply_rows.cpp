// SPDX-License-Identifier: MIT
#include "io/ply_rows.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "io/plain_elements.h"
#include "io/plain_rows.h"
#include "shared/distance.h"

namespace meshhood::inline v0_1::io {
namespace {

using std::uint64_t;

bool are_single(std::span<const PlyProperty> properties) {
  return std::none_of(properties.begin(), properties.end(), [](const PlyProperty& p) { return p.is_list; });
}

/// Of an integer type.
uint64_t largest(PlyType type) {
  const bool is_signed = type == PlyType::Int8 || type == PlyType::Int16 || type == PlyType::Int32;
  return (uint64_t{1} << (8 * size_of(type) - (is_signed ? 1 : 0))) - 1;
}

/// Rows that are a line each. `append` receives them in blocks.
template <class Real, class Row, class Append>
PlyRows text_rows(Text& text, const ReaderOptions& options, const Row& row, Append append) {
  const auto plain = std::make_shared<PlainRows<Real, Row>>(text, options, row);
  return [plain, append](uint64_t most) {
    uint64_t taken = 0;
    plain->take(most, [&](const PlainBlock<Real>& block) {
      append(block);
      taken += block.rows;
      return true;
    });
    return taken;
  };
}

template <class Real>
PlyRows text_vertices(Text& text, const ReaderOptions& options, const VertexRow& row, Positions& positions) {
  return text_rows<Real>(text, options, row, [&positions](const PlainBlock<Real>& block) { positions.append(block); });
}

// In a binary file, plain rows are in the byte order of the processor. The next two functions take rows from the front
// of `bytes` as long as they are complete and valid.

/// Rows of `stride` bytes, with coordinates of the type `Real` at `offsets`. Returns how many, and writes them over the
/// front of `positions`, which grows but does not shrink: there may be many calls for few rows each.
template <class Real>
std::size_t take_vertices(std::string_view bytes, std::size_t stride, const std::array<std::size_t, 3>& offsets,
                          std::uint64_t most, std::vector<Real>& positions) {
  const auto rows = static_cast<std::size_t>(std::min<std::uint64_t>(most, bytes.size() / stride));
  positions.resize(std::max(positions.size(), 3 * rows));
  for (std::size_t row = 0; row < rows; ++row) {
    bool are_valid = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Real& coordinate = positions[3 * row + axis];
      std::memcpy(&coordinate, bytes.data() + row * stride + offsets[axis], sizeof(Real));
      are_valid = are_valid && double{std::abs(coordinate)} <= kLargestCoordinate;
    }
    if (!are_valid) return row;
  }
  return rows;
}

/// Replaces `corners`, and returns how many bytes it took. Rows of a byte, which is `count`, and as many indices of 32
/// bits, each smaller than `end`. A `count` known to the compiler is faster.
template <class Count>
std::size_t take_faces(std::string_view bytes, Count count, std::uint32_t end, std::uint64_t most,
                       std::vector<std::uint32_t>& corners) {
  const std::size_t stride = 1 + sizeof(std::uint32_t) * std::size_t{count};
  const auto rows = static_cast<std::size_t>(std::min<std::uint64_t>(most, bytes.size() / stride));
  corners.resize(rows * count);
  std::size_t row = 0;
  for (; row < rows; ++row) {
    const char* const from = bytes.data() + row * stride;
    if (static_cast<unsigned char>(*from) != count) break;
    std::uint32_t* const to = corners.data() + row * count;
    if (count != 0) std::memcpy(to, from + 1, stride - 1);
    if (std::any_of(to, to + count, [end](std::uint32_t index) { return index >= end; })) break;
  }
  corners.resize(row * count);
  return row * stride;
}

struct Taken {
  std::size_t bytes = 0;
  uint64_t rows = 0;
};

/// Rows of bytes. `take_some` appends rows from the front of some bytes, up to a number of rows.
template <class TakeSome>
PlyRows binary_rows(InputBuffer& input, const ReaderOptions& options, TakeSome take_some) {
  return [&input, block_bytes = options.block_bytes, take_some](uint64_t most) mutable {
    uint64_t sum = 0;
    while (sum < most) {
      const Taken taken = take_some(input.ahead(1).substr(0, block_bytes), most - sum);
      if (taken.rows == 0) break;
      input.skip(taken.bytes);
      sum += taken.rows;
    }
    return sum;
  };
}

template <class Real>
PlyRows binary_vertices(InputBuffer& input, const ReaderOptions& options, const PlyElement& element,
                        const std::array<std::size_t, 3>& axes, Positions& positions) {
  constexpr PlyType kType = std::is_same_v<Real, float> ? PlyType::Float32 : PlyType::Float64;
  std::array<std::size_t, 3> offsets = {};
  std::size_t stride = 0;
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (axes[axis] == i) offsets[axis] = stride;
    }
    stride += size_of(element.properties[i].type);
  }
  const auto is_other = [&](std::size_t axis) { return element.properties[axis].type != kType; };
  if (std::any_of(axes.begin(), axes.end(), is_other)) return {};
  const auto take_some = [=, &positions, xyz = std::vector<Real>()](std::string_view bytes, uint64_t most) mutable {
    const std::size_t rows = take_vertices(bytes, stride, offsets, most, xyz);
    positions.append(std::span<const Real>(xyz).first(3 * rows));
    return Taken{rows * stride, rows};
  };
  return binary_rows(input, options, take_some);
}

}  // namespace

PlyRows vertex_rows(Text& text, const ReaderOptions& options, const PlyElement& element,
                    const std::array<std::size_t, 3>& axes, Positions& positions) {
  if (!are_single(element.properties)) return {};
  const VertexRow row{element.properties.size(), axes};
  if (positions.are_double()) return text_vertices<double>(text, options, row, positions);
  return text_vertices<float>(text, options, row, positions);
}

PlyRows face_rows(Text& text, const ReaderOptions& options, const PlyElement& element, std::size_t list,
                  std::uint64_t vertices, Faces& faces) {
  constexpr uint64_t kMostCount = 255;
  const std::span<const PlyProperty> properties = element.properties;
  if (!are_single(properties.first(list)) || !are_single(properties.subspan(list + 1))) return {};
  const FaceRow row{.before = list,
                    .after = properties.size() - list - 1,
                    .most_count = std::min(kMostCount, largest(properties[list].count_type)),
                    .end = std::min(vertices, largest(properties[list].type) + 1)};
  return text_rows<float>(text, options, row, [&faces](const PlainBlock<float>& block) { faces.append(block.faces); });
}

PlyRows vertex_rows(InputBuffer& input, const ReaderOptions& options, const PlyElement& element,
                    const std::array<std::size_t, 3>& axes, Positions& positions) {
  if (!are_single(element.properties)) return {};
  if (positions.are_double()) return binary_vertices<double>(input, options, element, axes, positions);
  return binary_vertices<float>(input, options, element, axes, positions);
}

PlyRows face_rows(InputBuffer& input, const ReaderOptions& options, const PlyElement& element, std::size_t list,
                  std::uint64_t vertices, Faces& faces) {
  const PlyProperty& property = element.properties[list];
  const bool is_usual = element.properties.size() == 1 && property.count_type == PlyType::Uint8 &&
                        (property.type == PlyType::Int32 || property.type == PlyType::Uint32);
  if (!is_usual) return {};
  const auto end = static_cast<std::uint32_t>(std::min(vertices, largest(property.type)));
  const auto take_some = [end, &faces, corners = std::vector<std::uint32_t>()](std::string_view bytes,
                                                                               uint64_t most) mutable -> Taken {
    if (bytes.empty()) return {};
    constexpr std::integral_constant<std::size_t, 3> kTriangle;
    const std::size_t count = static_cast<unsigned char>(bytes[0]);
    const std::size_t taken = count == kTriangle ? take_faces(bytes, kTriangle, end, most, corners)
                                                 : take_faces(bytes, count, end, most, corners);
    const std::size_t rows = taken / (1 + sizeof(std::uint32_t) * count);
    faces.append(rows, corners);
    return {taken, rows};
  };
  return binary_rows(input, options, take_some);
}

}  // namespace meshhood::inline v0_1::io
