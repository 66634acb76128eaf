// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <string_view>

#include <fmt/format.h>

#include "io/binary.h"
#include "io/mesh_builder.h"
#include "io/readers.h"
#include "io/text.h"

// The triangle file of FreeSurfer: three bytes, two lines of text, the numbers of vertices and faces, positions, and
// corners, big-endian. Then, if anything, where the center of the surface lies in the scanner.

namespace meshhood::inline v0_1::io {
namespace {

using std::uint64_t;

class FreeSurferReader {
 public:
  FreeSurferReader(InputBuffer& input, const ReaderOptions& options)
      : input_(input), builder_(input, options, Declared::Float) {}

  Mesh read() {
    skip_head();
    const uint64_t vertices = read_count("vertices");
    const uint64_t faces = read_count("faces");
    check_size(vertices, faces);
    check_vertex_count(vertices, input_.name(), {.byte = begin_});
    read_positions(vertices);
    read_faces(faces, vertices);
    note_center();
    return builder_.finish(Format::FreeSurfer);
  }

 private:
  void skip_head() {
    if (!input_.ahead(kFreeSurferMark.size()).starts_with(kFreeSurferMark)) {
      malformed("expected the bytes ff ff fe of a triangle file");
    }
    input_.skip(kFreeSurferMark.size());
    Text text(input_, {.line_end = '\n'});
    for (int line = 0; line < 2; ++line) text.next_line();
    text.finish_line();
  }

  /// `what` and `which` are what the message names: the number of vertices, vertex 7.
  template <class T, class Which>
  [[nodiscard]] T value(std::string_view what, const Which& which) {
    begin_ = input_.offset();
    T value = {};
    if (!load(input_, std::endian::big, value)) malformed(fmt::format("the file ends in {} {}", what, which));
    return value;
  }

  uint64_t read_count(std::string_view what) {
    const auto count = value<std::int32_t>("the number of", what);
    if (count < 0) malformed(fmt::format("{} {}, expected at least 0", count, what));
    return static_cast<uint64_t>(count);
  }

  // Before any allocation: the file must be long enough for the counts.
  void check_size(uint64_t vertices, uint64_t faces) {
    constexpr uint64_t kBytes = 12;  // of either
    const auto left = input_.left();
    if (!left) return;
    if ((vertices + faces) * kBytes > *left) {
      malformed(fmt::format("{} vertices and {} faces take {} bytes, but {} bytes are left", vertices, faces,
                            (vertices + faces) * kBytes, *left));
    }
    builder_.positions.reserve(vertices);
    builder_.faces.reserve_corners(3 * faces);
  }

  void read_positions(uint64_t vertices) {
    for (uint64_t i = 0; i < 3 * vertices; ++i) {
      const auto problem = builder_.positions.append(double{value<float>("vertex", i / 3)});
      if (problem) malformed(fmt::format("vertex {}, {} {}", i / 3, axis(i), *problem));
      if (i % 3 == 2) builder_.positions.end_vertex({.byte = begin_});
    }
  }

  void read_faces(uint64_t faces, uint64_t vertices) {
    for (uint64_t i = 0; i < 3 * faces; ++i) {
      const auto vertex = value<std::int32_t>("face", i / 3);
      if (vertex < 0 || static_cast<uint64_t>(vertex) >= vertices) {
        malformed(fmt::format("face {}, corner {} = {}, but there are {} vertices", i / 3, i % 3, vertex, vertices));
      }
      builder_.faces.append_corner(static_cast<std::uint32_t>(vertex));
      if (i % 3 == 2) builder_.faces.end_face(3);
    }
  }

  // "cras   = 1.5 -17 20": distances do not depend on it, but points of the scanner have other coordinates.
  void note_center() {
    constexpr std::size_t kMostText = std::size_t{1} << 12U;
    constexpr std::string_view kKey = "\ncras";
    auto rest = input_.ahead(kMostText).substr(0, kMostText);
    rest.remove_prefix(std::min(rest.find(kKey), rest.size()));
    const auto numbers = rest.substr(0, rest.find('\n', 1));
    if (numbers.find_first_of("123456789") == std::string_view::npos) return;
    builder_.warnings.list().push_back(
        {.what = fmt::format("the coordinates are those of the surface; the center of the scan, {}, is not added",
                             quote(numbers.substr(1))),
         .first_place = {}});
  }

  [[noreturn]] void malformed(std::string_view message) const {
    fail_at(input_.name(), {.byte = begin_}, ErrorCode::MalformedFile, message);
  }

  InputBuffer& input_;
  MeshBuilder builder_;
  uint64_t begin_ = 0;  // of the last value
};

}  // namespace

Mesh read_freesurfer(InputBuffer& input, const ReaderOptions& options) {
  return FreeSurferReader(input, options).read();
}

}  // namespace meshhood::inline v0_1::io
