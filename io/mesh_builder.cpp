// SPDX-License-Identifier: MIT
#include "io/mesh_builder.h"

#include <cmath>
#include <limits>
#include <type_traits>

#include <fmt/format.h>

#include "meshhood/mesh.h"

#include "io/float_keeps.h"
#include "io/number.h"
#include "shared/coarse_float.h"
#include "shared/distance.h"
#include "shared/unplaced.h"

namespace meshhood::inline v0_1::io {
namespace {

// What to do where float is coarse.
std::string_view way_out(Declared declared) {
  switch (declared) {
    case Declared::Float: return kWriteOtherwise;
    case Declared::FloatInText: return "read the file in double precision if it has more digits than a float";
    case Declared::Double:
    case Declared::Nothing: break;
  }
  return "read the file in double precision";
}

// Tells an overflow ("1e999") from "inf" and "nan".
std::string_view reason_not_finite(std::string_view token) {
  const bool has_digits = token.find_first_of("0123456789") != std::string_view::npos;
  return has_digits ? "is too large" : "is not finite";
}

}  // namespace

template <class Real>
std::optional<std::string_view> to_coordinate(std::string_view token, Real& value) {
  const auto number = parse_real<Real>(token);
  if (!number) return "is not a number";
  if (std::isnan(*number)) value = *number;
  if (!std::isfinite(*number)) return reason_not_finite(token);
  if (double{std::abs(*number)} > kLargestCoordinate) return "is too large";
  value = *number;
  return std::nullopt;
}

template <class Real>
std::optional<std::string_view> to_coordinate(double number, Real& value) {
  if (std::isnan(number)) value = std::numeric_limits<Real>::quiet_NaN();
  if (!std::isfinite(number)) return "is not finite";
  const bool fits =
      std::is_same_v<Real, float> ? std::abs(number) < kFloatOverflow : std::abs(number) <= kLargestCoordinate;
  if (!fits) return "is too large";
  value = static_cast<Real>(number);
  return std::nullopt;
}

template std::optional<std::string_view> to_coordinate(std::string_view token, float& value);
template std::optional<std::string_view> to_coordinate(std::string_view token, double& value);
template std::optional<std::string_view> to_coordinate(double number, float& value);
template std::optional<std::string_view> to_coordinate(double number, double& value);

Positions::Positions(Precision precision, Declared declared)
    : is_open_(precision == Precision::FromFile && declared == Declared::Nothing) {
  const bool declares_double = precision == Precision::FromFile && declared == Declared::Double;
  if (is_open_ || declares_double || precision == Precision::Double) xyz_.emplace<std::vector<double>>();
}

void Positions::reserve(std::uint64_t vertices) {
  const auto scalars = 3 * static_cast<std::size_t>(std::min<std::uint64_t>(vertices, kMaxVertices));
  std::visit([scalars](auto& xyz) { xyz.reserve(scalars); }, xyz_);
}

template <class Source>
std::optional<std::string_view> Positions::append_as(Source source) {
  const auto visitor = [source](auto& xyz) {
    typename std::remove_cvref_t<decltype(xyz)>::value_type value = 0;
    auto problem = to_coordinate(source, value);
    if (std::isnan(value)) problem.reset();
    if (!problem) xyz.push_back(value);
    return problem;
  };
  return std::visit(visitor, xyz_);
}

std::optional<std::string_view> Positions::append(std::string_view token) {
  const auto problem = append_as(token);
  if (!is_open_ || problem) return problem;
  const double number = std::get<std::vector<double>>(xyz_).back();
  note(std::isnan(number) || float_keeps(token, number));
  return problem;
}

template std::optional<std::string_view> Positions::append_as(double source);

void Positions::end_vertex(const Location& location) {
  constexpr std::size_t kMost = std::size_t{1} << 18U;  // little memory
  const bool has_nan = std::visit(
      [](const auto& xyz) { return std::any_of(xyz.end() - 3, xyz.end(), [](auto x) { return std::isnan(x); }); },
      xyz_);
  if (has_nan && nan_vertices_.size() < kMost) nan_vertices_.emplace_back(vertex_count() - 1, location);
}

std::optional<Location> Positions::location_of_nan(std::uint64_t vertex) const {
  const auto found = std::ranges::lower_bound(nan_vertices_, vertex, {}, [](const auto& known) { return known.first; });
  if (found == nan_vertices_.end() || found->first != vertex) return std::nullopt;
  return found->second;
}

void Positions::reorder_last(const std::array<std::size_t, 3>& ranks) {
  const auto visitor = [&ranks](auto& xyz) {
    const auto last = xyz.end() - 3;
    const std::array appended = {last[0], last[1], last[2]};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto before = std::count_if(ranks.begin(), ranks.end(), [&](std::size_t rank) { return rank < ranks[i]; });
      last[static_cast<std::ptrdiff_t>(i)] = appended[static_cast<std::size_t>(before)];
    }
  };
  std::visit(visitor, xyz_);
}

std::size_t Positions::scalar_count() const {
  return std::visit([](const auto& xyz) { return xyz.size(); }, xyz_);
}

void Faces::reserve_corners(std::uint64_t corners) { corners_.reserve(static_cast<std::size_t>(corners)); }

void Faces::end_face(std::uint64_t corners) {
  if (offsets_.empty() && corners != 3) {
    for (std::uint64_t face = 0; face <= size_; ++face) offsets_.push_back(3 * face);
  }
  if (!offsets_.empty()) offsets_.push_back(offsets_.back() + corners);
  ++size_;
}

void Faces::append(const Faces& faces) {
  append_many(corners_, std::span<const std::uint32_t>(faces.corners_));
  if (offsets_.empty() && faces.offsets_.empty()) {
    size_ += faces.size_;
  } else {
    const FacesView view = faces.offsets_.empty() ? FacesView::triangles(faces.corners_)
                                                  : FacesView::polygons(faces.offsets_, faces.corners_);
    view.for_each([this](std::size_t, std::span<const VertexId> corners) { end_face(corners.size()); });
  }
}

void Faces::clear() {
  size_ = 0;
  offsets_.clear();
  corners_.clear();
}

void Faces::append(std::size_t count, std::span<const std::uint32_t> corners) {
  append_many(corners_, corners);
  if (corners.size() == 3 * count && offsets_.empty()) {
    size_ += count;
  } else {
    for (std::size_t i = 0; i < count; ++i) end_face(corners.size() / count);
  }
}

void Warnings::add(std::string_view what, const Location& location, std::uint64_t count) {
  if (strict_) fail_at(file_, location, ErrorCode::MalformedFile, fmt::format("{} (refused in strict mode)", what));
  const auto same = std::find_if(list_.begin(), list_.end(), [what](const Warning& w) { return w.what == what; });
  if (same != list_.end()) {
    same->count += count;
  } else {
    list_.push_back({std::string(what), count, location.in_words()});
  }
}

MeshBuilder::MeshBuilder(const InputBuffer& input, const ReadOptions& options, Declared declared)
    : positions(options.precision, declared),
      warnings(input.name(), options.strict),
      file_(input.name()),
      way_out_(way_out(declared)) {}

void MeshBuilder::place_vertices(Mesh& mesh) {
  const FacesView all = mesh.view().faces;
  const auto place_all = [&]<class Real>(std::vector<Real>& xyz) { return place(std::span<Real>(xyz), all); };
  Unplaced unplaced = std::visit(place_all, mesh.positions);
  const std::size_t first = mesh.format == Format::Obj ? 1 : 0;  // the number of the first vertex
  if (const auto& used = unplaced.used) {
    if (const auto location = positions.location_of_nan(used->vertex)) {
      fail_at(file_, *location, ErrorCode::MalformedFile, used->text(first));
    }
    raise(ErrorCode::MalformedFile, fmt::format("{}: {}", file_, used->text(first)));
  }
  warnings.add(
      fmt::format("vertices without a position (NaN), the first of which is {}, are walls", unplaced.first + first),
      positions.location_of_nan(unplaced.first).value_or(Location{}), unplaced.count);
  mesh.walls = std::move(unplaced.walls);
}

Mesh MeshBuilder::finish(Format format) {
  Mesh mesh;
  mesh.format = format;
  mesh.positions = std::move(positions.values());
  mesh.offsets = std::move(faces.offsets());
  mesh.corners = std::move(faces.corners());
  if (positions.have_nan()) place_vertices(mesh);
  mesh.warnings = std::move(warnings.list());
  if (positions.are_double() && !positions.are_open()) return mesh;
  const auto coarse = coarse_float(mesh.view());
  if (!positions.are_double()) {
    if (coarse) mesh.warnings.push_back({.what = fmt::format("{}; {}", coarse->text(), way_out_), .first_place = {}});
  } else if (!coarse) {
    const auto& doubles = std::get<std::vector<double>>(mesh.positions);
    mesh.positions = std::vector<float>(doubles.begin(), doubles.end());
  }
  return mesh;
}

void check_vertex_count(std::uint64_t vertices, const std::string& file, const Location& location) {
  if (vertices <= kMaxVertices) return;
  fail_at(file, location, ErrorCode::TooLarge,
          fmt::format("{} vertices, but at most {} are supported", vertices, kMaxVertices));
}

}  // namespace meshhood::inline v0_1::io
