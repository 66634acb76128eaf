// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>
#include <string_view>
#include <type_traits>

#include <fmt/format.h>

#include "io/binary.h"
#include "io/mesh_builder.h"
#include "io/readers.h"
#include "io/stl_text.h"
#include "io/welder.h"

// A file of the size of a binary STL is binary, even if it begins with "solid", as many do. In a longer one, each facet
// is followed by as many bytes as its last two say; in others, programs keep a color there.

namespace meshhood::inline v0_1::io {
namespace {

using std::uint64_t;

constexpr std::size_t kHeaderBytes = 84;
constexpr std::size_t kFacetBytes = 50;
constexpr std::size_t kNormalBytes = 12;

template <class T>
T number_in(std::string_view bytes, std::size_t place) {
  return number_at<T>(bytes.substr(place).data(), std::endian::little);
}

std::uint32_t facet_count(std::string_view header) { return number_in<std::uint32_t>(header, kHeaderBytes - 4); }

uint64_t binary_size(std::string_view header) { return kHeaderBytes + kFacetBytes * uint64_t{facet_count(header)}; }

bool is_text(std::string_view bytes) {
  return std::all_of(bytes.begin(), bytes.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte >= 0x20 || ('\t' <= c && c <= '\r');
  });
}

bool is_binary(InputBuffer& input) {
  if (has_binary_stl_size(input)) return true;
  const auto header = input.ahead(kHeaderBytes).substr(0, kHeaderBytes);
  if (header.size() < kHeaderBytes || is_text(header)) return false;
  const auto left = input.left();
  return !left || *left >= binary_size(header);
}

std::string why_not_binary(InputBuffer& input) {
  const auto header = input.ahead(kHeaderBytes);
  if (header.size() < kHeaderBytes) return "it is not a binary STL, which has at least 84 bytes";
  return fmt::format("it is not a binary STL, which would have {} bytes for the {} facets of its header",
                     binary_size(header), facet_count(header));
}

template <class Real>
class BinaryStl {
 public:
  BinaryStl(InputBuffer& input, MeshBuilder& builder, Welder<Real>& welder)
      : input_(input), builder_(builder), welder_(welder) {}

  void read() {
    const auto facets = facet_count(input_.ahead(kHeaderBytes));
    input_.skip(kHeaderBytes);
    was_size_known_ = input_.left().has_value();
    are_followed_ = input_.left().value_or(0) > kFacetBytes * uint64_t{facets};
    // A closed surface has half as many vertices as triangles. The file has as many bytes as its header says, if the
    // number is known.
    if (const auto left = input_.left()) welder_.expect(static_cast<std::size_t>(*left / kFacetBytes / 2));
    for (std::uint32_t facet = 0; facet < facets; ++facet) read_facet(facet, facets);
    if (!input_.ahead(1).empty()) judge_rest(facets);
  }

 private:
  using Corners = std::array<typename Welder<Real>::Point, 3>;

  void read_facet(std::uint32_t facet, std::uint32_t facets) {
    const auto bytes = input_.ahead(kFacetBytes);
    if (bytes.size() < kFacetBytes) {
      fail_at(input_.name(), {.byte = input_.offset()}, ErrorCode::MalformedFile,
              fmt::format("the file ends in facet {} of {}, {} facets are missing", facet, facets, facets - facet));
    }
    Corners corners;
    bool are_valid = true;
    for (std::size_t i = 0; i < 9; ++i) {
      const float number = coordinate(bytes, i);
      corners[i / 3][i % 3] = number;
      are_valid = are_valid && std::isfinite(number);
    }
    if (!are_valid) refuse(bytes, facet);
    append_triangle(corners, {.byte = input_.offset()}, builder_, welder_);
    const std::size_t payload = number_in<std::uint16_t>(bytes, kFacetBytes - 2);
    if (payload != 0) has_payload_ = true;
    input_.skip(kFacetBytes);
    if (payload != 0 && are_followed_) skip_payload(payload, facet);
  }

  void skip_payload(std::size_t bytes, std::uint32_t facet) {
    builder_.warnings.add("facets followed by bytes of their own", {.byte = input_.offset()});
    if (input_.ahead(bytes).size() < bytes) {
      fail_at(input_.name(), {.byte = input_.offset()}, ErrorCode::MalformedFile,
              fmt::format("facet {} says that {} bytes follow, and the file is shorter", facet, bytes));
    }
    input_.skip(bytes);
  }

  // Without facets, or if bytes may follow each, the rest may be part of the mesh.
  void judge_rest(std::uint32_t facets) {
    const Location location{.byte = input_.offset()};
    if (facets != 0 && !has_payload_) return builder_.warnings.add("bytes after the last facet", location);
    fail_at(input_.name(), location, ErrorCode::MalformedFile,
            fmt::format("bytes after the last of {} facets, expected {}{}", facets,
                        facets == 0 ? "the number of facets in the header" : "as many as the facets say", advice()));
  }

  /// Without the size, as from a pipe, bytes after a facet are not told from a color.
  [[nodiscard]] std::string_view advice() const {
    return has_payload_ && !was_size_known_
               ? "; facets followed by bytes are not read from a pipe: store them in a file"
               : "";
  }

  static float coordinate(std::string_view facet, std::size_t i) {
    return number_in<float>(facet, kNormalBytes + 4 * i);
  }

  [[noreturn]] void refuse(std::string_view bytes, std::uint32_t facet) const {
    std::size_t i = 0;
    while (std::isfinite(coordinate(bytes, i))) ++i;
    fail_at(input_.name(), {.byte = input_.offset() + kNormalBytes + 4 * i}, ErrorCode::MalformedFile,
            fmt::format("facet {}, vertex {}, {} is not finite{}", facet, i / 3, axis(i), advice()));
  }

  InputBuffer& input_;
  MeshBuilder& builder_;
  Welder<Real>& welder_;
  bool was_size_known_ = false;
  bool are_followed_ = false;  // by bytes that belong to them
  bool has_payload_ = false;   // a facet says so, or has a color
};

// Reserves memory for the largest possible number of corners, each with its own vertex.
void reserve(MeshBuilder& builder, const InputBuffer& input, bool binary) {
  constexpr uint64_t kLeastTextOfVertex = 13;  // "vertex 0 0 0 "
  const auto left = input.left();
  if (!left) return;
  const auto corners = binary ? 3 * (*left / kFacetBytes) : *left / kLeastTextOfVertex;
  builder.positions.reserve(corners);
  builder.faces.reserve_corners(corners);
}

template <class Real>
void read_soup(InputBuffer& input, const ReaderOptions& options, bool binary, MeshBuilder& builder,
               std::vector<Real>& positions) {
  Welder<Real> welder(positions, builder.faces.corners(), input.name());
  if (binary) {
    BinaryStl<Real>(input, builder, welder).read();
  } else {
    read_stl_text(input, options, builder, welder);
  }
}

// Whether vertices at different positions are so as floats.
bool differ_as_floats(const std::vector<double>& positions, const std::string& file) {
  std::vector<float> floats;
  std::vector<std::uint32_t> ids;
  Welder<float> welder(floats, ids, file);
  welder.expect(positions.size() / 3);
  for (std::size_t i = 0; i < positions.size(); i += 3) {
    welder.append(
        {static_cast<float>(positions[i]), static_cast<float>(positions[i + 1]), static_cast<float>(positions[i + 2])});
  }
  return floats.size() == positions.size();
}

/// Calls `read`. If the file may be text or binary, the error names both reasons; without exceptions, only that of the
/// text.
template <class F>
void read_or_explain([[maybe_unused]] bool may_be_either, [[maybe_unused]] const std::string& not_binary, F&& read) {
#if defined(__cpp_exceptions)
  try {
    read();
  } catch (const Error& error) {
    if (!may_be_either) throw;
    raise(error.code(), fmt::format("{}; and {}", error.what(), not_binary));
  }
#else
  read();
#endif
}

}  // namespace

bool has_binary_stl_size(InputBuffer& input) {
  const auto header = input.ahead(kHeaderBytes);
  return header.size() >= kHeaderBytes && input.left() == binary_size(header);
}

Mesh read_stl(InputBuffer& input, const ReaderOptions& options) {
  const bool binary = is_binary(input);
  const bool may_be_either = !binary && !is_text(input.ahead(kHeaderBytes).substr(0, kHeaderBytes));
  const std::string not_binary = binary ? "" : why_not_binary(input);
  MeshBuilder builder(input, options, binary ? Declared::Float : Declared::Nothing);
  reserve(builder, input, binary);
  read_or_explain(may_be_either, not_binary, [&] {
    std::visit([&](auto& positions) { read_soup(input, options, binary, builder, positions); },
               builder.positions.values());
  });
  if (builder.positions.are_open()) {
    builder.positions.note(differ_as_floats(std::get<std::vector<double>>(builder.positions.values()), input.name()));
  }
  return builder.finish(Format::Stl);
}

}  // namespace meshhood::inline v0_1::io
