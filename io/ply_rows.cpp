// SPDX-License-Identifier: MIT
#include "io/ply_rows.h"

#include <algorithm>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "io/plain_elements.h"
#include "io/plain_ply_bytes.h"
#include "io/plain_rows.h"

namespace meshhood::io {
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

/// Rows that are a line each.
template <class Rows, class Target>
class TextRows final : public PlyRows {
 public:
  TextRows(Text& text, const ReaderOptions& options, Rows empty, Target& target)
      : plain_(text, options, std::move(empty)), target_(target) {}

  uint64_t take(uint64_t most) override {
    uint64_t taken = 0;
    plain_.take(most, [&](const Rows& rows) {
      target_.append(rows.content());
      taken += rows.size();
      return true;
    });
    return taken;
  }

 private:
  PlainRows<Rows> plain_;
  Target& target_;
};

/// Rows of bytes.
class BinaryRows : public PlyRows {
 public:
  BinaryRows(InputBuffer& input, const ReaderOptions& options) : input_(input), block_bytes_(options.block_bytes) {}

  uint64_t take(uint64_t most) final {
    uint64_t sum = 0;
    while (sum < most) {
      const auto [bytes, rows] = take_some(input_.ahead(1).substr(0, block_bytes_), most - sum);
      if (rows == 0) break;
      input_.skip(bytes);
      sum += rows;
    }
    return sum;
  }

 protected:
  struct Taken {
    std::size_t bytes = 0;
    uint64_t rows = 0;
  };

  /// Appends rows from the front of `bytes`, up to `most`.
  virtual Taken take_some(std::string_view bytes, uint64_t most) = 0;

 private:
  InputBuffer& input_;
  std::size_t block_bytes_;
};

template <class Real>
class BinaryVertices final : public BinaryRows {
 public:
  BinaryVertices(InputBuffer& input, const ReaderOptions& options, std::size_t stride,
                 const std::array<std::size_t, 3>& offsets, Positions& positions)
      : BinaryRows(input, options), stride_(stride), offsets_(offsets), positions_(positions) {}

 private:
  Taken take_some(std::string_view bytes, uint64_t most) override {
    const std::size_t taken = take_vertices(bytes, stride_, offsets_, most, block_);
    positions_.append(std::span<const Real>(block_));
    return {taken, block_.size() / 3};
  }

  std::size_t stride_;
  std::array<std::size_t, 3> offsets_;
  Positions& positions_;
  std::vector<Real> block_;
};

class BinaryFaces final : public BinaryRows {
 public:
  BinaryFaces(InputBuffer& input, const ReaderOptions& options, std::uint32_t end, Faces& faces)
      : BinaryRows(input, options), end_(end), faces_(faces) {}

 private:
  Taken take_some(std::string_view bytes, uint64_t most) override {
    if (bytes.empty()) return {};
    constexpr std::integral_constant<std::size_t, 3> kTriangle;
    const std::size_t count = static_cast<unsigned char>(bytes[0]);
    const std::size_t taken = count == kTriangle ? take_faces(bytes, kTriangle, end_, most, block_)
                                                 : take_faces(bytes, count, end_, most, block_);
    const std::size_t rows = taken / (1 + sizeof(std::uint32_t) * count);
    faces_.append(rows, block_);
    return {taken, rows};
  }

  std::uint32_t end_;
  Faces& faces_;
  std::vector<std::uint32_t> block_;
};

template <class Real>
std::unique_ptr<PlyRows> text_vertices(Text& text, const ReaderOptions& options, const VertexRow& row,
                                       Positions& positions) {
  using Rows = PlainVertexRows<Real>;
  return std::make_unique<TextRows<Rows, Positions>>(text, options, Rows(row), positions);
}

template <class Real>
std::unique_ptr<PlyRows> binary_vertices(InputBuffer& input, const ReaderOptions& options, const PlyElement& element,
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
  if (std::any_of(axes.begin(), axes.end(), is_other)) return nullptr;
  return std::make_unique<BinaryVertices<Real>>(input, options, stride, offsets, positions);
}

}  // namespace

std::unique_ptr<PlyRows> vertex_rows(Text& text, const ReaderOptions& options, const PlyElement& element,
                                     const std::array<std::size_t, 3>& axes, Positions& positions) {
  if (!are_single(element.properties)) return nullptr;
  const VertexRow row{element.properties.size(), axes};
  if (positions.are_double()) return text_vertices<double>(text, options, row, positions);
  return text_vertices<float>(text, options, row, positions);
}

std::unique_ptr<PlyRows> face_rows(Text& text, const ReaderOptions& options, const PlyElement& element,
                                   std::size_t list, std::uint64_t vertices, Faces& faces) {
  constexpr uint64_t kMostCount = 255;
  const std::span<const PlyProperty> properties = element.properties;
  if (!are_single(properties.first(list)) || !are_single(properties.subspan(list + 1))) return nullptr;
  const FaceRow row{.before = list,
                    .after = properties.size() - list - 1,
                    .most_count = std::min(kMostCount, largest(properties[list].count_type)),
                    .end = std::min(vertices, largest(properties[list].type) + 1)};
  return std::make_unique<TextRows<PlainFaceRows, Faces>>(text, options, PlainFaceRows(row), faces);
}

std::unique_ptr<PlyRows> vertex_rows(InputBuffer& input, const ReaderOptions& options, const PlyElement& element,
                                     const std::array<std::size_t, 3>& axes, Positions& positions) {
  if (!are_single(element.properties)) return nullptr;
  if (positions.are_double()) return binary_vertices<double>(input, options, element, axes, positions);
  return binary_vertices<float>(input, options, element, axes, positions);
}

std::unique_ptr<PlyRows> face_rows(InputBuffer& input, const ReaderOptions& options, const PlyElement& element,
                                   std::size_t list, std::uint64_t vertices, Faces& faces) {
  const PlyProperty& property = element.properties[list];
  const bool is_usual = element.properties.size() == 1 && property.count_type == PlyType::Uint8 &&
                        (property.type == PlyType::Int32 || property.type == PlyType::Uint32);
  if (!is_usual) return nullptr;
  const auto end = static_cast<std::uint32_t>(std::min(vertices, largest(property.type)));
  return std::make_unique<BinaryFaces>(input, options, end, faces);
}

}  // namespace meshhood::io
