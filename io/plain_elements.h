// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "io/mesh_builder.h"
#include "io/plain_rows.h"
#include "io/plain_text.h"

/// Plain rows of vertices and faces in text, a line each, as in PLY and OFF files.
namespace meshhood::io {

/// What to read of a row of a vertex.
struct VertexRow {
  std::size_t values;
  std::array<std::size_t, 3> axes;  ///< which values are x, y, z
  bool is_open = false;             ///< find out whether float keeps the coordinates
};

/// What to read of a row of a face: values, the number of vertices, the vertices, and values.
struct FaceRow {
  std::size_t before;
  std::size_t after;
  std::uint64_t most_count;  ///< of vertices
  std::uint64_t end;         ///< every index is smaller
};

template <class Real>
class PlainVertexRows {
 public:
  static constexpr std::uint64_t kLines = 1;
  static std::size_t split(std::string_view text, std::size_t place) { return next_line_of(text, place); }

  explicit PlainVertexRows(const VertexRow& row) : row_(row), keeps_(row.is_open) {}

  const char* take(const char* at, const char* end) {
    std::array<Real, 3> position;
    bool keeps = keeps_;
    for (std::size_t value = 0; value < row_.values; ++value) {
      at = take_value(value, at, end, position, keeps);
      if (at == nullptr) return nullptr;
    }
    at = plain::take_line_end(at);
    if (at == nullptr) return nullptr;
    positions_.insert(positions_.end(), position.begin(), position.end());
    keeps_ = keeps;
    return at;
  }

  [[nodiscard]] std::size_t size() const { return positions_.size() / 3; }
  void clear() {
    positions_.clear();
    keeps_ = row_.is_open;
  }

  [[nodiscard]] std::span<const Real> content() const { return positions_; }

  /// Whether float keeps all coordinates.
  [[nodiscard]] bool float_keeps() const { return keeps_; }

 private:
  const char* take_value(std::size_t value, const char* at, const char* end, std::array<Real, 3>& position,
                         bool& keeps) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (row_.axes[axis] == value) return plain::take_coordinate(at, end, position[axis], keeps);
    }
    return plain::skip_token(at);
  }

  VertexRow row_;
  bool keeps_;
  std::vector<Real> positions_;
};

class PlainFaceRows {
 public:
  static constexpr std::uint64_t kLines = 1;
  static std::size_t split(std::string_view text, std::size_t place) { return next_line_of(text, place); }

  explicit PlainFaceRows(const FaceRow& row) : row_(row) {}

  const char* take(const char* at, const char* /*end*/) {
    const std::size_t begin = faces_.corners.size();
    at = skip_tokens(row_.before, at);
    if (at != nullptr) at = take_list(at);
    if (at != nullptr) at = skip_tokens(row_.after, at);
    if (at != nullptr) at = plain::take_line_end(at);
    if (at == nullptr) {
      faces_.corners.resize(begin);
    } else {
      faces_.end_face(faces_.corners.size() - begin);
    }
    return at;
  }

  [[nodiscard]] std::size_t size() const { return faces_.sizes.size(); }
  void clear() { faces_.clear(); }

  [[nodiscard]] const PlainFaces& content() const { return faces_; }

 private:
  static const char* skip_tokens(std::size_t count, const char* at) {
    for (std::size_t i = 0; i < count && at != nullptr; ++i) at = plain::skip_token(at);
    return at;
  }

  const char* take_list(const char* at) {
    std::uint32_t count = 0;
    at = plain::take_integer(at, count);
    if (at == nullptr || count > row_.most_count) return nullptr;
    for (std::uint32_t i = 0; i < count; ++i) {
      std::uint32_t index = 0;
      at = plain::take_integer(at, index);
      if (at == nullptr || index >= row_.end) return nullptr;
      faces_.corners.push_back(index);
    }
    return at;
  }

  FaceRow row_;
  PlainFaces faces_;
};

}  // namespace meshhood::io
