// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "io/mesh_builder.h"
#include "io/plain_rows.h"
#include "io/plain_text.h"

namespace meshhood::io {

/// Plain rows of an OBJ file: vertices of three coordinates with or without a color, faces whose indices are positive,
/// texture coordinates and normals.
template <class Real>
class PlainObj {
 public:
  /// is_open  whether to find out if float keeps the coordinates.
  explicit PlainObj(bool is_open) : is_open_(is_open), keeps_(is_open) {}

  static constexpr std::uint64_t kLines = 1;
  static std::size_t split(std::string_view text, std::size_t place) { return next_line_of(text, place); }

  const char* take(const char* row, const char* end) {
    const char* after = nullptr;
    if (row[0] == 'v' && plain::is_blank(row[1])) {
      after = take_vertex(row + 1, end);
    } else if (row[0] == 'f' && plain::is_blank(row[1])) {
      after = take_face(row + 1);
    } else if (row[0] == 'v' && (row[1] == 't' || row[1] == 'n') && plain::is_blank(row[2])) {
      after = skip_numbers(row + 2);
    }
    rows_ += after != nullptr ? 1 : 0;
    return after;
  }

  [[nodiscard]] std::size_t size() const { return rows_; }

  void clear() {
    rows_ = 0;
    positions_.clear();
    faces_.clear();
    most_missing_ = 0;
    keeps_ = is_open_;
  }

  [[nodiscard]] std::span<const Real> positions() const { return positions_; }
  [[nodiscard]] std::size_t vertex_count() const { return positions_.size() / 3; }
  [[nodiscard]] const PlainFaces& faces() const { return faces_; }

  /// Whether float keeps all coordinates.
  [[nodiscard]] bool float_keeps() const { return keeps_; }

  /// How many vertices must precede these rows, so that no face names a vertex that follows it.
  [[nodiscard]] std::size_t most_missing() const { return most_missing_; }

 private:
  const char* take_vertex(const char* at, const char* end) {
    std::array<Real, 3> position;
    bool keeps = keeps_;
    for (Real& coordinate : position) {
      at = plain::take_coordinate(at, end, coordinate, keeps);
      if (at == nullptr) return nullptr;
    }
    const char* after = plain::take_line_end(at);
    if (after == nullptr) after = skip_color(at, end);
    if (after == nullptr) return nullptr;
    positions_.insert(positions_.end(), position.begin(), position.end());
    keeps_ = keeps;
    return after;
  }

  static const char* skip_color(const char* at, const char* end) {
    double number = 0;
    for (int i = 0; i < 3; ++i) {
      at = plain::take_number(at, end, number);
      if (at == nullptr) return nullptr;
    }
    return plain::take_line_end(at);
  }

  const char* take_face(const char* at) {
    constexpr std::size_t kMostCorners = 255;
    const std::size_t begin = faces_.corners.size();
    std::size_t missing = most_missing_;
    const char* after = nullptr;
    while (after == nullptr && at != nullptr && faces_.corners.size() - begin < kMostCorners) {
      std::uint32_t index = 0;
      at = take_corner(plain::skip_blanks(at), index);
      if (at == nullptr || index == 0) break;
      faces_.corners.push_back(index - 1);
      if (index > vertex_count()) missing = std::max(missing, index - vertex_count());
      after = plain::take_line_end(at);
    }
    if (after == nullptr) {
      faces_.corners.resize(begin);
    } else {
      faces_.end_face(faces_.corners.size() - begin);
      most_missing_ = missing;
    }
    return after;
  }

  /// `v`, `v/vt`, `v//vn` or `v/vt/vn`.
  static const char* take_corner(const char* at, std::uint32_t& index) {
    std::uint32_t other = 0;
    at = plain::take_digits(at, index);
    if (at == nullptr) return nullptr;
    for (int i = 0; i < 2 && *at == '/'; ++i) {
      ++at;
      if (plain::is_digit(*at)) at = plain::take_digits(at, other);
      if (at == nullptr) return nullptr;
    }
    return plain::is_blank(*at) || *at == '\n' || *at == '\r' ? at : nullptr;
  }

  static const char* skip_numbers(const char* at) {
    const auto may_be_in_number = [](char c) {
      return plain::is_blank(c) || plain::is_digit(c) || c == '.' || c == '-' || c == '+' || c == 'e' || c == 'E';
    };
    while (may_be_in_number(*at)) ++at;
    return plain::take_line_end(at);
  }

  bool is_open_;
  bool keeps_;
  std::size_t rows_ = 0;
  std::vector<Real> positions_;
  PlainFaces faces_;
  std::size_t most_missing_ = 0;
};

}  // namespace meshhood::io
