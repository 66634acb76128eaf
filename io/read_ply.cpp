// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <memory>

#include <fmt/format.h>

#include "io/mesh_builder.h"
#include "io/ply_header.h"
#include "io/ply_values.h"
#include "io/readers.h"

// Elements are read in the order of the file. `vertex` (x, y, z), `face` and `tristrips` (vertex_indices or
// vertex_index) are kept; all others are skipped.

namespace meshhood::inline v0_1::io {
namespace {

using std::uint64_t;

// The index of the property of `element` for which `is_it` holds, if there is one. `name` is for the error.
template <class Predicate>
std::optional<std::size_t> find_property(const InputBuffer& input, const PlyElement& element, std::string_view name,
                                         Predicate&& is_it) {
  const std::vector<std::size_t> found = element.find(is_it);
  if (found.size() > 1) {
    fail_at(input.name(), element.location, ErrorCode::MalformedFile,
            fmt::format("element {} has the property {} twice", element.name, name));
  }
  return found.empty() ? std::nullopt : std::optional(found.front());
}

// The indices of x, y and z among the properties of a vertex.
using Axes = std::array<std::size_t, 3>;

Axes find_axes(const InputBuffer& input, const PlyElement& vertex) {
  Axes axes = {};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string name(1, axis(i));
    const auto found = find_property(input, vertex, name, [&name](const auto& p) { return p.name == name; });
    if (!found || vertex.properties[*found].is_list) {
      fail_at(input.name(), vertex.location, ErrorCode::MalformedFile,
              fmt::format("element vertex has no scalar property {}", name));
    }
    axes[i] = *found;
  }
  return axes;
}

bool has_double_axis(const PlyElement& vertex, const Axes& axes) {
  return std::any_of(axes.begin(), axes.end(), [&](std::size_t i) { return !fits_float(vertex.properties[i].type); });
}

const PlyElement& vertex_element(const InputBuffer& input, const PlyHeader& header) {
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") return element;
  }
  fail_at(input.name(), {.line = header.lines, .column = 1}, ErrorCode::MalformedFile,
          "the header has no element vertex");
}

class PlyReader {
 public:
  PlyReader(InputBuffer& input, const ReaderOptions& options)
      : input_(input),
        header_(read_ply_header(input)),
        vertex_(vertex_element(input, header_)),
        axes_(find_axes(input, vertex_)),
        values_(ply_values(input, header_, options)),
        builder_(input, options, declared_type()) {}

  Mesh read() {
    for (const auto& element : header_.elements) {
      element_ = &element;
      row_ = 0;
      check_count();
      read_element();
    }
    if (values_->anything_left()) judge_rest();
    return builder_.finish(Format::Ply);
  }

 private:
  [[nodiscard]] Declared declared_type() const {
    if (has_double_axis(vertex_, axes_)) return Declared::Double;
    return header_.encoding == PlyEncoding::Ascii ? Declared::FloatInText : Declared::Float;
  }

  // Where rows run over lines, it may be that one of them has lost a number.
  void judge_rest() {
    constexpr std::string_view kRest = "data after the last element";
    const std::string hint = values_->hint();
    if (hint.empty()) return builder_.warnings.add(kRest, values_->location());
    fail_at(input_.name(), values_->location(), ErrorCode::MalformedFile, fmt::format("{}{}", kRest, hint));
  }

  // Before any loop or allocation: the file must be long enough for the count.
  void check_count() const {
    const auto least = least_bytes(*element_);
    const auto left = values_->bytes_left();
    if (left && least != 0 && element_->count > *left / least) {
      fail_at(input_.name(), element_->location, ErrorCode::MalformedFile,
              fmt::format(
                  "{} elements {} take at least {} bytes each, but {} bytes are left: at least {} elements are missing",
                  element_->count, quote(element_->name), least, input_.left().value_or(0),
                  element_->count - *left / least));
    }
    if (element_ == &vertex_) check_vertex_count(vertex_.count, input_.name(), vertex_.location);
  }

  [[nodiscard]] uint64_t least_bytes(const PlyElement& element) const {
    uint64_t sum = 0;
    for (const auto& property : element.properties) {
      sum += values_->least_bytes(property.is_list ? property.count_type : property.type);
    }
    return sum;
  }

  void read_element() {
    if (element_->properties.empty()) return;  // rows without bytes
    if (element_ == &vertex_) return read_vertices();
    if (element_->name == "face" || element_->name == "tristrips") return read_lists();
    read_rows(nullptr, [&] { skip_properties(0, element_->properties.size()); });
  }

  void read_vertices() {
    if (values_->bytes_left()) builder_.positions.reserve(vertex_.count);
    read_rows(values_->vertex_rows(vertex_, axes_, builder_.positions), [&] { read_vertex(); });
  }

  void read_vertex() {
    Location last;
    for (std::size_t i = 0; i < vertex_.properties.size(); ++i) {
      if (std::ranges::find(axes_, i) == axes_.end()) {
        skip_properties(i, i + 1);
        continue;
      }
      property_ = &vertex_.properties[i];
      require(values_->take_coordinate(property_->type, builder_.positions));
      last = values_->location();
    }
    builder_.positions.end_vertex(last);
    if (!std::ranges::is_sorted(axes_)) builder_.positions.reorder_last(axes_);
  }

  // The rows of the element: those that `plain` takes, and `read_row` for each of the others.
  template <class ReadRow>
  void read_rows(const PlyRows& plain, ReadRow&& read_row) {
    for (; row_ < element_->count; ++row_) {
      if (plain) row_ += plain(element_->count - row_);
      if (row_ == element_->count) return;
      read_row();
      if (values_->end_row(*element_, row_)) {
        builder_.warnings.add("lines with more numbers than the header declares", values_->location());
      }
    }
  }

  // Of faces or strips.
  void read_lists() {
    if (element_->count == 0 && !find_list()) return;
    const std::size_t list = list_property();
    property_ = &element_->properties[list];
    reserve_corners();
    const bool are_faces = element_->name == "face";
    const PlyRows plain = are_faces ? values_->face_rows(*element_, list, vertex_.count, builder_.faces) : PlyRows();
    read_rows(plain, [&] {
      skip_properties(0, list);
      property_ = &element_->properties[list];
      const uint64_t corners = take_list_count();
      are_faces ? read_face(corners) : read_strip(corners);
      skip_properties(list + 1, element_->properties.size());
    });
  }

  [[nodiscard]] std::optional<std::size_t> find_list() const {
    return find_property(input_, *element_, "vertex_indices", [&](const auto& p) { return element_->has_corners(p); });
  }

  [[nodiscard]] std::size_t list_property() const {
    const auto list = find_list();
    if (list) {
      const auto& property = element_->properties[*list];
      if (property.is_list && is_integer(property.type)) return *list;
    }
    fail_at(input_.name(), element_->location, ErrorCode::MalformedFile,
            fmt::format("element {} has no list of integers vertex_indices or vertex_index", element_->name));
  }

  void reserve_corners() {
    const auto left = values_->bytes_left();
    if (!left) return;
    const auto most = *left / values_->least_bytes(property_->type);
    builder_.faces.reserve_corners(std::min(most, element_->count <= most ? 3 * element_->count : most));
  }

  void read_face(uint64_t corners) {
    for (uint64_t corner = 0; corner < corners; ++corner) {
      const auto index = take_index();
      builder_.faces.append_corner(checked(index, corner));
    }
    builder_.faces.end_face(corners);
  }

  // A strip has a triangle for each corner from the third on, every other one reversed; -1 begins a new strip. A
  // triangle that repeats a corner only connects two parts of the strip and is left out.
  void read_strip(uint64_t corners) {
    std::array<std::uint32_t, 2> last = {};
    uint64_t length = 0;
    for (uint64_t corner = 0; corner < corners; ++corner) {
      const auto index = take_index();
      if (index == -1) {
        length = 0;
        continue;
      }
      const auto vertex = checked(index, corner);
      if (length >= 2) append_triangle(last[length % 2], last[(length + 1) % 2], vertex, length % 2 == 1);
      last[length++ % 2] = vertex;
    }
  }

  void append_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool reversed) {
    if (a == b || b == c || c == a) return;
    builder_.faces.append_corner(reversed ? b : a);
    builder_.faces.append_corner(reversed ? a : b);
    builder_.faces.append_corner(c);
    builder_.faces.end_face(3);
  }

  void skip_properties(std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      property_ = &element_->properties[i];
      if (!property_->is_list) {
        require(values_->skip(property_->type, 1));
      } else if (i > 0 && values_->row_is_over()) {
        builder_.warnings.add("rows end before their last list, which is read as empty", values_->location());
      } else {
        require(values_->skip(property_->type, take_list_count()));
      }
    }
  }

  uint64_t take_list_count() {
    std::int64_t count = 0;
    require(values_->take_integer(property_->count_type, count));
    if (count < 0) fail(fmt::format("a list of {} values, expected at least 0", count));
    const auto length = static_cast<uint64_t>(count);
    const auto left = values_->bytes_left();
    if (left && length > *left / values_->least_bytes(property_->type)) {
      fail(fmt::format("a list of {} values, but {} bytes are left", count, input_.left().value_or(0)));
    }
    return length;
  }

  std::int64_t take_index() {
    std::int64_t index = 0;
    require(values_->take_integer(property_->type, index));
    return index;
  }

  [[nodiscard]] std::uint32_t checked(std::int64_t index, uint64_t corner) const {
    if (index >= 0 && static_cast<uint64_t>(index) < vertex_.count) return static_cast<std::uint32_t>(index);
    fail_at(input_.name(), values_->location(), ErrorCode::MalformedFile,
            fmt::format("{} {}, {}[{}] = {}, but there are {} vertices{}", element_->name, row_, property_->name,
                        corner, index, vertex_.count, values_->hint()));
  }

  void require(const Problem& problem) const {
    if (problem) fail(*problem);
  }

  [[noreturn]] void fail(std::string_view problem) const {
    const std::string missing =
        problem == kFileEnds ? fmt::format(", {} of {} rows are missing", element_->count - row_, element_->count) : "";
    fail_at(input_.name(), values_->location(), ErrorCode::MalformedFile,
            fmt::format("{} {} of {}, {}: {}{}{}", escape(element_->name), row_, element_->count,
                        escape(property_->name), problem, missing, values_->hint()));
  }

  InputBuffer& input_;
  PlyHeader header_;
  const PlyElement& vertex_;
  Axes axes_;
  std::unique_ptr<PlyValues> values_;
  MeshBuilder builder_;

  // The current value, for messages.
  const PlyElement* element_ = nullptr;
  uint64_t row_ = 0;
  const PlyProperty* property_ = nullptr;
};

}  // namespace

Mesh read_ply(InputBuffer& input, const ReaderOptions& options) { return PlyReader(input, options).read(); }

}  // namespace meshhood::inline v0_1::io
