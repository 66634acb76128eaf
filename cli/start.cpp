// SPDX-License-Identifier: MIT
#include "start.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "meshhood/search.h"

#include "io/messages.h"
#include "io/number.h"
#include "io/system.h"
#include "methods.h"
#include "options.h"
#include "output.h"

namespace meshhood::cli {
namespace {

/// A search that starts nowhere finds nothing, which may be a radius in the wrong unit.
void note_far_point(const PositionsView& positions, const Start& start, double radius) {
  const SpacePoint& center = *start.center();
  VertexId nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (const VertexId seed : start.seeds()) {
    const double distance = positions.visit([&](const auto& xyz) {
      return std::hypot(xyz(seed, 0) - center[0], xyz(seed, 1) - center[1], xyz(seed, 2) - center[2]);
    });
    if (distance < least) nearest = seed;
    least = std::min(least, distance);
  }
  print_error("note: ", fmt::format("the point is {:.6g} from vertex {}, where the search starts: farther than the "
                                    "radius {:.6g}, so nothing is found",
                                    least, nearest, radius));
}

}  // namespace

SpacePoint parse_point(const std::vector<std::string>& point) {
  if (point.size() != 3) {
    wrong_option("--point: {} numbers, expected X,Y,Z", point.size());
  }
  SpacePoint p{};
  for (std::size_t axis = 0; axis < p.size(); ++axis) {
    const auto number = io::parse_real<double>(point[axis]);
    if (!number) wrong_option("--point: {}, expected a number", io::quote(point[axis]));
    p[axis] = *number;
  }
  return p;
}

CLI::Option* add_point(CLI::App& command, const std::string& description, std::vector<std::string>& point) {
  return add_list(command, "--point", description, point)->type_name("X,Y,Z");
}

void add_start(CLI::App& command, const std::string& vertex, StartOptions& options) {
  add_vertices(command, "-v,--vertex", vertex, options.vertices);
  CLI::Option* point = add_point(command, "start at any point in space instead of a vertex; also X Y Z", options.point);
  add_numbers(command, "--seed",
              "with --point: the vertices from which the search starts, such as the corners of a face; by default the "
              "vertex nearest to the point",
              options.seeds)
      ->needs(point);
  add_masks(command, options.masks);
}

bool StartOptions::is_list() const {
  return vertices.size() > 1 || (vertices.size() == 1 && vertices.front() == io::kStandardInput);
}

void check_start_options(const StartOptions& options, bool takes_many, const std::string& metric) {
  if (options.point.empty() == options.vertices.empty()) {
    wrong_option("expected either --vertex or --point");
  }
  if (!takes_many && options.is_list()) wrong_option("--vertex: expected one vertex");
  if (!options.point.empty() && metric == "rings") {
    wrong_option("--metric rings: expected --vertex instead of --point, because a point has no edges");
  }
}

QueryStart::QueryStart(const StartOptions& options, Input& input) : point_(parse_point(options.point)) {
  for (const std::uint64_t seed : options.seeds) seeds_.push_back(resolve_vertex(seed, input));
  if (seeds_.empty()) seeds_.push_back(input.welding().kept(nearest(input.exact_index(), point_).vertex));
}

std::vector<QueryStart> starts_of(const StartOptions& options, const std::string& metric, Input& input) {
  input.set_masks(read_masks(options.masks, input));
  if (metric == "space") input.ignore_welded();
  std::vector<QueryStart> starts;
  if (!options.point.empty()) starts.emplace_back(options, input);
  for (const std::string& typed : options.vertices) {
    if (const auto v = io::parse_count(typed)) {
      starts.emplace_back(resolve_vertex(*v, input));
      continue;
    }
    for (const VertexId v : read_vertex_list(typed, input.vertex_count())) {
      starts.emplace_back(input.welding().kept(v));
    }
  }
  return starts;
}

RegionSearch::RegionSearch(const std::string& metric, Input& input)
    : positions_(input.positions()), searcher_(make_searcher(metric, input)), distance_of_(input.vertex_count()) {}

Answer RegionSearch::regions(const QueryStart& start, std::span<const double> radii) {
  Answer answer{.vertex = start.vertex()};
  searcher_.neighborhood(start.view(), radii.back(), answer.vertices, answer.distances);
  if (!searcher_.has_seed(start.view(), radii.back())) note_far_point(positions_, start.view(), radii.back());
  for (std::size_t i = 0; i < answer.vertices.size(); ++i) distance_of_[answer.vertices[i]] = answer.distances[i];
  searcher_.nested(start.view(), radii, answer.vertices, answer.counts);
  for (std::size_t i = 0; i < answer.vertices.size(); ++i) answer.distances[i] = distance_of_[answer.vertices[i]];
  return answer;
}

}  // namespace meshhood::cli
