// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <memory>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "io/binary.h"
#include "io/ply_values.h"
#include "shared/distance.h"

namespace meshhood::inline v0_1::io {
namespace {

using std::uint64_t;

// Plain rows are in the byte order of the processor. The next two functions take rows from the front of `bytes` as long
// as they are complete and valid.

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
  const std::span<const PlyProperty> properties = element.properties;
  const std::size_t stride = bytes_of(properties);
  const std::array offsets{bytes_of(properties.first(axes[0])), bytes_of(properties.first(axes[1])),
                           bytes_of(properties.first(axes[2]))};
  const auto is_other = [&](std::size_t axis) { return element.properties[axis].type != kType; };
  if (std::any_of(axes.begin(), axes.end(), is_other)) return {};
  const auto take_some = [=, &positions, xyz = std::vector<Real>()](std::string_view bytes, uint64_t most) mutable {
    const std::size_t rows = take_vertices(bytes, stride, offsets, most, xyz);
    positions.append(std::span<const Real>(xyz).first(3 * rows));
    return Taken{rows * stride, rows};
  };
  return binary_rows(input, options, take_some);
}

PlyRows binary_faces(InputBuffer& input, const ReaderOptions& options, const PlyElement& element, std::size_t list,
                     uint64_t vertices, Faces& faces) {
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

class BinaryValues final : public PlyValues {
 public:
  BinaryValues(InputBuffer& input, std::endian order, ReaderOptions options)
      : input_(input), options_(std::move(options)), order_(order) {}

  PlyRows vertex_rows(const PlyElement& element, const std::array<std::size_t, 3>& axes,
                      Positions& positions) override {
    if (order_ != std::endian::native || !are_single(element.properties)) return {};
    if (positions.are_double()) return binary_vertices<double>(input_, options_, element, axes, positions);
    return binary_vertices<float>(input_, options_, element, axes, positions);
  }

  PlyRows face_rows(const PlyElement& element, std::size_t list, std::uint64_t vertices, Faces& faces) override {
    if (order_ != std::endian::native) return {};
    return binary_faces(input_, options_, element, list, vertices, faces);
  }

  Problem take_coordinate(PlyType type, Positions& positions) override {
    begin_ = input_.offset();
    return with_type(type, [&](auto example) -> Problem {
      if (!load(input_, order_, example)) return std::string(kFileEnds);
      return Problem(positions.append(static_cast<double>(example)));
    });
  }

  Problem take_integer(PlyType type, std::int64_t& value) override {
    begin_ = input_.offset();
    return with_type(type, [&](auto example) -> Problem {
      if (!load(input_, order_, example)) return std::string(kFileEnds);
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
  bool end_row(const PlyElement& /*element*/, std::uint64_t /*row*/) override { return false; }
  [[nodiscard]] std::string hint() const override { return ""; }

  bool anything_left() override {
    begin_ = input_.offset();
    return !input_.ahead(1).empty();
  }

  [[nodiscard]] Location location() const override { return {.byte = begin_}; }

 private:
  InputBuffer& input_;
  ReaderOptions options_;
  std::endian order_;
  std::uint64_t begin_ = 0;
};

}  // namespace

std::unique_ptr<PlyValues> ply_binary(InputBuffer& input, const PlyHeader& header, const ReaderOptions& options) {
  return std::make_unique<BinaryValues>(input, order_of(header.encoding), options);
}

}  // namespace meshhood::inline v0_1::io
