// SPDX-License-Identifier: MIT
// The vertices nearest to many points, along a curve on which near points follow each other.
#include <cstddef>
#include <span>
#include <vector>

#include "meshhood/start.h"

#include "batch/position_sort.h"
#include "exact/index_access.h"
#include "exact/query/arguments.h"
#include "exact/query/nearest_vertex.h"
#include "shared/large_pages.h"
#include "shared/parallel.h"

namespace meshhood::inline v0_1 {

std::vector<NearestVertex> nearest(const Index& index, std::span<const SpacePoint> points, const Run& run) {
  constexpr std::size_t kPointsOfSearch = 256;
  for (std::size_t i = 0; i < points.size(); ++i) check_point(points[i], "points", i);
  TaskContext task(run.threads, run.progress, points.size());
  const IndexView& view = IndexAccess::view(index);
  const auto point_of = [&](std::size_t row) { return Point{points[row][0], points[row][1], points[row][2]}; };
  const auto in_frame = [&](std::size_t row) { return view.frame.to_frame(point_of(row)); };
  const RawVector<std::size_t> in_order = rows_along_curve(points.size(), in_frame, task);
  std::vector<NearestVertex> found = make_values<NearestVertex>(points.size());
  task.parallel_for(points.size(), kPointsOfSearch, [&](unsigned thread, std::size_t begin, std::size_t end) {
    NearestVertexSearch search(view);
    for (std::size_t i = begin; i < end; ++i) found[in_order[i]] = search.run(point_of(in_order[i]));
    task.advance(thread, end - begin);
  });
  task.finish();
  return found;
}

}  // namespace meshhood::inline v0_1
