// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "io/plain_rows.h"
#include "io/plain_text.h"
#include "io/vertex_welder.h"

namespace meshhood::io {

/// Plain facets of an STL file in text: seven lines of lower-case words and single blanks, three corners at different
/// positions.
template <class Real>
class PlainStl {
 public:
  using Facet = std::array<typename VertexWelder<Real>::Point, 3>;

  /// is_open  whether to find out if float keeps the coordinates.
  explicit PlainStl(bool is_open) : is_open_(is_open), keeps_(is_open) {}

  static constexpr std::uint64_t kLines = 7;
  static std::size_t split(std::string_view text, std::size_t place) {
    return next_line_of(text, text.find("endfacet", place));
  }

  const char* take(const char* at, const char* end) {
    Facet facet;
    bool keeps = keeps_;
    at = take_words(at, end, "facet normal ");
    for (int i = 0; i < 3 && at != nullptr; ++i) at = plain::skip_token(at);
    at = take_line_end(at);
    at = take_line(at, end, "outer loop");
    for (auto& corner : facet) at = take_corner(at, end, corner, keeps);
    at = take_line(at, end, "endloop");
    at = take_line(at, end, "endfacet");
    const auto& [a, b, c] = facet;
    if (at == nullptr || a == b || b == c || c == a) return nullptr;
    facets_.push_back(facet);
    keeps_ = keeps;
    return at;
  }

  [[nodiscard]] std::size_t size() const { return facets_.size(); }
  void clear() {
    facets_.clear();
    keeps_ = is_open_;
  }

  [[nodiscard]] std::span<const Facet> facets() const { return facets_; }

  /// Whether float keeps all coordinates.
  [[nodiscard]] bool float_keeps() const { return keeps_; }

 private:
  static const char* take_words(const char* at, const char* end, std::string_view words) {
    if (at == nullptr || at == end) return nullptr;
    at = plain::skip_blanks(at);
    const std::string_view rest(at, static_cast<std::size_t>(end - at));
    return rest.starts_with(words) ? at + words.size() : nullptr;
  }

  static const char* take_line_end(const char* at) { return at == nullptr ? nullptr : plain::take_line_end(at); }

  static const char* take_line(const char* at, const char* end, std::string_view words) {
    return take_line_end(take_words(at, end, words));
  }

  static const char* take_corner(const char* at, const char* end, typename VertexWelder<Real>::Point& corner,
                                 bool& keeps) {
    at = take_words(at, end, "vertex ");
    for (Real& coordinate : corner) {
      if (at != nullptr) at = plain::take_coordinate(at, end, coordinate, keeps);
    }
    return take_line_end(at);
  }

  bool is_open_;
  bool keeps_;
  std::vector<Facet> facets_;
};

}  // namespace meshhood::io
