// SPDX-License-Identifier: MIT
#include "start.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "meshhood/edge_search.h"
#include "meshhood/error.h"
#include "meshhood/region.h"

#include "io/messages.h"
#include "io/number.h"
#include "options.h"
#include "output.h"
#include "vertex_files.h"

namespace meshhood::cli {
namespace {

std::vector<std::uint8_t> read_mask(const std::string& file, const Input& input) {
  std::vector<std::uint8_t> mask;
  if (file.empty()) return mask;
  mask.assign(input.vertex_count(), 0);
  for (const VertexId v : read_vertex_list(file, input.vertex_count())) mask[input.welding().kept(v)] = 1;
  return mask;
}

/// A search that starts nowhere finds nothing, which may be a radius in the wrong unit.
void note_far_point(RegionSearcher& searcher, const Start& start, double radius) {
  VertexId nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (const VertexId seed : start.seeds()) {
    const double distance =
        searcher.connecting_radius(start, seed);  // the path of a seed to itself has no other vertex
    if (distance < least) nearest = seed;
    least = std::min(least, distance);
  }
  print_error("note: ", fmt::format("the point is {:.6g} from vertex {}, where the search starts: farther than the "
                                    "radius {:.6g}, so nothing is found",
                                    least, nearest, radius));
}

/// `ids` come ring by ring. Sorts those of each ring.
StartAnswer sorted_answer(const std::vector<VertexId>& ids, const std::vector<double>& distances,
                          std::vector<std::size_t> counts) {
  std::vector<std::size_t> order(ids.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  auto ring = order.begin();
  for (const std::size_t count : counts) {
    const auto end = order.begin() + static_cast<std::ptrdiff_t>(count);
    std::sort(ring, end, [&](std::size_t a, std::size_t b) { return ids[a] < ids[b]; });
    ring = end;
  }
  StartAnswer answer;
  for (const std::size_t i : order) {
    answer.vertices.push_back(ids[i]);
    answer.distances.push_back(distances[i]);
  }
  answer.counts = std::move(counts);
  return answer;
}

}  // namespace

SpacePoint StartOptions::center() const {
  if (point.size() != 3) {
    raise(ErrorCode::InvalidOption, fmt::format("--point: {} numbers, expected X,Y,Z", point.size()));
  }
  SpacePoint p{};
  for (std::size_t axis = 0; axis < p.size(); ++axis) {
    const auto number = io::parse_real<double>(point[axis]);
    if (!number) raise(ErrorCode::InvalidOption, "--point: " + io::quote(point[axis]) + ", expected a number");
    p[axis] = *number;
  }
  return p;
}

void add_start(CLI::App& command, StartOptions& options) {
  CLI::Option* point =
      command.add_option("--point", options.point, "start at any point in space instead of a vertex; also X Y Z")
          ->delimiter(',')
          ->allow_extra_args(false)
          ->type_name("X,Y,Z");
  add_numbers(command, "--seed",
              "with --point: the vertices from which the search starts, such as the corners of a face; by default the "
              "vertex nearest to the point",
              options.seeds)
      ->needs(point);
  add_choice(command, "--metric",
             "straight: distances in a straight line; path: lengths of the shortest paths along the edges",
             {"straight", "path"}, options.metric);
  add_file_option(command, "--walls", "a list of vertices that the search does not pass, one in each line",
                  options.walls);
  add_file_option(command, "--ignored", "a list of vertices that the search passes but does not print",
                  options.ignored);
}

void check_start_options(const StartOptions& options, const std::string& method, bool has_vertices) {
  const bool has_point = !options.point.empty();
  if (has_point == has_vertices) raise(ErrorCode::InvalidOption, "expected either --vertex or --point");
  if (has_point && options.is_along_edges()) {
    raise(ErrorCode::InvalidOption, "--metric path: expected --vertex, because a point has no edges");
  }
  if (method != "exact" && !options.is_plain()) {
    raise(ErrorCode::InvalidOption, "--point, --metric path, --walls and --ignored require --method exact");
  }
}

FilterMasks::FilterMasks(const StartOptions& options, const Input& input)
    : walls_(read_mask(options.walls, input)), ignored_(read_mask(options.ignored, input)) {}

QueryStart::QueryStart(const StartOptions& options, Input& input) : point_(options.center()) {
  for (const std::uint64_t seed : options.seeds) seeds_.push_back(resolve_vertex(seed, input));
  if (seeds_.empty()) seeds_.push_back(input.welding().kept(nearest(input.exact_index(), point_).vertex));
}

std::vector<QueryStart> starts_of(const StartOptions& options, std::span<const std::uint64_t> vertices, Input& input) {
  std::vector<QueryStart> starts;
  if (!options.point.empty()) starts.emplace_back(options, input);
  for (const std::uint64_t v : vertices) starts.emplace_back(resolve_vertex(v, input));
  return starts;
}

QueryStart start_of(const StartOptions& options, std::span<const std::uint64_t> vertices, Input& input) {
  if (vertices.size() > 1) raise(ErrorCode::InvalidOption, "--vertex: expected one vertex");
  return starts_of(options, vertices, input).front();
}

StartAnswer regions_of(const StartOptions& options, const QueryStart& start, std::span<const double> radii,
                       Input& input) {
  const FilterMasks masks(options, input);
  std::vector<VertexId> ids;
  std::vector<double> distances;
  std::vector<std::size_t> counts;
  if (options.is_along_edges()) {
    EdgeSearcher(input.exact_index()).neighborhood(*start.vertex(), radii.back(), ids, distances, masks.filter());
    for (const double radius : radii) {  // the distances ascend
      const auto end = std::upper_bound(distances.begin(), distances.end(), radius);
      counts.push_back(static_cast<std::size_t>(end - distances.begin()));
    }
  } else {
    RegionSearcher searcher(input.exact_index());
    const bool is_near = searcher.region(start.view(), radii.back(), ids, distances, masks.filter());
    if (!is_near) note_far_point(searcher, start.view(), radii.back());
    std::vector<double> distance_of(input.vertex_count());  // `nested` returns no distances
    for (std::size_t i = 0; i < ids.size(); ++i) distance_of[ids[i]] = distances[i];
    searcher.nested(start.view(), radii, ids, counts, masks.filter());
    for (std::size_t i = 0; i < ids.size(); ++i) distances[i] = distance_of[ids[i]];
  }
  return sorted_answer(ids, distances, std::move(counts));
}

StartAnswer rings_of(const StartOptions& options, VertexId v, std::size_t k, Input& input) {
  const FilterMasks masks(options, input);
  std::vector<VertexId> ids;
  std::vector<std::size_t> counts;
  EdgeSearcher(input.exact_index()).rings(v, k, ids, counts, masks.filter());
  std::vector<double> rings;
  for (std::size_t ring = 0; ring < counts.size(); ++ring) rings.resize(counts[ring], static_cast<double>(ring));
  return sorted_answer(ids, rings, {ids.size()});
}

}  // namespace meshhood::cli
