// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "io/mesh_builder.h"
#include "io/plain_rows.h"
#include "io/plain_text.h"

/// Plain rows of vertices and faces in text, a line each, as in PLY and OFF files.
namespace meshhood::inline v0_1::io {

/// A row of a vertex.
struct VertexRow {
  static constexpr std::uint64_t kLines = 1;
  static constexpr std::string_view kInLastLine{};

  std::size_t values;
  std::array<std::size_t, 3> axes;  ///< which values are x, y, z

  template <class Real>
  const char* take(const char* at, const char* end, PlainBlock<Real>& block) const {
    std::array<Real, 3> position = {};
    for (std::size_t value = 0; value < values; ++value) {
      const auto axis = std::find(axes.begin(), axes.end(), value);
      at = axis == axes.end() ? plain::skip_token(at)
                              : plain::take_coordinate(at, end, position[static_cast<std::size_t>(axis - axes.begin())],
                                                       block.float_keeps);
    }
    block.positions.insert(block.positions.end(), position.begin(), position.end());
    return plain::take_line_end(at);
  }
};

/// A row of a face: values, the number of vertices, the vertices, and values.
struct FaceRow {
  static constexpr std::uint64_t kLines = 1;
  static constexpr std::string_view kInLastLine{};

  std::size_t before;
  std::size_t after;
  std::uint64_t most_count;  ///< of vertices
  std::uint64_t end;         ///< every index is smaller

  template <class Real>
  const char* take(const char* at, const char* /*end*/, PlainBlock<Real>& block) const {
    std::uint32_t count = 0;
    at = plain::take_integer(skip_tokens(before, at), count);
    if (count > most_count) return nullptr;
    for (std::uint32_t i = 0; i < count && at != nullptr; ++i) {
      std::uint32_t index = 0;
      at = plain::take_integer(at, index);
      if (index >= end) return nullptr;
      block.faces.append_corner(index);
    }
    at = plain::take_line_end(skip_tokens(after, at));
    if (at != nullptr) block.faces.end_face(count);
    return at;
  }

 private:
  static const char* skip_tokens(std::size_t count, const char* at) {
    for (std::size_t i = 0; i < count; ++i) at = plain::skip_token(at);
    return at;
  }
};

}  // namespace meshhood::inline v0_1::io
