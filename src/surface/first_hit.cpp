// SPDX-License-Identifier: MIT
// Finds the first point of a surface on a ray.
#include "surface/first_hit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "meshhood/error.h"
#include "meshhood/surface.h"

#include "base/prefetch.h"
#include "base/vector.h"
#include "batch/position_sort.h"
#include "exact/query/arguments.h"
#include "patch/twofold.h"
#include "shared/large_pages.h"
#include "shared/parallel.h"
#include "shared/text.h"
#include "surface/surface.h"

namespace meshhood::inline v0_1 {
namespace {

constexpr std::size_t kRaysOfTask = 256;
constexpr std::size_t kRaysAhead = 8;

// Memory is fetched for one ray while others go on. A tree that fits a cache is searched faster by one after the other.
constexpr std::size_t kRaysTogether = 8;
constexpr std::size_t kCachedBytes = 8 << 20;

/// Returns twice the signed area of the triangle of the origin and two points of the plane.
Twofold precise_area(const Point& a, const Point& b) { return Twofold::product(a.x, b.y) - Twofold::product(a.y, b.x); }

/// Does the same in double; exact if it is 0. The rounding of the products keeps their order, unless they become equal.
double doubled_area(const Point& a, const Point& b) {
  const double left = a.x * b.y;
  const double right = a.y * b.x;
  return left != right ? left - right : static_cast<double>(precise_area(a, b));
}

Point flat(const Point& p) { return {p.x, p.y, 0}; }

/// Returns the weights of the origin in a triangle of the plane, inside of which it lies: its share of the height over
/// the longest side, then its share of this side. So it is off by a few units of this side, however thin the triangle.
/// Where the areas are mostly rounding, a weight may be negative.
std::array<double, 3> weights_inside(const std::array<Point, 3>& seen, const std::array<double, 3>& areas) {
  const std::array sides{flat(seen[1] - seen[0]), flat(seen[2] - seen[1]), flat(seen[0] - seen[2])};
  const std::size_t i = longest(sides);
  const std::size_t j = (i + 1) % 3;
  const std::size_t k = (i + 2) % 3;
  std::array<double, 3> weights{};
  weights[k] = areas[k] / ((areas[0] + areas[1]) + areas[2]);
  weights[j] = -dot(sides[i], flat(seen[i]) - weights[k] * sides[k]) / dot(sides[i], sides[i]);
  weights[i] = (1 - weights[j]) - weights[k];
  return weights;
}

/// Returns the same weights by areas that are not rounding. They tell on which side of the origin the triangle is.
std::array<Twofold, 3> precise_weights_inside(const std::array<Point, 3>& seen) {
  const std::array areas{precise_area(seen[1], seen[2]), precise_area(seen[2], seen[0]),
                         precise_area(seen[0], seen[1])};
  const Twofold sum = areas[0] + areas[1] + areas[2];
  return {areas[0] / sum, areas[1] / sum, areas[2] / sum};
}

/// Returns how far along the ray a triangle is met.
template <class Real>
Real way_of(const std::array<Point, 3>& seen, const std::array<Real, 3>& weights) {
  Real way = 0;
  for (std::size_t i = 0; i < 3; ++i) way = way + weights[i] * seen[i].z;
  return way;
}

/// Returns the weights on the line of the side from corner `i` to `j`, seen from the same end by all its triangles.
std::array<double, 3> weights_on_side(const std::array<Point, 3>& corners, const std::array<Point, 3>& seen,
                                      std::size_t i, std::size_t j) {
  if (is_before(corners[j], corners[i])) std::swap(i, j);
  std::array<double, 3> weights{};
  weights[j] = share_of_side(flat(seen[i]), flat(seen[j]));
  weights[i] = 1 - weights[j];
  return weights;
}

/// Returns whether `d` is surely a direction. It is false also for some that are as long as numbers can be.
bool is_direction(const SpacePoint& d) {
  const double sum = std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]);
  return 0 < sum && sum < kInfinity;
}

void check_direction(const SpacePoint& d, std::string_view name, std::optional<std::size_t> row = {}) {
  for (std::size_t axis = 0; axis < d.size(); ++axis) {
    if (std::isfinite(d[axis])) continue;
    raise(ErrorCode::InvalidOption, named(name, row) + "coordinate " + std::to_string(axis) + " is " +
                                        to_text(d[axis]) + ", expected a finite number");
  }
  if (d == SpacePoint{}) raise(ErrorCode::InvalidOption, named(name, row) + "it is 0, expected a direction");
}

Point to_point(const SpacePoint& p) { return {p[0], p[1], p[2]}; }

SurfacePoint surface_point(const SurfaceState& state, const FaceTree& tree, const TriangleHit& first) {
  if (first.at.distance == kInfinity) return {};
  const Triangle& triangle = tree.triangles()[first.triangle];
  return surface_point(*state.index, state.faces(), triangle.face, triangle.corners, first.at);
}

/// Every triangle that a ray meets counts.
constexpr auto kEachCounts = [](std::size_t, const TrianglePoint&) { return true; };

/// Finds the first hit of each ray from `begin` to `end`, of several rays by turns, and calls `visit(i, point)`. Once
/// `goes_on()` is false, no ray is begun.
template <class RayOf, class GoesOn, class Visit>
void search_together(const SurfaceState& state, const FaceTree& tree, std::size_t begin, std::size_t end,
                     RayOf&& ray_of, GoesOn&& goes_on, Visit&& visit) {
  struct Started {
    std::optional<FirstHitSearch<decltype(kEachCounts)>> search;
    std::size_t ray = 0;
  };
  std::array<Started, kRaysTogether> places;
  const std::span<Started> all = std::span(places).first(tree.bytes() <= kCachedBytes ? 1 : kRaysTogether);
  std::size_t next = begin;
  const auto start = [&](Started& free) {
    free.search.reset();
    if (next == end || !goes_on()) return false;
    free.ray = next++;
    const auto [origin, direction] = ray_of(free.ray);
    free.search.emplace(*state.index, tree, origin, direction, kEachCounts);
    return true;
  };
  std::size_t running = 0;
  for (Started& each : all) running += start(each) ? 1 : 0;
  while (running > 0) {
    for (Started& each : all) {
      if (!each.search || each.search->advance()) continue;
      visit(each.ray, surface_point(state, tree, each.search->first()));
      if (!start(each)) --running;
    }
  }
}

}  // namespace

Ray::Ray(const Point& origin, const Point& direction, const Frame& frame)
    : in_frame_(frame.to_frame(origin)),
      direction_{direction.x / largest_component(direction), direction.y / largest_component(direction),
                 direction.z / largest_component(direction)},
      length_(length(direction_)),
      frame_scale_(frame.scale),
      scale_(std::ldexp(1.0, -std::ilogb(std::max(largest_component(origin - frame.origin), 1 / frame.scale)))),
      axes_(std::abs(direction_.x) == 1   ? Axes{&Point::y, &Point::z, &Point::x}
            : std::abs(direction_.y) == 1 ? Axes{&Point::z, &Point::x, &Point::y}
                                          : Axes{&Point::x, &Point::y, &Point::z}),
      turned_origin_(turn(origin)),
      turned_direction_(turn(direction_)) {}

Point Ray::see(const Point& p) const {
  const Point offset = scale_ * (turn(p) - turned_origin_);
  const double way = offset.z * turned_direction_.z;
  return {offset.x - turned_direction_.x * way, offset.y - turned_direction_.y * way, way};
}

std::optional<TrianglePoint> Ray::meet(const std::array<Point, 3>& corners) const {
  const std::array seen{see(corners[0]), see(corners[1]), see(corners[2])};
  const std::array areas{doubled_area(seen[1], seen[2]), doubled_area(seen[2], seen[0]),
                         doubled_area(seen[0], seen[1])};
  const double least = std::min(areas[0], std::min(areas[1], areas[2]));
  const double most = std::max(areas[0], std::max(areas[1], areas[2]));
  if ((least < 0) == (most > 0)) return std::nullopt;  // the triangle is beside the ray, or seen from its side
  TrianglePoint found{{}, {0, 0, 0}, 0};
  const auto zero = static_cast<std::size_t>(std::ranges::find(areas, 0.0) - areas.begin());
  const bool is_inside = zero == areas.size();
  found.barycentric =
      is_inside ? weights_inside(seen, areas) : weights_on_side(corners, seen, (zero + 1) % 3, (zero + 2) % 3);
  double way = way_of(seen, found.barycentric);
  if (is_inside && (way < 0 || std::ranges::min(found.barycentric) < 0)) {
    const std::array<Twofold, 3> weights = precise_weights_inside(seen);
    for (std::size_t i = 0; i < 3; ++i) found.barycentric[i] = static_cast<double>(weights[i]);
    way = static_cast<double>(way_of(seen, weights));
  }
  if (!(way >= 0)) return std::nullopt;
  for (std::size_t i = 0; i < 3; ++i) found.point = found.point + found.barycentric[i] * corners[i];
  found.distance = way / scale_ * length_;
  return found;
}

SurfacePoint Surface::first_hit(const SpacePoint& origin, const SpacePoint& direction) const {
  const State& state = SurfaceAccess::state(*this);
  check_point(origin, "origin");
  check_direction(direction, "direction");
  TaskContext alone;
  const FaceTree& tree = state.tree(alone);
  return surface_point(state, tree,
                       find_first_hit(*state.index, tree, to_point(origin), to_point(direction), kEachCounts));
}

std::vector<SurfacePoint> Surface::first_hits(std::span<const SpacePoint> origins,
                                              std::span<const SpacePoint> directions, const Run& run) const {
  std::vector<SurfacePoint> found = make_values<SurfacePoint>(origins.size());
  for_each_first_hit(origins, directions, [&](std::size_t row, const SurfacePoint& point) { found[row] = point; }, run);
  return found;
}

void Surface::for_each_first_hit(std::span<const SpacePoint> origins, std::span<const SpacePoint> directions,
                                 const SurfacePointVisitor& visit, const Run& run) const {
  check_function(visit, "visit");
  const State& state = SurfaceAccess::state(*this);
  if (origins.size() != directions.size()) {
    raise(ErrorCode::InvalidOption, std::to_string(directions.size()) + " directions, expected one for each of " +
                                        std::to_string(origins.size()) + " origins");
  }
  check_points(origins, "origins");
  for (std::size_t i = 0; i < directions.size(); ++i) {
    if (!is_direction(directions[i])) check_direction(directions[i], "directions", i);
  }
  TaskContext task(run.threads, run.progress, origins.size());
  const FaceTree& tree = state.tree(task);
  const auto ray_of = [&](std::size_t i) { return std::pair(to_point(origins[i]), to_point(directions[i])); };
  const auto entry_of = [&](std::size_t i) {
    const Ray ray(to_point(origins[i]), to_point(directions[i]), state.index->frame);
    return ray.origin() + way_to_frame(ray.origin(), ray.direction()) * ray.direction();
  };
  const RawVector<std::size_t> in_order = rows_along_curve(origins.size(), entry_of, task);
  const auto fetch_row = [&](std::size_t row) {  // rays that follow each other along the curve are far apart in memory
    prefetch(&origins[row]);
    prefetch(&directions[row]);
  };
  task.parallel_for(origins.size(), kRaysOfTask, [&](unsigned thread, std::size_t begin, std::size_t end) {
    const auto next_ray = [&](std::size_t i) {
      if (i + kRaysAhead < end) fetch_row(in_order[i + kRaysAhead]);
      return ray_of(in_order[i]);
    };
    const auto visit_ray = [&](std::size_t i, const SurfacePoint& point) {
      visit(in_order[i], point);
      task.advance(thread, 1);
    };
    search_together(state, tree, begin, end, next_ray, [&] { return task.should_continue(thread); }, visit_ray);
  });
  task.finish();
}

}  // namespace meshhood::inline v0_1
