// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include "meshhood/error.h"

#include "io/binary.h"
#include "io/byte_source.h"
#include "io/input_buffer.h"
#include "io/messages.h"
#include "io/ply_header.h"
#include "io/ply_values.h"
#include "parts/chunked_mesh.h"
#include "parts/random_file.h"

// A binary PLY file in two ways: vertices have a fixed size and are read at any place; faces are read in order, by the
// values that `io::read_ply` uses.

namespace meshhood::parts {
namespace {

constexpr std::uint64_t kAnySize = std::numeric_limits<std::uint64_t>::max();

/// A coordinate in the row of a vertex.
struct Coordinate {
  std::size_t offset;
  io::PlyType type;
};

/// Where the values of a PLY file lie.
struct Layout {
  io::PlyHeader header;
  const io::PlyElement* vertices = nullptr;
  std::uint64_t first_vertex = 0;  ///< its byte
  std::size_t row_bytes = 0;       ///< of a vertex
  std::array<Coordinate, 3> axes{};
  const io::PlyElement* faces = nullptr;  ///< null if there are none
  std::size_t corner_list = 0;            ///< its place among the properties of a face
};

/// Nothing unless each of them occurs exactly once. No property is a list.
std::optional<std::array<Coordinate, 3>> find_axes(const io::PlyElement& vertex) {
  std::array<Coordinate, 3> axes{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto name = std::string_view("xyz").substr(axis, 1);
    const auto found = vertex.find([&](const io::PlyProperty& property) { return property.name == name; });
    if (found.size() != 1) return std::nullopt;
    axes[axis] = {bytes_of(std::span(vertex.properties).first(found[0])), vertex.properties[found[0]].type};
  }
  return axes;
}

/// Nothing unless there is exactly one, of integers.
std::optional<std::size_t> find_corner_list(const io::PlyElement& face) {
  const auto found = face.find([&](const io::PlyProperty& property) { return face.has_corners(property); });
  if (found.size() != 1) return std::nullopt;
  const io::PlyProperty& list = face.properties[found[0]];
  return list.is_list && is_integer(list.type) ? std::optional(found[0]) : std::nullopt;
}

/// Nothing if a row of a vertex has no fixed place, or if `io::read_ply` must judge the file. `header_bytes`: where the
/// values begin.
std::optional<Layout> find_layout(io::PlyHeader header, std::uint64_t header_bytes) {
  if (header.encoding == io::PlyEncoding::Ascii) return std::nullopt;
  Layout layout{.header = std::move(header)};
  std::uint64_t offset = header_bytes;
  for (const io::PlyElement& element : layout.header.elements) {
    if (element.name == "tristrips") return std::nullopt;
    if (element.name == "face") {
      const auto list = find_corner_list(element);
      if (!list || layout.vertices == nullptr) return std::nullopt;
      layout.faces = &element;
      layout.corner_list = *list;
      break;
    }
    if (!are_single(element.properties)) return std::nullopt;
    const std::size_t row = bytes_of(element.properties);
    if (row != 0 && element.count > (kAnySize - offset) / row) return std::nullopt;
    if (element.name == "vertex") {
      const auto axes = find_axes(element);
      if (!axes) return std::nullopt;
      layout.axes = *axes;
      layout.vertices = &element;
      layout.first_vertex = offset;
      layout.row_bytes = row;
    }
    offset += element.count * row;
  }
  if (layout.vertices == nullptr) return std::nullopt;
  return layout;
}

/// The faces of a file, once in order.
class FaceReader {
 public:
  FaceReader(const RandomFile& file, const Layout& layout)
      : source_(file.in_order()), input_(source_, file.path().string(), kAnySize), layout_(layout) {
    static_cast<void>(io::read_ply_header(input_));
    values_ = io::ply_values(input_, layout.header);
    for (const io::PlyElement& element : layout.header.elements) {
      if (&element == layout.faces) break;
      for (const io::PlyProperty& property : element.properties) {
        require(values_->skip(property.type, element.count));
      }
    }
  }

  /// Appends the corners of the next face, which is number `face`. Calls `check(number)` before they take memory.
  template <class Check>
  void read(std::uint64_t face, std::vector<std::uint64_t>& corners, Check&& check) {
    face_ = face;
    const auto& properties = layout_.faces->properties;
    for (std::size_t i = 0; i < properties.size(); ++i) {
      const io::PlyProperty& property = properties[i];
      const std::uint64_t count = property.is_list ? take_count(property.count_type) : 1;
      if (i != layout_.corner_list) {
        require(values_->skip(property.type, count));
        continue;
      }
      check(count);
      for (std::uint64_t corner = 0; corner < count; ++corner) corners.push_back(take(property.type));
    }
  }

 private:
  std::uint64_t take(io::PlyType type) {
    std::int64_t value = 0;
    require(values_->take_integer(type, value));
    return static_cast<std::uint64_t>(value);
  }

  std::uint64_t take_count(io::PlyType type) {
    const auto count = static_cast<std::int64_t>(take(type));
    if (count < 0) fail(fmt::format("a list of {} values, expected at least 0", count));
    return static_cast<std::uint64_t>(count);
  }

  void require(const io::Problem& problem) const {
    if (problem) fail(*problem);
  }

  [[noreturn]] void fail(std::string_view problem) const {
    const std::uint64_t faces = layout_.faces == nullptr ? 0 : layout_.faces->count;
    io::fail_at(input_.name(), values_->location(), ErrorCode::MalformedFile,
                fmt::format("face {} of {}: {}", face_, faces, problem));
  }

  io::FileSource source_;
  io::InputBuffer input_;
  const Layout& layout_;
  std::unique_ptr<io::PlyValues> values_;
  std::uint64_t face_ = 0;  // for messages
};

class ChunkedPly final : public ChunkedMesh {
 public:
  ChunkedPly(RandomFile file, Layout layout)
      : ChunkedMesh(io::printable_name(file.path().string()), layout.vertices->count,
                    !std::ranges::all_of(layout.axes, io::fits_float, &Coordinate::type)),
        file_(std::move(file)),
        layout_(std::move(layout)) {
    const std::uint64_t end = layout_.first_vertex + vertex_count() * layout_.row_bytes;
    if (end <= file_.size()) return;
    raise(ErrorCode::MalformedFile,
          fmt::format("{}: {} vertices of {} bytes end at byte {}, but the file has {} bytes: it is truncated", name(),
                      vertex_count(), layout_.row_bytes, end, file_.size()));
  }

 private:
  void load_positions(std::uint64_t first, std::span<Point> out) override {
    constexpr std::size_t kBufferBytes = std::size_t{1} << 20;
    const std::size_t row = layout_.row_bytes;
    while (!out.empty()) {
      const std::size_t count = std::min(out.size(), std::max<std::size_t>(1, kBufferBytes / row));
      buffer_.resize(count * row);
      file_.read(layout_.first_vertex + first * row, buffer_);
      for (std::size_t i = 0; i < count; ++i) out[i] = position_at(buffer_.data() + i * row);
      first += count;
      out = out.subspan(count);
    }
  }

  [[nodiscard]] Point position_at(const char* row) const {
    const std::endian order = order_of(layout_.header.encoding);
    const auto at = [&](const Coordinate& axis) {
      return with_type(axis.type, [&](auto example) {
        return static_cast<double>(io::number_at<decltype(example)>(row + axis.offset, order));
      });
    };
    return {at(layout_.axes[0]), at(layout_.axes[1]), at(layout_.axes[2])};
  }

  void check_unchanged() const override { file_.check_unchanged(); }

  void load_first_face() override { faces_.emplace(file_, layout_); }

  bool load_face(std::uint64_t face, std::vector<std::uint64_t>& corners) override {
    if (layout_.faces == nullptr || face == layout_.faces->count) return false;
    faces_->read(face, corners, [this](std::uint64_t count) { check_degree(count); });
    return true;
  }

  RandomFile file_;
  Layout layout_;
  std::vector<char> buffer_;
  std::optional<FaceReader> faces_;
};

}  // namespace

std::unique_ptr<ChunkedMesh> open_binary_ply(const std::filesystem::path& path) {
  std::error_code unknown;
  if (path == io::kStandardInput || !std::filesystem::is_regular_file(path, unknown)) return nullptr;
  RandomFile file(path);
  io::FileSource source = file.in_order();
  if (!source.peek(3).starts_with("ply")) return nullptr;
  io::InputBuffer input(source, path.string(), kAnySize);
  io::PlyHeader header = io::read_ply_header(input);
  auto layout = find_layout(std::move(header), input.offset());
  if (!layout) return nullptr;
  return std::make_unique<ChunkedPly>(std::move(file), std::move(*layout));
}

}  // namespace meshhood::parts
